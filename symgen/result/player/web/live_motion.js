// -- live -----------------------------------------------------------------------------------------------------------------

let live = null, state = null, clock = 0, follow = null, columns = null;
function enliven({ emitted, makeLive, observed, makeColumns }) {
  live = data.live ? makeLive(data.live, Object.assign({ confirm: null, bodies: null, find_lock: null }, emitted)) : null;
  columns = live && observed ? makeColumns(live, emitted, data.live.columns, observed) : null;
}

// A frame of the motion that is worked out: positions, and what else pages plot.
function record(t, begin = false) {
  follow.t.push(t);
  follow.rows.push(live.bodies(t, state));
  for (const { t: when, name } of live.transitions()) follow.moments.push([when, when, "event", name]);
  if (columns) follow.values.push(columns.values(t, state, begin));
}

// Time between frames: a number of steps of length h, so that these are the steps of a motion without frames.
function frameSpacing(end, h) {
  const about = end / Math.max(60, Math.min(600, Math.round(end * 60)));
  return h * Math.max(1, Math.round(about / h));
}

// Begin again with the sliders' parameters; steps are taken while the page is drawn.
function restart(row) {
  dropHand();
  const begun = live.start(), failed = !begun || !begun.every(Number.isFinite);
  for (const each of rows) each.field.setAttribute("aria-invalid", failed && each === row);
  $("picture").classList.toggle("stale", failed);
  $("closes").textContent = failed ? `The mechanism does not close with ${row.name} = ${short(live.p[row.i])}. ${row.limits()}` : "";
  play(!failed);
  if (failed && follow && !follow.whole) {
    follow.end = clock;
    finish();
  }
  if (failed) return false;
  beginMotion(begun);
  show(follow);
  return true;
}

// A motion from a start, with what a hand does in it: from which times on, and with which spring.
function beginMotion(begun, hands = []) {
  state = begun;
  clock = 0;
  const end = data.live.until, spacing = frameSpacing(end, data.live.step);
  follow = { t: [], rows: [], values: [], groups: [], moments: [], facts: [], status: "ok", end, spacing, whole: false, hands, handed: 0 };
  record(0, true);
}

// What a hand does from the step on that begins now.
function handOver() {
  const { hands } = follow;
  while (follow.handed < hands.length && hands[follow.handed].t <= clock + 1e-9 * data.live.step) live.pull(hands[follow.handed++].hand);
}

// Frames up to a time, as far as the budget goes [ms].
function compute(budget, until = follow.end) {
  const began = performance.now(), h = data.live.step;
  while (clock < until - 1e-12 && performance.now() - began < budget) {
    const next = follow.t.length * follow.spacing, due = next > follow.end - 1e-9 * h ? follow.end : next;
    while (clock < due - 1e-12 && performance.now() - began < 2 * budget) {
      const step = Math.min(h, due - clock);
      handOver();
      if (!live.step(clock, state, step)) return stopped(step);
      clock = due - clock - step < 1e-9 * h ? due : clock + step;
    }
    if (clock < due - 1e-12) break;
    if (live.open(clock, state)) return stopped(0);
    record(clock);
    if (clock >= follow.end - 1e-9) {
      finish();
      return;
    }
  }
  wanted = true;
}

// The motion ends in the last step of some length; or, of length 0, somewhere behind the last frame.
function stopped(step) {
  const last = follow.t[follow.t.length - 1], end = step ? live.end(state) : null;
  if (end && end.t > last) record(end.t);
  clock = follow.end = end ? end.t : last;
  follow.status = end && !end.failed ? "ok" : "failed";
  $("closes").textContent = end ? end.sentence : `The mechanism closes with these parameters up to t = ${short(last)} s.`;
  finish();
}

function finish() {
  follow.whole = true;
  const names = columns ? columns.names : data.names, frames = columns ? follow.values : follow.rows;
  const table = new Map(names.map((name, i) => [name, Float64Array.from(frames, (row) => row[i])]));
  const has = (g) => g.names.every((name) => table.has(name));
  const levels = (column) => column.map((x) => Math.log10(Math.max(Math.abs(x), 1e-17)));
  follow.groups = motions[0].groups.filter(has).map((g) => {
    const own = g.names.map((name) => table.get(name));
    return { ...g, places: null, columns: g.log ? own.map(levels) : cleaned(own, g) };
  });
  const { reactions, pulls } = motions[0], axes = ["Fx", "Fy", "Fz"].slice(0, view.spatial ? 3 : 2);
  const arrowed = (part, ends) => {
    const wantedNames = part ? part.names.flatMap((name) => ends.map((end) => `${name}.${end}`)) : [];
    return wantedNames.length && wantedNames.every((name) => table.has(name)) ? { names: part.names, columns: wantedNames.map((name) => table.get(name)) } : null;
  };
  follow.reactions = arrowed(reactions, axes);
  follow.pulls = arrowed(pulls, ["force"]);
  show(follow);
}

// What rounding leaves is 0 in a plot, beside the scale of a group's numbers.
function cleaned(list, { unit, scale }) {
  const size = list.reduce((most, column) => column.reduce((a, x) => Math.max(a, Math.abs(x) || 0), most), Math.max(scale, unit === "rad" ? 1 : 0));
  return list.map((column) => column.map((x) => (Math.abs(x) < 1e-12 * size ? 0 : x)));
}
