// -- points that can be moved, and what is added at points ----------------------------------------------------------------

const TOOLS = [
  ["move", "Move", 0, "Drag a ringed point, or move it with the arrow keys; its numbers in the text follow."],
  ["bar", "Bar", 2, "Two points of a new body; a ringed point is pinned to it."],
  ["plate", "Plate", 3, "Three points of a new body; a ringed point is pinned to it."],
  ["pin", "Pin", 2, "Points of two bodies; the same point twice pins it to the ground."],
  ["slide", "Slide", 1, "A point of a body that slides along x."],
  ["spring", "Spring", 2, "Two points with a spring and a damper between them."],
  ["motor", "Motor", 1, "A pin that turns on with time."],
  ["load", "Load", 1, "A point of a body with a force on it."],
];
const NEAR = 14; // pixels
let movable = [], held = null, tool = "move", spots = [], numbers = {};
let checkedText = null; // the text that `movable` belongs to

const layer = element("div"), bench = element("div");
layer.id = "handles";
bench.id = "tools";
bench.setAttribute("role", "toolbar");
bench.setAttribute("aria-label", "Tools");
for (const [name, label, , hint] of TOOLS) {
  const button = element("button", label);
  button.dataset.tool = name;
  button.title = hint;
  button.addEventListener("click", () => choosing(name));
  bench.append(button);
}
const snap = element("label", "", "toggle"), snapping = element("input"), where = element("input");
Object.assign(snapping, { type: "checkbox", checked: true, id: "snap" });
snap.append(snapping, element("span", "snap"));
snap.title = "Round places to a grid";
where.id = "where";
where.placeholder = "x, y";
where.setAttribute("aria-label", "Next point: x, y in metres, Enter");
bench.append(snap, where);
$("stage").prepend(bench);
$("picture").append(layer);

function choosing(name) {
  tool = name;
  spots = [];
  for (const button of bench.querySelectorAll("[data-tool]")) button.setAttribute("aria-pressed", button.dataset.tool === name);
  $("picture").classList.toggle("adding", name !== "move");
  where.hidden = name === "move";
  if (name !== "move" && movable.length && !view.spatial) {
    outgrown(); // room for what is added, before the first point is taken
    wanted = true;
  }
  layHandles();
  if (name !== "move") say(TOOLS.find((each) => each[0] === name)[3]);
}

// -- places on the picture ------------------------------------------------------------------------------------------------

// By what is in the middle: where the camera was last drawn from may be a picture ago.
const onPicture = (x, y) => {
  const { at, scale, width, height } = view.camera;
  return [(x - at[0]) * scale + width / 2, height / 2 - (y - at[1]) * scale];
};
const onPlane = (px, py) => {
  const { at, scale, width, height } = view.camera;
  return [(px - width / 2) / scale + at[0], (height / 2 - py) / scale + at[1]];
};
// The step of a grid whose lines are some pixels apart, and a number on it.
const gridded = (pixels) => 10 ** Math.ceil(Math.log10(pixels / view.camera.scale) - 0.3);
const onGrid = (x, step) => Math.round(x / step) * step;
const decimals = (step) => Math.max(0, Math.min(12, -Math.floor(Math.log10(step) + 1e-9)));

// A number as it is written in place of another one.
function written(x, step, before) {
  const text = String(+onGrid(x, step).toFixed(decimals(step)));
  return /[.e]/i.test(before) && !/[.e]/i.test(text) ? `${text}.0` : text;
}

const atStart = () => !playing && !view.spatial && time <= (motion.t[0] || 0) + 1e-12;

function layHandles() {
  const shown = atStart() || held;
  layer.hidden = !shown;
  if (!shown) return;
  for (const each of layer.querySelectorAll(".spot")) each.remove();
  while (layer.children.length > movable.length) layer.lastChild.remove();
  while (layer.children.length < movable.length) layer.append(newHandle());
  movable.forEach((h, i) => {
    const button = layer.children[i], own = held && held.name === h.name ? held : h, [x, y] = onPicture(own.x, own.y);
    button.style.left = `${x}px`;
    button.style.top = `${y}px`;
    button.classList.toggle("fixed", !h.followers.length);
    button.classList.toggle("held", own === held);
    button.classList.toggle("taken", spots.some((s) => s.name === h.name));
    const label = `${h.kind} ${h.name.split(".").slice(1).join(" ")}, x ${short(own.x)} m, y ${short(own.y)} m`;
    if (button.getAttribute("aria-label") !== label) button.setAttribute("aria-label", label);
    button.title = h.name;
  });
  for (const spot of spots.filter((s) => !s.name)) {
    const dot = element("div", "", "spot"), [x, y] = onPicture(spot.x, spot.y);
    dot.style.left = `${x}px`;
    dot.style.top = `${y}px`;
    layer.append(dot);
  }
}
drawn.push(layHandles);

// -- moving ---------------------------------------------------------------------------------------------------------------

