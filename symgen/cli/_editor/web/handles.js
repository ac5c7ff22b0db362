// -- points that can be moved, and what is added at points ----------------------------------------------------------------

// Name, word on the button, points at least and at most, what is said.
const TOOLS = [
  ["move", "Move", 0, 0, "Drag a ringed point, or move it with the arrow keys; its numbers in the text follow."],
  ["bar", "Bar", 2, 2, "Two points of a new body; a ringed point is pinned to it."],
  ["plate", "Plate", 3, 3, "Three points of a new body; a ringed point is pinned to it."],
  ["pin", "Pin", 2, 2, "Points of two bodies; the same point twice pins it to the ground."],
  ["weld", "Weld", 2, 2, "Points of two bodies that do not turn against each other; the same point twice welds it to the ground."],
  ["slide", "Slide", 1, 2, "A point of a body that slides along x; drag from it for another direction, or onto a point of the body that it slides along. Its body keeps its angle."],
  ["slot", "Slot", 1, 2, "A point of a body in a slot along x; drag from it for another direction, or onto a point of the body that has the slot. Its body may turn."],
  ["point", "Point", 2, 2, "A point of a body, then where another point of that body is: a further hole, or a point whose path is drawn."],
  ["copy", "Copy", 2, 2, "A point of a body, then where that point of its copy is."],
  ["rod", "Rod", 2, 2, "Two points that keep their distance, without a body between them."],
  ["gear", "Gear", 2, 2, "Two pins on one body or on the ground, whose other bodies are wheels in mesh."],
  ["motor", "Motor", 1, 1, "A pin that turns on with time, or the point of a slide on the ground that moves on."],
  ["stop", "Stop", 1, 1, "A pin or a slide that goes only so far: click it; its limits stand in the text."],
  ["friction", "Friction", 1, 1, "A pin or a slide that rubs: click it; its bound stands in the text."],
  ["spring", "Spring", 2, 2, "Two points with a spring and a damper between them."],
  ["wheel", "Wheel", 2, 2, "The centre of a disc and a place on its rim; a ringed point is pinned to it. Its radius is a parameter."],
  ["touch", "Contact", 2, 2, "The centre of a disc, then that of another wheel, or where a line lies below it, on the ground or on a body: they touch, rub and bounce."],
  ["roll", "Roll", 2, 2, "The centre of a disc, then where it touches the line on which it rolls without slip."],
  ["rack", "Rack", 2, 2, "The pin of a pinion, then a point of the rack, which a slide holds."],
  ["rope", "Rope", 4, 4, "One end, the centre of a sheave, its rim, the other end."],
  ["cylinder", "Cylinder", 2, 2, "Two points that a cylinder pushes apart."],
  ["load", "Load", 1, 1, "A point of a body with a force on it."],
  ["positions", "Positions", 6, 6, "Three positions of a body: drag from a point along the body, three times; linkages that pass them are offered."],
  ["path", "Path", 3, 20, "Draw a path by hand, or click at its points and at the last one again; linkages that pass it are offered."],
];
const ICONS = {
  move: "M12 3v18M3 12h18M12 3l-3 3M12 3l3 3M12 21l-3-3M12 21l3-3M3 12l3-3M3 12l3 3M21 12l-3-3M21 12l-3 3",
  bar: "M5 19L19 5M7 19a2 2 0 1 1-4 0a2 2 0 1 1 4 0M21 5a2 2 0 1 1-4 0a2 2 0 1 1 4 0",
  plate: "M4 19L20 17L11 4z",
  pin: "M12 14a3 3 0 1 0 0-6a3 3 0 1 0 0 6M12 14l-5 6h10zM5 20h14",
  weld: "M12 4v16M6 4h12M6 20h12M9 8l6 4l-6 4",
  slide: "M3 18h18M7 9h10v6H7zM3 18l2 3M9 18l2 3M15 18l2 3",
  slot: "M7 8h10a4 4 0 0 1 0 8H7a4 4 0 0 1 0-8M14 12a2 2 0 1 1-4 0a2 2 0 1 1 4 0",
  copy: "M8 8h12v12H8zM16 4H4v12",
  rod: "M6 18L18 6M6 18h.01M18 6h.01",
  gear: "M11 9a4 4 0 1 1-8 0a4 4 0 1 1 8 0M21 15a5 5 0 1 1-10 0a5 5 0 1 1 10 0M7 3v2M7 13v2M16 8v2M16 20v2",
  stop: "M5 4v16M19 4v16M8 12h8M8 12l2-2M8 12l2 2M16 12l-2-2M16 12l-2 2",
  friction: "M3 17h18M6 17l-2 3M12 17l-2 3M18 17l-2 3M8 8h8v7H8z",
  wheel: "M20 12a8 8 0 1 1-16 0a8 8 0 1 1 16 0M12 12h8",
  touch: "M18 9a6 6 0 1 1-12 0a6 6 0 1 1 12 0M3 15h18M6 15l-2 3M12 15l-2 3M18 15l-2 3",
  roll: "M18 12a6 6 0 1 1-12 0a6 6 0 1 1 12 0M3 18h18M10 3h6l-2-2M16 3l-2 2",
  rack: "M16 8a5 5 0 1 1-10 0a5 5 0 1 1 10 0M2 20v-4h3v-2h3v2h3v-2h3v2h3v-2h3v2h2v4z",
  rope: "M17 9a5 5 0 1 1-10 0a5 5 0 1 1 10 0M7 9v10M17 9v6M14 15h6v5h-6z",
  cylinder: "M3 9h11v6H3zM14 12h7M8 9v6",
  point: "M4 20L20 4M15 12a3 3 0 1 1-6 0a3 3 0 1 1 6 0",
  spring: "M3 12h3l2-5l3 10l3-10l3 10l2-5h2",
  motor: "M19 12a7 7 0 1 1-3-5.7M16 2v5h-5M12 12h.01",
  load: "M12 3v16M12 19l-4-5M12 19l4-5",
  positions: "M3 19l5-6M8 13h-3M8 13v3M9 10l7-2M16 8l-2-2M16 8l-1 3M16 15l5 3M21 18l-3 0M21 18v-3",
  path: "M3 18c3-14 8-14 10-6s6 6 8-4",
};
let movable = [], held = null, tool = "move", spots = [], pressed = null, numbers = {}, numberUnits = {};
let checkedText = null; // the text that `movable` belongs to

