// -- lengths and angles on the picture: of what is selected, or of everything; a click on one types another value ------------------

let dimensions = [], dimensionsAsked = "", typing = null; // typing: the name of the one that is being typed
const sizes = element("div"), sizesBox = element("label", "", "toggle"), allSizes = element("input");
sizes.id = "dimensions";
Object.assign(allSizes, { type: "checkbox", id: "sizes" });
sizesBox.append(allSizes, element("span", "dimensions"));
sizesBox.title = "Lengths and angles of all bodies; of what is selected they are there anyway";
allSizes.addEventListener("change", () => askDimensions());
$("picture").insertBefore(sizes, layer); // handles lie above

// Those of the text that is drawn; nothing is asked while a hand moves something.
async function askDimensions() {
  const part = allSizes.checked ? "" : selected, none = view.spatial || (!allSizes.checked && !/^(bodies|joints)\./.test(selected));
  const key = none || checkedText === null ? "" : `${part}\n${checkedText}`;
  if (key === dimensionsAsked || held || steering) return;
  dimensionsAsked = key;
  if (!key) dimensions = [];
  else {
    const answer = await post("dimensions", { text: checkedText, path: part });
    if (dimensionsAsked !== key) return;
    dimensions = answer.error ? [] : answer.dimensions;
  }
  typing = null;
  sizes.textContent = "";
  for (const each of dimensions) sizes.append(newDimension(each));
  wanted = true;
}

const inOwnUnit = ({ kind, value }) => (kind === "length" ? [+value.toPrecision(6), "m"] : [+((value * 180) / Math.PI).toPrecision(6), "°"]);

function newDimension(each) {
  const [number, unit] = inOwnUnit(each), what = `${each.kind} ${each.name.split(".").slice(1).join(" ")}`;
  const button = element("button", `${number}${unit === "m" ? " m" : unit}`, "dimension");
  button.title = each.name;
  button.setAttribute("aria-label", `${what}, ${number} ${unit === "m" ? "m" : "degrees"}${each.fixed ? ", decided by several numbers" : ", type another one"}`);
  button.setAttribute("aria-disabled", each.fixed);
  button.addEventListener("pointerdown", (e) => e.stopPropagation());
  button.addEventListener("click", () => {
    if (each.fixed) return say(`${each.name} follows from several numbers: change them in the text`);
    typing = each.name;
    const field = element("input", "", "dimension");
    field.value = String(number);
    field.setAttribute("aria-label", `${what} in ${unit === "m" ? "metres" : "degrees"}, Enter`);
    field.addEventListener("pointerdown", (e) => e.stopPropagation());
    field.addEventListener("keydown", (e) => {
      if (e.key !== "Enter" && e.key !== "Escape") return;
      e.preventDefault();
      e.stopPropagation();
      if (e.key === "Enter") setDimension(each.name, field.value);
      else leave(button, field);
    });
    field.addEventListener("blur", () => field.isConnected && leave(button, field));
    button.replaceWith(field);
    wanted = true;
    field.focus();
    field.select();
  });
  return button;
}

function leave(button, field) {
  if (typing === null) return; // it has gone already: what goes loses the focus
  typing = null;
  field.replaceWith(button);
  button.focus();
  wanted = true;
}

async function setDimension(name, value) {
  const text = checkedText, place = T.selectionStart;
  const answer = await post("dimension", { text, name, value });
  if (answer.error) return say(answer.error, true);
  if (T.value !== text) return;
  dimensionsAsked = "again";
  setText(answer.text, place);
  say(`${name} is ${value}`);
}

// Lines with arrows beside bodies, arcs from the direction of x; they stand where the mechanism starts.
const BESIDE = 26, ARC = 34; // pixels
function drawDimensions() {
  const shown = atStart() && !held && dimensions.length > 0;
  sizes.hidden = !shown;
  if (!shown) return;
  const context = $("view").getContext("2d"), colour = palette.accent;
  context.save();
  Object.assign(context, { strokeStyle: colour, fillStyle: colour, lineWidth: 1 });
  dimensions.forEach((each, i) => {
    const [x0, y0, x1, y1] = each.ends, a = onPicture(x0, y0), b = onPicture(x1, y1), long = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1;
    const along = [(b[0] - a[0]) / long, (b[1] - a[1]) / long], aside = [along[1], -along[0]];
    let at;
    if (each.kind === "length") {
      const [p, q] = [a, b].map((end) => end.map((x, k) => x + BESIDE * aside[k]));
      for (const [from, to] of [[a, p], [b, q]]) line(context, from, to.map((x, k) => x + 4 * aside[k]), colour, 0.6);
      line(context, p, q, colour, 1);
      for (const [tip, way] of [[p, 1], [q, -1]]) arrowHead(context, tip, along.map((x) => way * x));
      at = p.map((x, k) => 0.5 * (x + q[k]));
    } else {
      const turn = Math.atan2(along[1], along[0]);
      line(context, a, [a[0] + 1.4 * ARC, a[1]], colour, 0.6);
      context.beginPath();
      context.arc(a[0], a[1], ARC, 0, turn, turn < 0);
      context.stroke();
      at = [a[0] + 1.7 * ARC * Math.cos(turn / 2), a[1] + 1.7 * ARC * Math.sin(turn / 2)];
    }
    const label = sizes.children[i];
    label.style.left = `${Math.min(Math.max(at[0], 30), view.camera.width - 30)}px`;
    label.style.top = `${Math.min(Math.max(at[1], 14), view.camera.height - 14)}px`;
  });
  context.restore();
}
function arrowHead(context, [x, y], [dx, dy]) {
  context.beginPath();
  context.moveTo(x, y);
  context.lineTo(x + 8 * dx - 3 * dy, y + 8 * dy + 3 * dx);
  context.lineTo(x + 8 * dx + 3 * dy, y + 8 * dy - 3 * dx);
  context.fill();
}
drawn.push(() => {
  askDimensions();
  drawDimensions();
});
