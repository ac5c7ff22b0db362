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
    dropHand();
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
