// The page: time, controls, what is drawn beside the mechanism, and the live part.

let data = opened(JSON.parse(document.getElementById("data").textContent));
// Bodies that look alike share their lists of points.
function opened(data) {
  for (const item of data.scene.items) for (const mark of item.marks) {
    if (mark[0] === "L") mark[4] = data.scene.lists[mark[4]];
    else if (mark[0] === "S") mark[3] = mark[3].map((i) => data.scene.lists[i]);
  }
  return data;
}
const $ = (id) => document.getElementById(id);
const preferred = matchMedia("(prefers-color-scheme: dark)");
let theme = ""; // what the page was set to, else it has that of the system
function paintPage() {
  document.documentElement.dataset.theme = theme || (preferred.matches ? "dark" : "light");
  readPalette();
}
paintPage();
let solid = null, view = null;
function stage() {
  solid = data.scene.spatial ? makeSolid($("solid"), data.scene) : null;
  $("solid").hidden = !solid;
  view = makeScene($("view"), data.scene, solid);
}
stage();
$("solid").addEventListener("webglcontextlost", () => {
  // the canvas above draws what it can
  $("solid").hidden = true;
  solid = null;
  view = makeScene($("view"), data.scene);
  refit();
});
let single = null; // the one curve of the group that is shown
const plot = makePlot($("plot"), $("key"), (i) => {
  single = single === i ? null : i;
  choose();
});

function recorded(part) {
  const n = part.count, t = floatColumns(part.t, n)[0] || new Float32Array(0), columns = typeof part.q === "string" ? floatColumns(part.q, n) : shortColumns(part.q, n);
  const rows = Array.from({ length: n }, (_, k) => Float64Array.from(columns, (c) => c[k]));
  const groups = part.groups.map((g) => ({ ...g, columns: g.places ? cleaned(g.places.map((i) => columns[i]), g) : filled(g, n) }));
  for (const name of ["reactions", "pulls", "gaps"]) if (part[name]) part[name].columns = shortColumns(part[name], n);
  return { ...part, t: Float64Array.from(t), rows, groups, end: n ? t[n - 1] : 0, whole: true };
}

// Columns of every so many frames, the last one among them, at all frames.
function filled(g, n) {
  const every = g.every, count = n ? Math.ceil((n - 1) / every) + 1 : 0;
  return shortColumns(g, count).map((column) => Float64Array.from({ length: n }, (_, k) => {
    const j = Math.floor(k / every), begin = j * every, end = Math.min(begin + every, n - 1);
    return k === begin ? column[j] : column[j] + ((column[j + 1] - column[j]) * (k - begin)) / (end - begin);
  }));
}

let motions = data.motions.map(recorded);
let motion = motions[0]; // what is played: the recording, or what the live part works out
let time = motion.t[0] || 0, playing = false, speed = 1, last = 0, group = null, wanted = true;
let traced = [];
const drawn = []; // called after each picture

// -- positions between frames ---------------------------------------------------------------------------------------------

function index(t, time) {
  let low = 0, high = t.length - 1;
  while (high - low > 1) {
    const k = (low + high) >> 1;
    if (t[k] <= time) low = k;
    else high = k;
  }
  return low;
}

// Cubic between frames, with slopes of their neighbours.
function between(motion, time) {
  const { t, rows } = motion;
  if (t.length < 2) return rows[0];
  const k = index(t, time), h = t[k + 1] - t[k] || 1, s = Math.min(Math.max((time - t[k]) / h, 0), 1);
  if (s === 0) return rows[k];
  if (s === 1) return rows[k + 1];
  const a = rows[k], b = rows[k + 1], before = rows[k - 1], after = rows[k + 2];
  const lead = k > 0 ? h / (t[k + 1] - t[k - 1]) : 1, tail = after ? h / (t[k + 2] - t[k]) : 1;
  return a.map((x, i) => {
    const m = before ? (b[i] - before[i]) * lead : b[i] - x, n = after ? (after[i] - x) * tail : b[i] - x;
    return x + s * (m + s * (3 * (b[i] - x) - 2 * m - n + s * (m + n - 2 * (b[i] - x))));
  });
}

