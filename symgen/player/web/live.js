// The emitted equations at work in the page: the start for changed parameters, steps of Runge and Kutta, corrections.

function makeLive(spec, code) {
  const { nq, nv, ny, m, at } = spec;
  const { p, w, iw, prepare, setParameters, rhs, rates, reset, keep } = makeRates(spec, code);
  const dual = new Float64Array(m);

  // What functions of the runtime take: parameters, scratch, counters and working memory.
  const memory = { p, w, iw };
  for (const [name, size] of spec.memory) memory[name] = new Float64Array(size);

  // -- the start ------------------------------------------------------------------------------------------------------

  function jacobian() {
    const d = Array.from({ length: m }, () => new Float64Array(nv));
    for (const [row, column, constant, slot] of spec.jacobian) d[row][column] = slot === null ? constant : w[at.jacobian + slot];
    return d;
  }

  // The change x of least length in the metric of `scale` with D x = right; rows that depend on others are left out.
  function leastNorm(d, right, scale) {
    const g = Array.from({ length: m }, (_, i) => Float64Array.from({ length: m }, (_, j) => {
      let sum = 0;
      for (let k = 0; k < nv; k++) sum += d[i][k] * d[j][k] * scale[k] * scale[k];
      return sum;
    }));
    const weight = g.map((row, i) => (row[i] > 0 ? 1 / Math.sqrt(row[i]) : 0));
    const a = g.map((row, i) => row.map((x, j) => x * weight[i] * weight[j]));
    const b = Float64Array.from(right, (x, i) => x * weight[i]);
    const order = [], left = new Set(a.keys());
    while (left.size) {
      let best = -1;
      for (const i of left) if (best < 0 || a[i][i] > a[best][best]) best = i;
      if (!(a[best][best] > 1e-12)) break;
      left.delete(best);
      order.push(best);
      for (const i of left) {
        const f = a[i][best] / a[best][best];
        if (f === 0) continue;
        for (const j of left) a[i][j] -= f * a[best][j];
        b[i] -= f * b[best];
      }
    }
    const z = new Float64Array(m);
    for (let k = order.length - 1; k >= 0; k--) {
      const i = order[k];
      let sum = b[i];
      for (let l = k + 1; l < order.length; l++) sum -= a[i][order[l]] * z[order[l]];
      z[i] = sum / a[i][i];
    }
    const x = new Float64Array(nv);
    for (let i = 0; i < m; i++) dual[i] = weight[i] * z[i];
    for (let k = 0; k < nv; k++) {
      for (let i = 0; i < m; i++) x[k] += d[i][k] * dual[i];
      x[k] *= scale[k] * scale[k];
    }
    return x;
  }

  // The largest coordinate that is a length, measured from the datum.
  function extent(y) {
    let size = 0;
    for (let i = 0; i < nq; i++) if (spec.lengths[i]) size = Math.max(size, Math.abs(y[i] - spec.datum[i]));
    return size;
  }

  // The start of a run, closed from the described one, or from the one of the page; null where it does not close.
  function start() {
    w.fill(0);
    for (const [i, x] of spec.scratch) w[i] = x;
    iw.fill(0);
    prepare();
    const { y, start_velocities } = memory;
    y.set(spec.y0);
    start_velocities.set(y.subarray(nq, nq + nv));
    y.fill(0, nq, nq + nv);
    code.describe(p, y, start_velocities, y.subarray(nq + nv + 1));
    if (code.close_row(memory) !== 0) return null;
    w[spec.status.step] = spec.step;
    return code.accept(0, y, p, w, iw) & 1 ? null : y.slice();
  }

  // Whether it closes with another value of one parameter; the parameters stay as they are.
  function closes(i, x) {
    const back = keep();
    setParameters([[i, x]]);
    const y = start();
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
    memory.step_clock[0] = t;
    result = code.advance(memory, t + h, 2 * h, y);
    return result === 0;
  }

  // The time where the motion has ended in the last step, and why; whether it has failed there.
  function end(y) {
    const t = memory.step_clock[0], at_t = `at t = ${Number(t.toPrecision(6))} s`;
    const event = result === spec.ended && spec.ends.find((name, i) => name && memory.chosen[i]);
    if (event) return { t, failed: false, sentence: `the event '${event}' ends the motion ${at_t}` };
    return { t, failed: true, sentence: sentence(t, y, at_t) };
  }

  // The sentence on the end of a motion: where drivers lock, what would have to jump.
  function sentence(t, y, at_t) {
    const length = w[spec.status.length];
    if (!spec.drivers.some(Boolean)) return `the motion cannot be continued ${at_t}`;
    code.geometry(t, y, p, w);
    const scale = Float64Array.from({ length: nv }, (_, j) => Math.sqrt(w[at.gauge + j]));
    const d = jacobian().map((row, i) => (spec.rows[i] ? row : row.map((x) => x * length)));
    const shortest = Math.min(...d.map((row) => row.reduce((sum, x, j) => sum + (x * scale[j]) ** 2, 0)).filter((x) => x > 0));
    let holding = Float64Array.from({ length: m }, (_, i) => 1 + i / m), change, size;
    for (let round = 0; round < 8; round++) { // inverse iteration: the combination of rows that vanishes first
      change = leastNorm(d, holding, scale);
      size = Math.hypot(...dual);
      holding = dual.map((x) => Math.abs(x) > 0 ? x / size : 0);
    }
    const most_held = Math.max(...holding.map(Math.abs));
    const drivers = [...new Set(spec.drivers.filter((name, i) => name && Math.abs(holding[i]) > 3e-5 * most_held))];
    if (!drivers.length || !(size * 1e-4 * shortest > 1)) return `the motion cannot be continued ${at_t}`;
    const jumps = Array.from(change, (x, j) => Math.abs(x) / scale[j]), most = Math.max(...jumps);
    const order = Array.from(jumps.keys()).sort((i, j) => jumps[j] - jumps[i]).filter((j) => jumps[j] > spec.counts * most);
    const names = order.slice(0, spec.most_named).map((j) => spec.moving[j]).join(", ");
    return `dead centre ${at_t}: ${drivers.map((name) => `'${name}'`).join(" and ")} can go no further; ${names} would have to jump`;
  }

  // Coordinates of bodies at a state; of the joints of a tree they are worked out by emitted code.
  const seen = new Float64Array(spec.nb + 2 * spec.nbv), unused = new Float64Array(ny);
  function bodies(t, y) {
    if (!spec.joint) return Array.from(y.subarray(0, nq));
    code.bodies(t, y, p, w, unused, seen);
    return Array.from(seen.subarray(0, spec.nb));
  }

  return { spec, p, rates, start, closes, open, step, end, bodies, setParameters, reset };
}