const layer = element("div"), bench = element("div"), asking = element("div");
layer.id = "handles";
asking.id = "which";
asking.hidden = true;
asking.setAttribute("role", "group");
asking.setAttribute("aria-label", "Which point");
bench.id = "tools";
bench.setAttribute("role", "toolbar");
bench.setAttribute("aria-label", "Tools");
for (const [name, label, , , hint] of TOOLS) {
  const button = element("button");
  button.innerHTML = `<svg viewBox="0 0 24 24" aria-hidden="true"><path d="${ICONS[name]}"/></svg>`; // from this file alone
  button.append(element("span", label));
  button.dataset.tool = name;
  button.title = hint;
  button.addEventListener("click", () => choosing(name));
  bench.append(button);
}
const snap = element("label", "", "toggle"), snapping = element("input"), where = element("input");
Object.assign(snapping, { type: "checkbox", checked: true, id: "snap" });
snap.append(snapping, element("span", "snap"));
snap.title = "Round places to the grid";
where.id = "where";
where.placeholder = "x, y or length < deg";
where.setAttribute("aria-label", "Next point: x, y in metres, or length and angle from the last one as 0.2 < 30, Enter");
where.title = where.getAttribute("aria-label");
bench.append(snap, where);
bench.setAttribute("aria-orientation", "vertical");
$("stage").prepend(bench);
$("picture").append(layer, pointer, asking);
layer.addEventListener("wheel", (e) => { // a ring under the hand zooms as the picture below it does
  e.preventDefault();
  $("view").dispatchEvent(new WheelEvent("wheel", e));
}, { passive: false });
underlay();

function choosing(name) {
  tool = name;
  spots = [];
  pressed = hovered = null;
  for (const button of bench.querySelectorAll("[data-tool]")) button.setAttribute("aria-pressed", button.dataset.tool === name);
  $("picture").classList.toggle("adding", name !== "move");
  where.hidden = name === "move";
  asking.hidden = true;
  if (name !== "move" && !view.spatial) {
    if (looked) wanted = true; // it stays
    else if (movable.length) outgrown(true); // room for what is added, before the first point is taken
    else Object.assign(view.camera, { at: [0, 0, 0], scale: 0.48 * Math.min(view.camera.width, view.camera.height) }); // a metre
    wanted = true;
  }
  layHandles();
  if (name !== "move") say(TOOLS.find((each) => each[0] === name)[4]);
}