function columnAt(column, t, time) {
  const k = index(t, time), s = t.length > 1 ? (time - t[k]) / (t[k + 1] - t[k] || 1) : 0;
  return column[k] + Math.min(Math.max(s, 0), 1) * ((column[k + 1] ?? column[k]) - column[k]);
}

// -- drawing --------------------------------------------------------------------------------------------------------------

const visible = () => $("picture").clientWidth > 0 && $("picture").clientHeight > 0;

function render() {
  if (!visible()) return; // in a frame that is hidden
  const q = between(motion, time);
  view.clear();
  if (!q) return;
  for (const [name, points, colour] of traced) if (name) view.trace(points, colour);
  const ghosts = motion === motions[0] ? motions.slice(1) : motions.slice(0, 1);
  for (const ghost of ghosts) view.draw(between(ghost, Math.min(time, ghost.end)), 0.25, ["body", "force"]);
  view.draw(q, 1, null, isClosed);
  if ($("forces").checked) arrows(q);
  if ($("gaps").checked) gaps(q);
  if ($("labels").checked) view.names();
  timeline();
  if (group) plot.cursor(columnAt(over().along, motion.t, time), group.columns.map((c) => columnAt(c, motion.t, time)), group.log);
  const doubt = motion.moments.filter((m) => m[0] <= time && time <= m[1]);
  $("clock").textContent = `${time.toFixed(3)} s of ${motion.end.toFixed(2)}`;
  const bare = $("forces").checked && motion !== motions[0] && !motion.reactions && !motion.pulls ? ["forces are those of the recorded motion"] : [];
  $("hint").textContent = [...doubt.map((m) => m[3]), ...bare].join("; ");
  wanted = false;
  for (const each of drawn) each(q);
}

// Whether an item is a contact that is closed: its mode is among the curves, and in frames of a motion that is worked out.
function isClosed(item) {
  if (item.role !== "contact") return false;
  const name = `${item.name}.mode`, k = index(motion.t, time);
  if (!motion.whole) {
    const place = columns ? columns.names.indexOf(name) : -1;
    return place >= 0 && motion.values[k]?.[place] !== 0;
  }
  const part = motion.groups.find((g) => g.names.includes(name));
  return part ? part.columns[part.names.indexOf(name)][k] !== 0 : false;
}

function arrows(q) {
  const { reactions, pulls } = motion;
  const items = Object.fromEntries(data.scene.items.map((item) => [`${item.role} ${item.name}`, item]));
  const long = 0.16 * Math.min(view.camera.width, view.camera.height), d = view.spatial ? 3 : 2;
  if (reactions) {
    const most = largest(reactions, d);
    reactions.names.forEach((name, j) => {
      const item = items[`joint ${name}`];
      if (!item || !item.ends.length || !(most > 0)) return;
      const f = Array.from({ length: d }, (_, c) => columnAt(reactions.columns[j * d + c], motion.t, time));
      view.arrow(item.ends[0][0], item.ends[0][1], f, long / most, palette.reaction);
    });
  }
  if (pulls) {
    const most = largest(pulls, 1);
    pulls.names.forEach((name, j) => {
      const item = items[`force ${name}`], mark = item && item.marks.find((m) => m[0] === "X");
      if (!mark || !(most > 0)) return;
      const [, , , body, at, other, to] = mark, f = columnAt(pulls.columns[j], motion.t, time) / most;
      const a = worldOf(q, body, at), b = worldOf(q, other, to), l = Math.hypot(...b.map((x, i) => x - a[i])) || 1;
      const way = b.map((x, i) => (x - a[i]) / l);
      view.place(q);
      view.arrow(other, to, way.map((x) => x * f), long, palette.push);
      view.arrow(body, at, way.map((x) => -x * f), long, palette.push);
    });
  }
}

const worldOf = (q, body, at) => (body < 0 ? [...at, 0].slice(0, 3) : view.where(q, body, at));

function largest(part, d) {
  if (part.most === undefined) {
    part.most = 0;
    for (let j = 0; j < part.names.length; j++) for (let k = 0; k < motion.t.length; k++) {
      let sum = 0;
      for (let c = 0; c < d; c++) sum += (part.columns[j * d + c][k] || 0) ** 2;
      part.most = Math.max(part.most, Math.sqrt(sum));
    }
  }
  return part.most;
}

