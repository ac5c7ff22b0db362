// Columns of the motion that the page works out: rates, multipliers, reactions, elements, points, outputs, energies.

function makeColumns(live, code, spec, functions) {
  const { p, w, iw } = live, { sources, status, dimension } = spec, { jacobian, m, at } = live.spec;
  const entries = Object.entries(spec.tables).flatMap(([table, list]) => list.map(([name, unit, source, column]) => ({ table, name, unit, source, column })));
  const place = new Map(entries.map((entry, i) => [entry.name, i]));
  const room = Object.fromEntries(Object.keys(functions).map((name) => [name, new Float64Array(name === "observe" ? spec.observed : 6 * spec.joints.length + entries.length)]));
  const seen = new Float64Array(spec.nq + 2 * spec.nv), ydot = new Float64Array(live.spec.ny);
  const components = ["Fx", "Fy", "Fz", "Mx", "My", "Mz"];
  let first = null; // energy less work at the first frame

  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const turned = (r, x) => r.map((row) => dot(row, x));
  const back = (r, x) => [0, 1, 2].map((i) => r[0][i] * x[0] + r[1][i] * x[1] + r[2][i] * x[2]);

  function axesOf(q, body) {
    const [i, n] = body < 0 ? [0, 0] : spec.bodies[body];
    if (n === 3 && dimension === 2) {
      const [c, s] = [Math.cos(q[i + 2]), Math.sin(q[i + 2])];
      return [[c, -s, 0], [s, c, 0], [0, 0, 1]];
    }
    if (n !== 7) return [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
    const size = Math.hypot(q[i + 3], q[i + 4], q[i + 5], q[i + 6]), [a, b, c, d] = [3, 4, 5, 6].map((k) => q[i + k] / size);
    return [
      [1 - 2 * (c * c + d * d), 2 * (b * c - a * d), 2 * (b * d + a * c)],
      [2 * (b * c + a * d), 1 - 2 * (b * b + d * d), 2 * (c * d - a * b)],
      [2 * (b * d - a * c), 2 * (c * d + a * b), 1 - 2 * (b * b + c * c)],
    ];
  }

  // Force, and moment about the centre of mass, of generalised forces on a body.
  function onBody(q, body, g) {
    const [, , v, n] = spec.bodies[body], force = [g[v], g[v + 1], dimension === 3 ? g[v + 2] : 0];
    if (dimension === 2) return [force, [0, 0, n === 3 ? g[v + 2] : 0]];
    return [force, n === 6 ? turned(axesOf(q, body), [g[v + 3], g[v + 4], g[v + 5]]) : [0, 0, 0]];
  }

  // On the ground: what balances the joint's forces on all bodies, about the origin.
  function onGround(q, g, moved) {
    const force = [0, 0, 0], moment = [0, 0, 0];
    for (const body of moved) {
      const [i] = spec.bodies[body], [f, c] = onBody(q, body, g), arm = cross([q[i], q[i + 1], dimension === 3 ? q[i + 2] : 0], f);
      for (let k = 0; k < 3; k++) {
        force[k] -= f[k];
        moment[k] -= c[k] + arm[k];
      }
    }
    return [force, moment];
  }

  // Entries of D in the rows of each joint, and the bodies that it moves.
  const shares = spec.joints.map(() => []), forces = new Float64Array(spec.nv);
  for (const share of jacobian) if (spec.joint_of_row[share[0]] >= 0) shares[spec.joint_of_row[share[0]]].push(share);
  const bodyOf = spec.bodies.flatMap(([, , , n], body) => Array(n).fill(body));
  const moved = shares.map((list) => [...new Set(list.map(([, column]) => bodyOf[column]))].sort((a, b) => a - b));
  spec.joints.forEach(([, body], j) => body >= 0 && !moved[j].includes(body) && moved[j].push(body));

  // -D^T lambda of each joint on its first body, about its own point, in ground axes and in those of the body.
  function reactions(q, entry, lambda, seats) {
    return spec.joints.map(([, body, point, centre], j) => {
      for (const each of moved[j]) forces.fill(0, spec.bodies[each][2], spec.bodies[each][2] + spec.bodies[each][3]);
      for (const [row, column, constant, slot] of shares[j]) forces[column] -= (slot === null ? constant : entry[slot]) * lambda[row];
      const [force, about] = body < 0 ? onGround(q, forces, moved[j]) : onBody(q, body, forces), r = axesOf(q, body);
      const own = [0, 1, 2].map((k) => (point < 0 || k >= dimension ? 0 : seats[point + k] - (centre < 0 ? 0 : seats[centre + k])));
      const arm = cross(turned(r, own), force), moment = about.map((x, k) => x - arm[k]);
      return { ground: [...force, ...moment], body: [...back(r, force), ...back(r, moment)], F: Math.hypot(...force), T: Math.hypot(...moment) };
    });
  }

  // Multipliers of least norm that exert the same forces, where rows depend on others: the part along rows of D^T.
  function leastMultipliers(entry, lambda) {
    const weight = live.spec.rows.map((isLength) => (isLength ? 1 : w[status.length]));
    const rows = Array.from({ length: spec.nv }, () => new Float64Array(m));
    for (const [row, column, constant, slot] of jacobian) rows[column][row] = Math.sqrt(w[at.gauge + column]) * (slot === null ? constant : entry[slot]) * weight[row];
    const result = new Float64Array(m), along = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
    const f = Float64Array.from(lambda, (x, i) => x / weight[i]);
    const least = 1e-6 * Math.sqrt(Math.max(...rows.map((row) => along(row, row))));
    for (const left = new Set(rows); left.size;) {
      const row = [...left].reduce((a, b) => (along(b, b) > along(a, a) ? b : a)), size = Math.sqrt(along(row, row));
      if (!(size > least)) break;
      left.delete(row);
      const unit = row.map((x) => x / size), share = along(unit, f);
      for (let i = 0; i < m; i++) result[i] += share * unit[i];
      for (const other of left) {
        const common = along(unit, other);
        for (let i = 0; i < m; i++) other[i] -= common * unit[i];
      }
    }
    return result.map((x, i) => x * weight[i]);
  }

  // Which joint's reaction a column has, on its first body in axes of the ground or its own, and which component.
  const placed = entries.map(({ name, source }) => {
    const cut = name.lastIndexOf("."), label = name.slice(cut + 1), owner = name.slice(0, cut).replace(source === sources.BODY ? /\.body$/ : "", "");
    return [spec.joints.findIndex(([joined]) => joined === owner), source === sources.MAGNITUDE ? label : components.indexOf(label === "M" ? "Mz" : label)];
  });

  // Whether a function is one of the state, not of bodies.
  const at_state = (name) => Boolean(spec.of_state?.includes(name));

  // All columns at a state; `begin` at the first one, which steps have not accepted.
  function values(t, y, begin) {
    const kept = [w.slice(), iw.slice()], joint = live.spec.joint;
    if (begin) code.accept(t, y.slice(), p, w, iw);
    const state = [status.kinetic, status.potential].map((i) => w[i]), measured = w.slice(0, 8);
    live.rhs(t, y, ydot);
    let q = y, a = ydot, v = spec.nq, lambda = [], of = [];
    if (joint) {
      code.bodies(t, y, p, w, ydot, seen);
      [q, a, v] = [seen, seen, spec.nq + spec.nv];
    } else if (m) {
      lambda = w.slice(spec.multipliers, spec.multipliers + m);
      code.geometry(t, y, p, w);
      const entry = w.subarray(at.jacobian);
      if (spec.rank >= 0 && (spec.redundant || measured[status.rank] < spec.rank)) lambda = leastMultipliers(entry, lambda);
      w.set(lambda, spec.multipliers);
      if (functions.seats) functions.seats(t, y, p, w, ydot, room.seats);
      of = reactions(q, entry, lambda, room.seats);
    }
    const rates = joint ? Float64Array.from({ length: spec.nq + spec.nv }, (_, i) => (i < spec.nq ? 0 : seen[spec.nv + i])) : ydot;
    for (const [name, f] of Object.entries(functions)) if (name !== "seats") f(t, at_state(name) ? y : q, p, w, at_state(name) ? ydot : rates, room[name]);
    const work = y[spec.work], total = state[0] + state[1], energy = total - work;
    if (begin) first = energy;
    w.set(kept[0]);
    iw.set(kept[1]);
    return Float64Array.from(entries, ({ table, name, source, column }, i) => {
      if (name === "energy.work") return work;
      if (source === sources.STATE) return q[column];
      if (source === sources.STATUS) return measured[column];
      if (source === sources.ENERGY) return total;
      if (source === sources.ENERGY_ERROR) return energy - first;
      if (source === sources.ACCELERATION) return a[v + column];
      if (source === sources.MULTIPLIER) return lambda[column];
      if (source === sources.JOINT) return room.observe[m + column];
      if (source === sources.SIDE) return room[table][column];
      if (name === "violation.acceleration") return Math.hypot(...room.observe.subarray(0, m));
      const [joint, component] = placed[i], found = of[joint];
      if (!found) return 0;
      if (source === sources.MAGNITUDE) return found[component];
      return (source === sources.BODY ? found.body : found.ground)[component];
    });
  }

  return { names: entries.map((entry) => entry.name), place, values };
}
