// -- sliders of a mechanism whose motions the server works out ---------------------------------------------------------------

// Code of many bodies would be too long for a page: their sliders write into the text, as a hand that drags a point does.
let steering = null; // the number that a hand is changing: where it is in which text

function steer() {
  if (steering) return;
  const box = $("live"), list = element("div", "", "list"), names = Object.keys(numbers);
  box.textContent = "";
  box.append(list);
  for (const name of names) list.append(steeringRow(name));
  box.hidden = !names.length;
  box.inert = false;
}

function steeringRow(name) {
  const box = element("div", "", "slider"), label = element("span", name), input = element("input"), field = element("input"), unit = numberUnits[name] || "";
  const value = Number(T.value.slice(...numbers[name]).replaceAll("_", "")), [low, high] = (value === 0 ? [-1, 1] : [0.25 * value, 4 * value]).sort((a, b) => a - b), even = low * high > 0;
  const at = (share) => (even ? low * (high / low) ** share : low + share * (high - low));
  Object.assign(input, { type: "range", min: 0, max: 400, step: 1, value: 400 * (even ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low)) });
  Object.assign(field, { type: "number", step: 10 ** (Math.floor(Math.log10(Math.abs(value) || 1)) - 1), value });
  for (const each of [input, field]) each.setAttribute("aria-label", `${name} ${unit}`);
  input.dataset.name = field.dataset.name = label.title = name;
  input.addEventListener("input", () => {
    if (!steering && checkedText !== T.value) return; // places of numbers are not known yet
    steering ||= { text: T.value, span: numbers[name] };
    field.value = rounded(at(input.value / 400));
    preview(steered(field.valueAsNumber));
  });
  box.addEventListener("change", (e) => {
    e.stopPropagation();
    if (!steering && checkedText !== T.value) return;
    const from = steering || { text: T.value, span: numbers[name] };
    steering = from;
    const text = Number.isFinite(field.valueAsNumber) ? steered(field.valueAsNumber) : from.text;
    steering = null;
    T.value = from.text;
    setText(text);
  });
  box.append(label, input, field, element("span", unit));
  return box;
}

function steered(value) {
  const { text, span } = steering, before = text.slice(...span), now = String(value);
  return text.slice(0, span[0]) + (/[.e]/i.test(before) && !/[.e]/i.test(now) ? `${now}.0` : now) + text.slice(span[1]);
}
