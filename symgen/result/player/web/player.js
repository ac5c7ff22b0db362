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
  // The state at the end of a run with parameters by name, by steps of the classical Runge-Kutta method. Hands pull from
  // a time on: { t, hand: { name, at, to, k, c } }, or let go where `hand` is null.
  run(values = {}, until = motions[0].end, step = data.live.step, hands = []) {
    for (const x of data.live.parameters) if (x.still && x.name in values) throw new Error(`${x.name} keeps its value in this page`);
    const places = new Map(data.live.parameters.map((x, i) => [x.name, x.place ?? i]));
    live.setParameters(Object.entries(values).map(([name, x]) => [places.get(name), x]));
    const y = live.start(), count = Math.round(until / step);
    let why = y && y.every(Number.isFinite) ? "" : "the mechanism does not close with these parameters";
    let handed = 0;
    for (let k = 0; k < count && !why; k++) {
      while (handed < hands.length && hands[handed].t <= (k + 1e-9) * step) live.pull(hands[handed++].hand);
      if (!live.step(k * step, y, step)) {
        const end = live.end(y);
        if (end.failed) why = end.sentence;
        break;
      } else if ((k % 20 === 19 || k === count - 1) && live.open((k + 1) * step, y)) why = `the joints are open at t = ${short((k + 1) * step)} s: steps of ${short(step)} s are too long, or no motion goes on from there`;
    }
    live.pull(null);
    live.reset();
    if (why) throw new Error(why);
    return Array.from(y);
  },
  // What pulls a body now, and the force of the spring [N]; null where nothing does.
  get hand() { return hand && hand.k ? { ...hand, ...pullNow(between(motion, time)) } : null; },
  // Where the middle of a body is now, in the ground frame [m].
  now: (name) => worldOf(between(motion, time), numberOf(name), middleOf(name)).slice(0, view.spatial ? 3 : 2),
  // What pulled in the motion that is shown: from when on, and with which spring.
  get hands() { return (motion.hands || []).map((each) => ({ ...each })); },
  // Where a point of the ground frame is on the picture, from its left upper corner [pixel].
  place: (point) => view.onScreen(point).slice(0, 2),
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