// Each joint by how far it is open itself: of a recording that is told, here it would be lost in the last bits.
const PINS = ["revolute", "spherical", "universal", "constant-velocity", "rigid"];
function gaps(q) {
  const told = motion.gaps;
  for (const item of data.scene.items) {
    if (item.role !== "joint" || item.ends.length !== 2 || !PINS.includes(item.kind)) continue;
    const [a, b] = item.ends.map(([body, at]) => worldOf(q, body, at)), seen = Math.hypot(...a.map((x, i) => b[i] - x));
    const k = told ? told.names.indexOf(item.name) : -1;
    const size = k < 0 ? Math.log10(Math.max(seen, 1e-17)) : columnAt(told.columns[k], motion.t, time); // the power of ten
    const hue = Math.round(120 * Math.min(Math.max((-4 - size) / 8, 0), 1)); // red from 1e-4 on, green below 1e-12
    view.gap(q, item.ends, seen > 0 ? (1000 * 10 ** size) / seen : 0, `hsl(${hue},90%,40%)`);
  }
}

function timeline() {
  const canvas = $("timeline"), [context, width, height] = sized(canvas);
  const x = (t) => 6 + ((t - motion.t[0]) / (motion.end - motion.t[0] || 1)) * (width - 12);
  context.fillStyle = palette.track;
  context.fillRect(6, 12, width - 12, 10);
  if (motion.status !== "ok") {
    context.fillStyle = motion.status === "failed" ? palette.failed : palette.doubtful;
    context.fillRect(6, 12, width - 12, 10);
  }
  context.fillStyle = palette.passed;
  context.fillRect(6, 12, x(time) - 6, 10);
  for (const [begin, end, kind] of motion.moments) {
    context.fillStyle = { rank: palette.reaction, event: palette.accent }[kind] || palette.push;
    context.fillRect(x(begin) - 1, 8, Math.max(2, x(end) - x(begin)), 18);
  }
  context.fillStyle = palette.ink;
  context.fillRect(x(time) - 2, 6, 4, 22);
  canvas.setAttribute("aria-valuenow", time.toFixed(3));
  canvas.setAttribute("aria-valuemax", motion.end.toFixed(3));
}

// -- time -----------------------------------------------------------------------------------------------------------------

function go(to) {
  time = Math.min(Math.max(to, motion.t[0] || 0), motion.t[motion.t.length - 1] || 0);
  wanted = true;
}

function play(on) {
  if (on && time >= motion.end - 1e-9) go(0);
  playing = on;
  $("play").classList.toggle("playing", on);
  $("play").setAttribute("aria-label", on ? "Pause" : "Play");
}

function tick(now) {
  const passed = Math.min((now - last) / 1000, 0.1);
  last = now;
  if (!motion.whole) compute(8);
  else if (ranges) workOutRanges(6);
  if (playing) {
    const end = motion.t[motion.t.length - 1] || 0;
    let to = time + passed * speed;
    if (to > end) {
      if (!motion.whole) to = end; // wait until it is worked out
      else if ($("loop").checked) to = motion.t[0];
      else {
        to = end;
        play(false);
      }
    }
    go(to);
  }
  if (wanted) render();
  requestAnimationFrame(tick);
}

function traces() {
  const chosen = $("trace").value, list = chosen === "all" ? data.points : data.points.filter((p) => (chosen === "free" ? p[3] : p[0] === chosen));
  view.forget();
  traced = list.map(([name, body, at], i) => [name, motion.rows.map((q) => view.where(q, body, at)), COLOURS[i % COLOURS.length]]);
  wanted = true;
}

function choose() {
  group = motion.groups[$("group").value] || null;
  $("plots").hidden = !group && motion.whole;
  $("plots").classList.toggle("waiting", !group);
  if (group) {
    if (single >= group.columns.length) single = null;
    plot.lines(group, over(), single);
  }
  wanted = true;
}

// What curves are drawn over: time, or a column of the motion by its name.
function over() {
  const name = $("over").value, part = name && motion.groups.find((g) => g.names.includes(name));
  if (!part) return { t: motion.t, along: motion.t, label: "t [s]", ends: [motion.t[0], motion.end] };
  const along = part.columns[part.names.indexOf(name)], sound = Array.from(along).filter(Number.isFinite);
  return { t: motion.t, along, label: `${name}${part.unit ? ` [${part.unit}]` : ""}`, ends: [Math.min(...sound), Math.max(...sound)] };
}

