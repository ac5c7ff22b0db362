// The emitted equations at work in the page: the start for changed parameters, steps of Runge and Kutta, corrections.

function makeLive(spec, code) {
  const { nq, nv, ny, m, at } = spec;
  const { p, w, iw, prepare, setParameters, rhs, rates, reset, keep } = makeRates(spec, code);

  // What functions of the runtime take: parameters, scratch, counters and working memory.
  const memory = code.newMemory(p, w, iw), modes = spec.modes;
  const initial = modes ? modes.initial : {};
  for (const [name, array] of Object.entries(memory)) {
    for (const [i, x] of initial[name] || []) array[i] = x === null ? Infinity : x;
  }

  // -- the start ------------------------------------------------------------------------------------------------------

  // The largest coordinate that is a length, measured from the datum.
  function extent(y) {
    let size = 0;
    for (let i = 0; i < nq; i++) if (spec.lengths[i]) size = Math.max(size, Math.abs(y[i] - spec.datum[i]));
    return size;
  }

  // The start of a run, closed from the described one, or from the one of the page; null where it does not close.
  function close() {
    const { y, start_velocities } = memory;
    code.begin_row(memory, spec.y0);
    prepare();
    code.describe(p, y, start_velocities, y.subarray(nq + nv + 1));
    if (code.close_row(memory) !== 0) return null;
    if (modes) return y.slice();
    w[spec.status.step] = spec.step;
    return code.accept(0, y, p, w, iw) & 1 ? null : y.slice();
  }

  // The same, with the modes of rows with bounds.
  function start() {
    const y = close();
    if (!y || !modes) return y;
    told = 0;
    code.start_run(memory);
    if (code.foresee_run) code.foresee_run(memory, 1, 0);
    const failed = code.advance_run(memory, 0, spec.step, 0) === 2;
    stand();
    return failed ? null : memory.y.slice();
  }

  // Whether it closes with another value of one parameter; the parameters stay as they are.
  function closes(i, x) {
    const back = keep();
    setParameters([[i, x]]);
    const y = close();
    back();
    return Boolean(y) && y.every(Number.isFinite);
  }

  // Whether the joints are open at a state, by more than what corrections of sound steps leave.
  function open(t, y) {
    if (!m) return false;
    const back = keep(), length = w[spec.status.length], most = 1e-3 * Math.max(length, extent(y));
    code.geometry(t, y, p, w);
    const gaps = Array.from({ length: m }, (_, i) => Math.abs(w[at.residual + i]) * (spec.rows[i] ? 1 : length));
    back();
    return !gaps.every((gap) => gap <= most);
  }

  // -- steps ----------------------------------------------------------------------------------------------------------

  // A step; whether the motion goes on behind it. Events happen at their times.
  let result = 0;
  function step(t, y, h) {
    if (modes) return stepInModes(t, y, h);
    memory.step_clock[0] = t;
    result = code.take_steps(memory, t + h, 2 * h, y);
    return result === 0;
  }

  // The scratch of the run, which may stand at the end of a step behind what is shown; the page has the measures of that.
  const own = { w: new Float64Array(w.length), iw: new Float64Array(iw.length) };
  function stand() {
    own.w.set(w);
    own.iw.set(iw);
    w.set(memory.run_status.subarray(0, modes.status));
  }

  // The loop of runs: no step of it is shortened for the end of this one.
  function stepInModes(t, y, h) {
    const { run_shown, run_times, run_clock } = memory, near = 1e-9 * spec.step;
    const to = Math.abs(t + h - run_clock[0]) < near ? run_clock[0] : t + h; // the end of a step but for rounding
    w.set(own.w);
    iw.set(own.iw);
    const changed = y.subarray(0, ny).some((x, i) => x !== memory.y[i]);
    memory.y.set(y.subarray(0, ny));
    run_shown[0] = Math.abs(t - run_times[0]) < near ? run_times[0] : t;
    if (changed || to < run_clock[0] || run_shown[0] !== run_times[0]) forgetAfter(run_shown[0]);
    result = 0;
    while (code.foresee_run && result === 0 && to > memory.seam_known[0]) { // formulas jump at times known up to there
      result = code.advance_run(memory, 0, spec.step, memory.seam_known[0]);
      if (result === 0 && !code.foresee_run(memory, 0, run_shown[0])) break;
    }
    if (result === 0) result = code.advance_run(memory, 1, spec.step, to);
    stand();
    y.set(memory.y);
    return result === 0;
  }

  // A run that goes on from what is shown makes its later transitions again.
  function forgetAfter(t) {
    const { transitions_count, transitions_times } = memory;
    while (transitions_count[0] > 0 && transitions_times[(transitions_count[0] - 1) % modes.kept] > t) transitions_count[0] -= 1;
  }

  // Transitions since the last call up to what is shown: times and names. The run may stand at later ones.
  let told = 0;
  function transitions() {
    if (!modes) return [];
    const count = memory.transitions_count[0], found = [], latest = memory.run_shown[0] + 1e-9 * spec.step;
    for (told = Math.max(told, count - modes.kept); told < count; told++) {
      const at = told % modes.kept, row = modes.rows[memory.transitions_rows[at]];
      if (memory.transitions_times[at] > latest) break;
      found.push({ t: memory.transitions_times[at], name: `${row}.${modes.words[memory.transitions_words[at]]}` });
    }
    return found;
  }

  // The time where the motion has ended in the last step, and why; whether it has failed there.
  function end(y) {
    const t = modes ? memory.run_shown[0] : memory.step_clock[0], at_t = `at t = ${Number(t.toPrecision(6))} s`;
    const event = spec.events[modes ? memory.run_numbers[1] : memory.step_ending[0]];
    if (event) return { t, failed: false, sentence: `the event '${event}' ends the motion ${at_t}` };
    return { t, failed: true, sentence: sentence(t, y, at_t) };
  }

  // The sentence on the end of a motion: where drivers lock, what would have to jump.
  function sentence(t, y, at_t) {
    if (!code.find_lock || !code.find_lock(memory, t, y)) return `the motion cannot be continued ${at_t}`;
    const drivers = [...new Set(spec.drivers.filter((name, i) => memory.lock_drivers[i]))];
    const names = Array.from(memory.lock_named).filter((j) => j >= 0).map((j) => spec.moving[j]).join(", ");
    return `dead centre ${at_t}: ${drivers.map((name) => `'${name}'`).join(" and ")} can go no further; ${names} would have to jump`;
  }

  // Coordinates of bodies at a state; of the joints of a tree they are worked out by emitted code.
  const seen = new Float64Array(spec.nb + 2 * spec.nbv), unused = new Float64Array(ny);
  function bodies(t, y) {
    if (!spec.joint) return Array.from(y.subarray(0, nq));
    code.bodies(t, y, p, w, unused, seen);
    return Array.from(seen.subarray(0, spec.nb));
  }

  // -- a hand ---------------------------------------------------------------------------------------------------------

  // A spring and a damper from the ground to a point of a body; without one, the body is let go.
  let taken = null;
  const springOf = (name) => spec.hand.bodies.find(([own]) => own === name).slice(1);
  function pull(hand) {
    const values = (taken || []).map((i) => [i, 0]);
    taken = hand ? springOf(hand.name) : null;
    if (hand) values.push(...spec.hand.at.map((i, k) => [i, hand.at[k]]), ...spec.hand.to.map((i, k) => [i, hand.to[k]]), [taken[0], hand.k], [taken[1], hand.c]);
    if (values.length) setParameters(values);
  }

  // Coordinates of bodies now, and a little later if they were at rest and a force of 1 N along an axis worked on a
  // point alone; and how long that is, by the acceleration of the point [s2].
  function responded(t, y, name, at, axis) {
    const back = keep(), before = taken, far = 1e6 * w[spec.status.length], z = y.slice(0, ny), ydot = new Float64Array(ny);
    const to = spec.hand.to.map((_, k) => (k === axis ? far : 0)); // so far away that the force is the same everywhere
    const accelerations = (k) => {
      pull({ name, at, to, k, c: 0 });
      rhs(t, z, ydot);
      return ydot.slice(nq, nq + nv);
    };
    const without = accelerations(0), change = accelerations(1 / far).map((x, i) => x - without[i]), size = Math.max(...change.map(Math.abs));
    z.set(change.map((x) => x / size), nq);
    rhs(t, z, ydot);
    const rates = ydot.slice(0, nq), little = 1e-6 / Math.max(...rates.map(Math.abs));
    back();
    taken = before;
    z.set(y.subarray(0, ny));
    const now = bodies(t, z);
    for (let i = 0; i < nq; i++) z[i] += little * rates[i];
    return [now, bodies(t, z), little / size];
  }

  return { spec, p, w, iw, rhs, rates, start, closes, open, step, end, transitions, bodies, setParameters, reset, pull, responded };
}