const tidy = (x) => +x.toFixed(12); // what rounding leaves of 0
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
    const label = `${h.kind} ${h.name.split(".").slice(1).join(" ")}, x ${short(tidy(own.x))} m, y ${short(tidy(own.y))} m`;
    if (button.getAttribute("aria-label") !== label) button.setAttribute("aria-label", label);
    button.title = h.name;
  });
  for (const spot of [...spots, ...(pressed ? [pressed] : [])].filter((s) => !s.name)) {
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
    else if (!e.detail) takePoints(spotOf(handle)); // by a key; the mouse is followed below
  });
  button.addEventListener("keydown", (e) => {
    const first = e.key === "Enter" && e.shiftKey && ["slide", "slot"].includes(tool) && own();
    if (first) { // the second point follows
      e.preventDefault();
      spots = [spotOf(first)];
      return layHandles();
    }
    const way = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[e.key], handle = own();
    if (!way || !["move", "slide", "slot"].includes(tool) || !handle) return;
    e.preventDefault();
    e.stopPropagation();
    if (tool !== "move") return takePoints(spotOf(handle), onGround(handle.x + way[0], handle.y + way[1]));
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
  const { camera } = view, step = handStep();
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

const onGround = (x, y) => ({ name: "", x, y, body: "", point: "" });

function spotOf(handle) {
  const joint = handle.name.startsWith("joints.") ? handle.name.slice(7) : "";
  return { name: handle.name, x: handle.x, y: handle.y, body: handle.body, point: handle.point, at: handle.at, joint };
}

// What is at a place of the picture: a ringed point, or a place of the grid.
function spotAt(px, py) {
  const away = (h) => Math.hypot(...onPicture(h.x, h.y).map((p, i) => p - [px, py][i])), step = handStep();
  const near = movable.filter((h) => away(h) < NEAR).sort((a, b) => away(a) - away(b)), [first] = near;
  if (first) {
    const rivals = near.filter((h) => apart(h, first) && away(h) < away(first) + CLOSER);
    return rivals.length ? { ...spotOf(first), rivals: [first, ...rivals.slice(0, 5)].map(spotOf) } : spotOf(first);
  }
  const place = onGround(...onPlane(px, py).map((x) => onLattice(x, step)));
  const part = ["stop", "friction"].includes(tool) ? partAt(px, py) : ""; // the joint itself, as it is drawn
  return part.startsWith("joints.") ? { ...place, joint: part.slice(7) } : place;
}

// Which of the points that lie under one click is meant; none where nobody says.
const CLOSER = 5; // pixels by which one of two points is farther from a click, at least, where the nearer one is meant
const apart = (a, b) => Math.hypot(a.x - b.x, a.y - b.y) > 1e-9 * (1 + Math.hypot(a.x, a.y));
function whichOf({ rivals, ...spot }) {
  if (!rivals) return spot;
  asking.textContent = "Which point? ";
  asking.hidden = false;
  const [x, y] = onPicture(spot.x, spot.y);
  asking.style.left = `${Math.max(0, Math.min(x + 12, view.camera.width - 200))}px`;
  asking.style.top = `${Math.max(0, Math.min(y + 12, view.camera.height - 24 * (rivals.length + 2)))}px`;
  say("several points lie there: say which one, or look nearer by the wheel");
  return new Promise((answer) => {
    for (const each of rivals) {
      const button = element("button", `${each.name.split(".").slice(1).join(" ")}, x ${short(tidy(each.x))} m, y ${short(tidy(each.y))} m`);
      button.addEventListener("click", () => {
        asking.hidden = true;
        answer(each);
      });
      asking.append(button);
    }
    asking.querySelector("button").focus();
  });
}
asking.addEventListener("pointerdown", (e) => e.stopPropagation());

// A place that is taken twice is a point of another body that lies there, or held by the ground.
function otherThan(first, spot) {
  if (!spot.body || spot.body !== first.body) return spot;
  const other = movable.find((h) => h.body !== first.body && Math.hypot(h.x - spot.x, h.y - spot.y) * view.camera.scale < 1);
  return other ? spotOf(other) : onGround(spot.x, spot.y);
}

async function takePoints(...taken) {
  const [, , least] = TOOLS.find(([name]) => name === tool);
  for (const spot of taken) spots.push(["pin", "weld"].includes(tool) && spots.length ? otherThan(spots[0], spot) : spot);
  wanted = true;
  if (isTask(tool) ? !isTaskWhole() : spots.length < least) return layHandles();
  if (isTask(tool)) return search(spots.splice(0));
  const given = { text: T.value, part: ["bar", "plate"].includes(tool) ? "body" : tool, spots };
  spots = [];
  const answer = await post("add", given);
  if (answer.error) return say(answer.error, true);
  if (T.value !== given.text) return;
  setText(answer.text);
  const at = answer.text.indexOf(`[${answer.path.split(".").slice(0, 2).join(".")}]`);
  if (at >= 0) select(at + 1, answer.text.indexOf("]", at), false);
  if (answer.path.startsWith("bodies.")) selected = answer.path.split(".").slice(0, 2).join("."); // its dimensions are shown
  say(`added ${["stop", "friction"].includes(given.part) ? `a ${given.part} to ` : ""}${answer.path}`.replace("a friction", "friction"));
}

// -- the mouse while something is added: a click takes a point, a drag takes two ---------------------------------------------

const inPicture = (e) => {
  const box = $("picture").getBoundingClientRect();
  return [e.clientX - box.left, e.clientY - box.top];
};
$("picture").addEventListener("pointerdown", (e) => {
  if (tool === "move" || view.spatial || e.button || asking.contains(e.target)) return;
  asking.hidden = true;
  e.stopPropagation();
  e.preventDefault();
  $("picture").setPointerCapture(e.pointerId);
  pressed = { ...spotAt(...inPicture(e)), from: inPicture(e) };
  stroke = [onPlane(...pressed.from)];
  wanted = true;
}, { capture: true });
$("picture").addEventListener("pointermove", (e) => {
  if (view.spatial) return;
  if (tool === "move") {
    const step = gridded(0.5);
    hovered = onGround(...onPlane(...inPicture(e)).map((x) => onLattice(x, step)));
  } else hovered = spotAt(...inPicture(e));
  wanted = true;
});
$("picture").addEventListener("pointerleave", () => {
  hovered = null;
  wanted = true;
});
for (const name of ["pointerup", "pointercancel"]) $("picture").addEventListener(name, (e) => {
  if (!pressed) return;
  const { from, ...first } = pressed, at = inPicture(e), [, , , most] = TOOLS.find(([each]) => each === tool);
  pressed = null;
  wanted = true;
  if (name === "pointercancel") return;
  const dragged = Math.hypot(at[0] - from[0], at[1] - from[1]) > NEAR && spots.length + 2 <= most;
  if (dragged && tool === "path" && !spots.length) return takeStroke();
  takeAsked(dragged ? [first, spotAt(...at)] : [first]);
});
async function takeAsked(hit) {
  const taken = [], own = tool, text = T.value;
  for (const spot of hit) taken.push(await whichOf(spot));
  if (tool === own && T.value === text) takePoints(...taken);
}
where.addEventListener("keydown", (e) => {
  if (e.key !== "Enter" || tool === "move") return;
  if (tool === "path" && spots.length && !where.value.trim()) return takePoints(spots.at(-1)); // which ends it
  const polar = where.value.includes("<"), [a, b] = where.value.split(polar ? "<" : ",").map((x) => (x.trim() ? Number(x) : NaN)), last = spots.at(-1);
  if (!Number.isFinite(a) || !Number.isFinite(b)) return say("expected x, y in metres, such as 0.5, 1.2, or length < degrees, such as 0.5 < 30", true);
  if (polar && !last) return say("a length and an angle count from a point: take the first one by its x, y or by a click", true);
  const turn = (b * Math.PI) / 180, [x, y] = polar ? [last.x + a * Math.cos(turn), last.y + a * Math.sin(turn)] : [a, b];
  const away = (h) => Math.hypot(h.x - x, h.y - y), [near] = movable.filter((h) => away(h) * view.camera.scale < 2).sort((a, b) => away(a) - away(b));
  where.value = "";
  takePoints(near ? spotOf(near) : onGround(x, y));
});