function newHandle() {
  const button = element("button", "", "handle"), own = () => movable[[...layer.children].indexOf(button)];
  button.addEventListener("pointerdown", (e) => {
    e.stopPropagation();
    const handle = own();
    if (tool !== "move" || !handle || e.button) return;
    e.preventDefault();
    button.focus();
    button.setPointerCapture(e.pointerId);
    hold(handle, e.clientX, e.clientY);
  });
  button.addEventListener("pointermove", (e) => {
    if (!held || !held.from) return;
    if (!held.next) requestAnimationFrame(follow_hand); // once a picture
    held.next = [e.clientX, e.clientY];
  });
  for (const name of ["pointerup", "pointercancel"]) button.addEventListener(name, () => held && held.from && release());
  button.addEventListener("click", (e) => {
    const handle = own();
    if (!handle) return;
    e.stopPropagation();
    if (tool === "move") point_out(handle);
    else pick(handle);
  });
  button.addEventListener("keydown", (e) => {
    const way = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[e.key], handle = own();
    if (!way || tool !== "move" || !handle) return;
    e.preventDefault();
    e.stopPropagation();
    if (!handle.followers.length || checkedText !== T.value) return;
    const step = gridded(e.shiftKey ? 2 : 8);
    setText(moved(handle, T.value, way[0] * step, way[1] * step, step));
  });
  return button;
}

function hold(handle, x, y) {
  if (!handle.followers.length) return say(`${handle.name} is written by formulas of several numbers: change them in the text`);
  if (checkedText !== T.value) return;
  held = { ...handle, from: [x, y], x0: handle.x, y0: handle.y, text: T.value, moved: false };
}

// The text with the numbers that follow a handle moved so far [m].
function moved(handle, text, dx, dy, step) {
  let result = text;
  for (const f of [...handle.followers].sort((a, b) => b.start - a.start)) {
    const change = f.right * dx + f.up * dy, size = Math.max(Math.abs(f.right), Math.abs(f.up));
    const fine = Math.abs(f.right * f.up) < 1e-9 * size * size && Math.abs(size - 1) < 1e-9 ? step : 10 ** Math.floor(Math.log10(1e-3 * step * size) + 1e-9);
    const before = text.slice(f.start, f.end);
    if (Math.abs(change) > 1e-12 * size) result = result.slice(0, f.start) + written(f.value + change, fine, before) + result.slice(f.end);
  }
  return result;
}

function follow_hand() {
  if (!held || !held.next) return;
  drag_to(...held.next);
  held.next = null;
}

function drag_to(x, y) {
  const { camera } = view, step = gridded(snapping.checked ? 5 : 0.5);
  held.moved ||= Math.hypot(x - held.from[0], y - held.from[1]) > 2;
  if (!held.moved) return;
  held.x = onGrid(held.x0 + (x - held.from[0]) / camera.scale, step);
  held.y = onGrid(held.y0 - (y - held.from[1]) / camera.scale, step);
  preview(moved(held, held.text, held.x - held.x0, held.y - held.y0, step));
  wanted = true;
}

function release() {
  follow_hand();
  const { text, moved: really } = held, now = T.value;
  held = null;
  wanted = true;
  if (!really) return;
  T.value = text;
  setText(now);
}

// Show where a handle stands in the text, without taking the focus.
function point_out(handle) {
  const first = handle.followers[0];
  if (first && checkedText === T.value) select(first.start, first.end, false);
}

// -- adding ---------------------------------------------------------------------------------------------------------------

function pick(handle) {
  const joint = handle.name.startsWith("joints.") ? handle.name.slice(7) : "";
  add({ name: handle.name, x: handle.x, y: handle.y, body: handle.body, point: handle.point, at: handle.at, joint });
}

const onGround = (x, y, step) => ({ name: "", x: +onGrid(x, step).toFixed(decimals(step)), y: +onGrid(y, step).toFixed(decimals(step)), body: "", point: "" });

function pickPlace(x, y) {
  add(onGround(x, y, gridded(snapping.checked ? 5 : 0.5)));
}

async function add(spot) {
  const [, , need] = TOOLS.find(([name]) => name === tool);
  if (tool === "pin" && spots.length && spot.body && spot.body === spots[0].body) spot = { ...onGround(spot.x, spot.y, gridded(0.05)), at: spot.at };
  spots.push(spot);
  wanted = true;
  if (spots.length < need) return layHandles();
  const given = { text: T.value, part: ["bar", "plate"].includes(tool) ? "body" : tool, spots };
  spots = [];
  const answer = await post("add", given);
  if (answer.error) return say(answer.error, true);
  if (T.value !== given.text) return;
  setText(answer.text);
  const at = answer.text.indexOf(`[${answer.path}]`);
  if (at >= 0) select(at + 1, at + 1 + answer.path.length, false);
  say(`added ${answer.path}`);
}

$("picture").addEventListener("pointerdown", (e) => {
  if (tool === "move" || view.spatial || e.target.closest(".handle") || e.button) return;
  e.stopPropagation();
  e.preventDefault();
  const box = $("picture").getBoundingClientRect(), [x, y] = [e.clientX - box.left, e.clientY - box.top];
  const near = movable.find((h) => Math.hypot(...onPicture(h.x, h.y).map((p, i) => p - [x, y][i])) < NEAR);
  if (near) pick(near);
  else pickPlace(...onPlane(x, y));
}, { capture: true });
where.addEventListener("keydown", (e) => {
  if (e.key !== "Enter") return;
  const [x, y] = where.value.split(",").map(Number);
  if (!Number.isFinite(x) || !Number.isFinite(y) || tool === "move") return say("expected x, y in metres, such as 0.5, 1.2", true);
  const near = movable.find((h) => Math.hypot(h.x - x, h.y - y) * view.camera.scale < 2);
  where.value = "";
  if (near) pick(near);
  else add({ ...onGround(0, 0, 1), x, y });
});