// Options of a list below headings; the one that was chosen before stays chosen.
function fill(select, options) {
  const before = select.value;
  select.textContent = "";
  for (const [section, text, value] of options) {
    let box = select;
    if (section) {
      box = [...select.children].find((each) => each.label === section) || element("optgroup");
      if (!box.label) select.append(Object.assign(box, { label: section }));
    }
    box.append(new Option(text, value));
  }
  if (options.some((option) => option[2] === before)) select.value = before;
}

const titled = (g) => `${g.title}${g.unit ? ` [${g.unit}]` : ""}`;

// A motion that is not whole yet has no groups: those of the one before keep their places.
function show(next) {
  motion = next;
  if (motion.whole) {
    const select = $("group"), before = select.selectedOptions[0]?.textContent;
    fill(select, motion.groups.map((g, i) => [g.section, titled(g), String(i)]));
    const same = motion.groups.findIndex((g) => titled(g) === before);
    if (same >= 0) select.value = same;
    const columns = motion.groups.filter((g) => !g.log).flatMap((g) => g.names.map((name) => [titled(g), name, name]));
    fill($("over"), [["", "t", ""], ...columns]);
  }
  go(time);
  choose();
  traces();
}

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
  state = begun;
  clock = 0;
  const end = data.live.until, spacing = frameSpacing(end, data.live.step);
  follow = { t: [], rows: [], values: [], groups: [], moments: [], facts: [], status: "ok", end, spacing, whole: false };
  record(0, true);
  show(follow);
  return true;
}

