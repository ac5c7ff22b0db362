// The emitted right-hand side at work in a page: parameters, scratch, rates of states.

function makeRates(spec, code) {
  const { ny } = spec;
  const p = Float64Array.from(spec.p0);
  const w = new Float64Array(spec.nw);
  const iw = new Float64Array(16);
  const independent = new Set(spec.independent); // parameters that do not follow their formulas

  function scratch() {
    w.fill(0);
    for (const [i, x] of spec.w0) w[i] = x;
    for (const i of spec.masked) w[i] = Infinity;
    iw.fill(0);
  }

  function prepare() {
    code.derive(p, independent);
    code.prepareModel(p);
    code.prepareLaw(p);
    code.masses(p, w);
  }

  function setParameters(values) {
    for (const [i, x] of values) {
      p[i] = x;
      independent.add(i);
    }
    prepare();
  }

  function rhs(t, y, ydot) {
    if (!code.rhs(t, y, p, w, iw, ydot)) return;
    if (code.confirm) {
      iw[0] = 1;
      code.confirm(t, y, p, w, iw, ydot);
      iw[0] = 0;
    }
  }

  // The state's rates; other values of parameters replace those of the page for this one call.
  function rates(t, y, values) {
    const ydot = new Float64Array(ny), kept = p.slice(), state = new Float64Array(ny);
    state.set(Array.from(y).slice(0, ny));
    if (values) {
      for (let i = 0; i < spec.parameters.length; i++) if (values[i] !== undefined) p[spec.parameters[i].place ?? i] = values[i];
      code.prepareModel(p);
      code.prepareLaw(p);
      code.masses(p, w);
    }
    rhs(t, state, ydot);
    if (values) {
      p.set(kept);
      code.masses(p, w);
    }
    return Array.from(ydot);
  }

  // What puts parameters and scratch back as they are now.
  function keep() {
    const before = [p.slice(), [...independent], w.slice(), iw.slice()];
    return () => {
      p.set(before[0]);
      independent.clear();
      before[1].forEach((i) => independent.add(i));
      w.set(before[2]);
      iw.set(before[3]);
      code.prepareModel(p);
      code.prepareLaw(p);
    };
  }

  function reset() {
    independent.clear();
    for (const i of spec.independent || []) independent.add(i);
    p.set(spec.p0);
    scratch();
    prepare();
  }

  reset();
  return { p, w, iw, prepare, setParameters, rhs, rates, reset, keep };
}