function compute(budget) {
  const began = performance.now(), h = data.live.step;
  while (performance.now() - began < budget) {
    const next = follow.t.length * follow.spacing, due = next > follow.end - 1e-9 * h ? follow.end : next;
    while (clock < due - 1e-12 && performance.now() - began < 2 * budget) {
      const step = Math.min(h, due - clock);
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

// -- sliders --------------------------------------------------------------------------------------------------------------

let rows = [], ranges = null;
const element = (tag, text = "", name = "") => Object.assign(document.createElement(tag), { textContent: text, className: name });
const rounded = (x) => +x.toPrecision(4);

// One parameter: a slider between values with which the mechanism closes, and a field for any number, in the unit of the file.
function makeRow(parameter, i) {
  const x = parameter.value, own = parameter.shown ?? { unit: parameter.unit, factor: 1 }, reach = (x === 0 ? [-1, 1] : [0.25 * x, 4 * x]).sort((a, b) => a - b);
  const box = element("div", "", "slider"), name = element("span", parameter.name), unit = element("span", own.unit);
  const input = element("input"), field = element("input");
  name.title = parameter.name;
  Object.assign(input, { type: "range", min: 0, max: 400, step: 1 });
  Object.assign(field, { type: "number", step: 10 ** (Math.floor(Math.log10(Math.abs(x / own.factor) || 1)) - 1) });
  for (const each of [input, field]) each.setAttribute("aria-label", `${parameter.name} ${own.unit}`);
  input.dataset.name = field.dataset.name = parameter.name;
  const row = { i, name: parameter.name, unit: own.unit, follows: parameter.follows, box, input, field, reach, low: reach[0], high: reach[1] };
  const even = () => row.low * row.high > 0; // in equal factors
  const at = (share) => (even() ? row.low * (row.high / row.low) ** share : row.low + share * (row.high - row.low));
  row.show = () => {
    const value = live.p[i];
    field.value = rounded(value / own.factor);
    input.value = 400 * (even() ? Math.log(value / row.low) / Math.log(row.high / row.low) : (value - row.low) / (row.high - row.low));
  };
  row.limits = () => (row.low > reach[0] || row.high < reach[1] ? `It does from ${short(row.low / own.factor)} to ${short(row.high / own.factor)} ${row.unit}.` : "");
  const take = (value) => {
    live.setParameters([[i, value]]);
    rows.forEach((each) => each !== row && each.show());
    ranges = restart(row) ? ranging(row) : null;
  };
  input.addEventListener("input", () => {
    const value = at(input.value / 400);
    field.value = Math.min(Math.max(rounded(value / own.factor), row.low / own.factor), row.high / own.factor);
    take(field.valueAsNumber * own.factor);
  });
  field.addEventListener("change", () => {
    if (Number.isFinite(field.valueAsNumber)) take(field.valueAsNumber * own.factor);
    row.show();
  });
  box.append(name, input, field, unit);
  return row;
}

// Where the mechanism closes, from the value that a parameter has towards both ends of its slider, the others staying.
function* ranging(but = null) {
  for (const row of rows) {
    if (row === but) continue;
    const ends = [];
    for (const end of row.reach) {
      let [inside, outside] = [live.p[row.i], end];
      if ((outside - inside) * (end === row.reach[0] ? -1 : 1) <= 0) outside = inside; // it stands beyond the end
      else if (live.closes(row.i, end)) inside = outside;
      for (let k = 0; k < 8 && inside !== outside; k++) {
        yield;
        const middle = 0.5 * (inside + outside);
        if (live.closes(row.i, middle)) inside = middle;
        else outside = middle;
      }
      ends.push(inside);
      yield;
    }
    [row.low, row.high] = ends[0] < ends[1] ? ends : row.reach;
    row.show();
  }
}

function workOutRanges(budget) {
  const began = performance.now();
  while (ranges && performance.now() - began < budget) if (ranges.next().done) ranges = null;
}

// Many parameters of one unit, and those that follow from others by formulas, are folded away below the rest.
const MANY = 8, ALIKE = 3;
function sliders() {
  $("live").textContent = "";
  const box = $("live"), list = element("div", "", "list"), head = element("div", "", "head"), back = element("button", "As recorded");
  const closes = element("p");
  closes.id = "closes";
  closes.setAttribute("role", "status");
  head.append(element("span", `${data.live.method}, rk4 with steps of ${short(data.live.step)} s`, "small"), back);
  box.append(head, list, closes);
  rows = data.live.parameters.map((parameter, i) => (parameter.still ? null : makeRow(parameter, parameter.place ?? i))).filter(Boolean);
  box.hidden = !rows.length;
  const heading = (row) => (row.follows ? "from others" : row.unit ? `in ${row.unit}` : "without unit");
  const alike = (row) => rows.filter((other) => heading(other) === heading(row));
  const folded = rows.filter((row) => row.follows || (rows.length > MANY && alike(row).length >= ALIKE));
  rows.forEach((row) => folded.includes(row) || list.append(row.box));
  let seen = rows.length - folded.length;
  for (const own of [...new Set(folded.map(heading))].map((name) => folded.filter((row) => heading(row) === name))) {
    const fold = element("details");
    fold.append(element("summary", `${own.length} ${heading(own[0])}: ${own.map((row) => row.name).join(", ")}`), ...own.map((row) => row.box));
    fold.open = !own[0].follows && seen + own.length <= MANY;
    seen += fold.open ? own.length : 0;
    list.append(fold);
  }
  rows.forEach((row) => row.show());
  ranges = ranging();
  back.addEventListener("click", () => {
    live.reset();
    rows.forEach((each) => each.field.setAttribute("aria-invalid", false));
    rows.forEach((each) => each.show());
    ranges = ranging();
    $("closes").textContent = "";
    $("picture").classList.remove("stale");
    follow = null;
    show(motions[0]);
  });
}

// -- controls -------------------------------------------------------------------------------------------------------------

function facts() {
  $("facts").textContent = "";
  motion.facts.forEach(([label, text], i) => {
    const part = document.createElement("span");
    part.textContent = `${i ? " · " : ""}${label ? `${label} ` : ""}${text}`;
    if (label === "status" && text !== "ok") part.className = "bad";
    $("facts").append(part);
  });
  $("note").textContent = data.note;
}

// A motion of less than a second is slowed down until an eye can follow it.
const SPEEDS = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.25, 0.5, 1, 2, 5, 10];
for (const s of SPEEDS) $("speed").append(new Option(`${s}×`, s));
function pace() {
  speed = motion.end - time < 1 ? SPEEDS.filter((s) => motion.end - time >= 2 * s).pop() || SPEEDS[0] : 1;
  $("speed").value = speed;
}
// Points that no joint ties draw what a mechanism is for: the foot of a leg, the blade of a wiper.
function offerTraces() {
  const free = data.points.some((p) => p[3]), before = $("trace").value, first = !$("trace").length;
  fill($("trace"), [["", "none", ""], ...(free ? [["", "free points", "free"]] : []), ["", "all", "all"], ...data.points.map((p) => ["", p[0], p[0]])]);
  if (first || $("trace").value !== before) $("trace").value = free ? "free" : data.points.length <= 12 ? "all" : "";
}
$("speed").addEventListener("change", () => (speed = Number($("speed").value)));
$("trace").addEventListener("change", traces);
$("group").addEventListener("change", () => {
  single = null;
  choose();
});
$("over").addEventListener("change", choose);
$("play").addEventListener("click", () => play(!playing));
$("fit").addEventListener("click", refit);
for (const id of ["labels", "forces", "gaps"]) $(id).addEventListener("change", () => (wanted = true));

function retheme() {
  paintPage();
  view.dress();
  choose();
  traces();
}
$("theme").addEventListener("click", () => {
  theme = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
  retheme();
});
preferred.addEventListener("change", retheme);

function refit() {
  view.fit(motion.rows);
  wanted = true;
}

function drag(canvas, move) {
  const held = new Map();
  canvas.addEventListener("pointerdown", (e) => {
    canvas.setPointerCapture(e.pointerId);
    held.set(e.pointerId, [e.clientX, e.clientY]);
    move(e, 0, 0, null);
  });
  canvas.addEventListener("pointermove", (e) => {
    const before = held.get(e.pointerId);
    if (!before) return;
    let pinch = null;
    if (held.size === 2) {
      const other = [...held].find(([id]) => id !== e.pointerId)[1];
      pinch = Math.hypot(e.clientX - other[0], e.clientY - other[1]) / (Math.hypot(before[0] - other[0], before[1] - other[1]) || 1);
    }
    move(e, e.clientX - before[0], e.clientY - before[1], pinch);
    held.set(e.pointerId, [e.clientX, e.clientY]);
  });
  for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, (e) => held.delete(e.pointerId));
}

drag($("timeline"), (e) => {
  const box = $("timeline").getBoundingClientRect();
  go(motion.t[0] + ((e.clientX - box.left - 6) / (box.width - 12)) * (motion.end - motion.t[0]));
});
drag($("plot"), (e) => go(plot.timeAt(e.clientX - $("plot").getBoundingClientRect().left, time)));
drag($("view"), (e, dx, dy, pinch) => {
  const { camera } = view;
  if (pinch) {
    camera.scale *= pinch; // each finger moves the middle by half its way
    view.pan((-0.5 * dx) / camera.scale, (0.5 * dy) / camera.scale);
  } else if (view.spatial && !e.shiftKey && e.button !== 2) {
    camera.turn += 0.01 * dx;
    camera.tilt = Math.min(Math.max(camera.tilt + 0.01 * dy, -1.57), 1.57);
  } else {
    view.pan(-dx / camera.scale, dy / camera.scale);
  }
  wanted = true;
});
$("view").addEventListener("wheel", (e) => {
  e.preventDefault();
  view.camera.scale *= Math.exp(-0.0015 * e.deltaY);
  wanted = true;
}, { passive: false });

window.addEventListener("keydown", (e) => {
  if (["SELECT", "INPUT", "BUTTON", "TEXTAREA"].includes(e.target.tagName) && e.target.type !== "checkbox") return;
  const frame = (motion.end - motion.t[0]) / 100;
  const act = {
    " ": () => play(!playing), ArrowRight: () => go(time + frame), ArrowLeft: () => go(time - frame),
    Home: () => go(motion.t[0]), End: () => go(motion.end), 0: refit, l: () => $("loop").click(),
    f: () => $("forces").click(), g: () => $("gaps").click(), n: () => $("labels").click(), d: () => $("theme").click(),
    "+": () => faster(1), "-": () => faster(-1),
  }[e.key];
  if (!act) return;
  e.preventDefault();
  act();
});

function faster(by) {
  const select = $("speed");
  select.selectedIndex = Math.min(Math.max(select.selectedIndex + by, 0), select.length - 1);
  speed = Number(select.value);
}

window.addEventListener("resize", () => {
  refit();
  choose();
});
// A frame that was hidden when the page began gets its size without a word.
let wasVisible = visible();
new ResizeObserver(() => {
  if (visible() && !wasVisible) {
    refit();
    choose();
  }
  wasVisible = visible();
}).observe($("picture"));

// -- for scripts ------------------------------------------------------------------------------------------------------------

window.symgen = {
  get t() { return Array.from(motions[0].t); },
  get q() { return motions[0].rows.map((row) => Array.from(row)); },
  get names() { return data.names; },
  get live() { return Boolean(live); },
  get step() { return live ? data.live.step : null; },
  get parameters() { return live ? data.live.parameters.map((x) => x.name) : []; },
  get state() { return live ? data.live.state : []; },
  get y0() { return live ? data.live.y0 : null; },
  get rates() { return live ? live.rates : null; },
  // The state at the end of a run with parameters by name, by steps of the classical Runge-Kutta method.
  run(values = {}, until = motions[0].end, step = data.live.step) {
    for (const x of data.live.parameters) if (x.still && x.name in values) throw new Error(`${x.name} keeps its value in this page`);
    const places = new Map(data.live.parameters.map((x, i) => [x.name, x.place ?? i]));
    live.setParameters(Object.entries(values).map(([name, x]) => [places.get(name), x]));
    const y = live.start(), count = Math.round(until / step);
    let why = y && y.every(Number.isFinite) ? "" : "the mechanism does not close with these parameters";
    for (let k = 0; k < count && !why; k++) {
      if (!live.step(k * step, y, step)) {
        const end = live.end(y);
        if (end.failed) why = end.sentence;
        break;
      } else if ((k % 20 === 19 || k === count - 1) && live.open((k + 1) * step, y)) why = `the joints are open at t = ${short((k + 1) * step)} s: steps of ${short(step)} s are too long, or no motion goes on from there`;
    }
    live.reset();
    if (why) throw new Error(why);
    return Array.from(y);
  },
  // The groups of curves of the motion that is shown, and one of their columns by its name.
  groups: () => motion.groups.map((g) => ({ section: g.section, title: g.title, unit: g.unit, names: g.names, log: g.log })),
  column(name) {
    const part = motion.groups.find((g) => g.names.includes(name));
    return part ? { t: Array.from(motion.t), values: Array.from(part.columns[part.names.indexOf(name)]) } : null;
  },
  // The moments on the time axis of the motion that is shown: begin, end, kind and words.
  moments: () => motion.moments.map((m) => [...m]),
  // Look from elsewhere: turned and tilted [rad], with a point in the middle [m].
  look(turn, tilt, at) {
    Object.assign(view.camera, { turn, tilt, at });
    wanted = true;
  },
  // Draw the frame at a share of the whole motion; milliseconds that took.
  frame(share) {
    const began = performance.now();
    go(motion.t[0] + share * (motion.end - motion.t[0]));
    render();
    return performance.now() - began;
  },
  // How far each joint is open at a share of the motion, as powers of ten [m], by name; of recordings.
  gaps(share) {
    const t = motion.t[0] + share * (motion.end - motion.t[0]), told = motions[0].gaps;
    return told ? Object.fromEntries(told.names.map((name, k) => [name, columnAt(told.columns[k], motions[0].t, t)])) : null;
  },
  // Between which values the slider of each parameter goes, by name.
  limits() {
    workOutRanges(Infinity);
    return Object.fromEntries(rows.map((row) => [row.name, [row.low, row.high]]));
  },
  // Seconds of motion that the live part works out in one second.
  pace(milliseconds = 300) {
    const y = live.start(), began = performance.now();
    let t = 0;
    while (performance.now() - began < milliseconds) {
      live.step(t, y, data.live.step);
      t += data.live.step;
    }
    live.reset();
    return (1000 * t) / (performance.now() - began);
  },
};

// What is shown of data from its beginning.
function begin(code) {
  enliven(code);
  facts();
  offerTraces();
  $("forcesBox").hidden = !(motion.reactions || motion.pulls);
  if (live) sliders();
  else $("live").hidden = true;
}

begin({ emitted, makeLive, observed, makeColumns: observed ? makeColumns : null });
pace();
view.fit(motion.rows);
show(motion);
requestAnimationFrame((now) => {
  last = now;
  tick(now);
});
