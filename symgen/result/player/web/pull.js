// -- a hand that pulls a body of the live part by a spring, while it plays --------------------------------------------------

// The spring pulls with so many times the weight of what it moves where it is as long as the mechanism; its damper is
// half the critical one. Steps resolve it: it turns by no more than that in one [rad].
const WEIGHTS = 20, TURN = 0.5, REACH = 0.1; // an arrow key moves its end by so much of the mechanism
let hand = null; // what pulls: body, point of it, the spring's end, stiffness and damping once it works
let catching = null; // when the motion that is worked out has come to what is shown
let heldBy = ""; // what is said where nothing moves a body
const arrowsDown = new Set();

// The body that the keyboard pulls: an editor has its own selection.
const choice = { name: "", get: () => choice.name, set: (name) => (choice.name = name) };
const pulledNames = () => (live && live.spec.hand ? live.spec.hand.bodies.map(([name]) => name) : []);
const numberOf = (name) => data.scene.frames.findIndex(([own]) => own === name);

// Take a point of a body: what is shown is worked out again up to here, and goes on with the spring.
function takeBody(name, at, to) {
  const own = motion === follow && follow.hands.filter(({ t }) => t < time);
  live.pull(null);
  heldBy = "";
  const begun = live.start();
  if (!begun || !begun.every(Number.isFinite)) return;
  hand = { name, at, to, k: 0, c: 0 };
  beginMotion(begun, own || []);
  catching = follow.spacing * Math.ceil(time / follow.spacing - 1e-9);
  follow.end = Math.max(follow.end, catching + follow.spacing);
}

// Go on to what is shown; then the spring is hooked in.
function catchUp(budget) {
  if (clock < catching - 1e-12) {
    compute(budget, catching);
    if (follow.whole) return (hand = catching = null); // it has ended before
    if (clock < catching - 1e-12) return;
  }
  catching = null;
  time = clock;
  show(follow);
  if (!hand) return finishLater();
  const m = massAt(hand.name, hand.at), length = live.w[live.spec.status.length];
  const omega = Math.min(Math.sqrt((WEIGHTS * 9.81) / length), TURN / data.live.step);
  if (m === Infinity) {
    heldBy = `${hand.name} moves as its drivers say: no hand pulls it away`;
    return letGo();
  }
  Object.assign(hand, { k: m * omega ** 2, c: m * omega });
}

// The mass that a point of a body seems to have where it is moved most easily [kg]; infinite where drivers hold it.
function massAt(name, at) {
  const body = numberOf(name);
  let most = 0;
  at.forEach((_, axis) => {
    const [before, after, time2] = live.responded(clock, state, name, at, axis);
    if (!(time2 > 0)) return;
    const a = view.where(before, body, at), b = view.where(after, body, at);
    most = Math.max(most, Math.hypot(...a.map((x, i) => b[i] - x)) / time2);
  });
  return most > 0 ? 1 / most : Infinity;
}

// The spring as it is now works from the next step on; what is worked out stays just ahead of what is shown.
function computePulled(budget, passed) {
  const last = follow.hands.at(-1), { name, at, to, k, c } = hand;
  if (!last || !last.hand || last.hand.to !== to) follow.hands.push({ t: clock, hand: { name, at, to, k, c } });
  const needed = time + passed * speed + follow.spacing;
  follow.end = Math.max(follow.end, follow.spacing * Math.ceil(needed / follow.spacing + 2));
  compute(budget, needed);
  if (follow.whole) hand = null;
}

// Let go: the motion goes on for as long as a run of the mechanism lasts.
function letGo() {
  hand = null;
  arrowsDown.clear();
  if (catching === null && follow && !follow.whole) finishLater();
}

// Another motion is shown: nothing is pulled any more.
function dropHand() {
  hand = catching = pressedBody = null;
  heldBy = "";
  arrowsDown.clear();
  if (live && live.spec.hand) live.pull(null);
}

function finishLater() {
  follow.hands.push({ t: clock, hand: null });
  follow.end = Math.max(follow.end, follow.spacing * Math.ceil((clock + data.live.until) / follow.spacing));
  wanted = true;
}

// The force of the spring [N], where its ends are shown.
function pullNow(q) {
  const at = worldOf(q, numberOf(hand.name), hand.at);
  return { at, force: hand.k * Math.hypot(...hand.to.map((x, i) => x - at[i])) };
}

const handInWords = () => heldBy || (hand && hand.k ? `spring of ${short(hand.k)} N/m, damper of ${short(hand.c)} N s/m` : "");

drawn.push((q) => {
  const item = choice.get === ownChoice && choice.name && data.scene.items.find((each) => each.role === "body" && each.name === choice.name);
  if (item) glow(item, q);
  if (!hand || !hand.k) return;
  const { at, force } = pullNow(q), context = $("view").getContext("2d"), [ax, ay] = view.onScreen(at), [bx, by] = view.onScreen(hand.to);
  context.strokeStyle = context.fillStyle = palette.push;
  context.lineWidth = 2;
  context.beginPath();
  context.moveTo(ax, ay);
  context.lineTo(bx, by);
  context.stroke();
  for (const [x, y] of [[ax, ay], [bx, by]]) {
    context.beginPath();
    context.arc(x, y, 4, 0, 2 * Math.PI);
    context.fill();
  }
  context.font = "13px system-ui, sans-serif";
  context.textAlign = bx < view.camera.width / 2 ? "left" : "right";
  context.lineWidth = 3;
  context.strokeStyle = palette.paper;
  const words = `${short(force)} N`, x = bx + (context.textAlign === "left" ? 10 : -10);
  context.strokeText(words, x, by - 8);
  context.fillText(words, x, by - 8);
});
const ownChoice = choice.get;

// -- by mouse and touch: a drag from a body pulls it, a press alone chooses it ------------------------------------------------

const placeOf = (e) => {
  const box = $("view").getBoundingClientRect();
  return [e.clientX - box.left, e.clientY - box.top];
};
let pressedBody = null;
$("view").addEventListener("pointerdown", (e) => {
  if (!playing || !live || pressedBody || hand || e.button) return;
  const [x, y] = placeOf(e), found = itemAt(x, y, ["body"]);
  if (!found || !pulledNames().includes(found.item.name)) return;
  e.stopImmediatePropagation();
  $("view").setPointerCapture(e.pointerId);
  const { near, item: { name } } = found, at = view.into(between(motion, time), numberOf(name), view.fromScreen(x, y, near));
  pressedBody = { id: e.pointerId, from: [x, y], name, near, at, still: true };
}, { capture: true });
$("view").addEventListener("pointermove", (e) => {
  if (!pressedBody || pressedBody.id !== e.pointerId) return;
  const [x, y] = placeOf(e), { from, name, near, at, still } = pressedBody, to = view.fromScreen(x, y, near);
  if (still && Math.hypot(x - from[0], y - from[1]) < 4) return;
  pressedBody.still = false;
  if (hand) hand.to = to;
  else if (still) takeBody(name, at, to);
}, { capture: true });
for (const name of ["pointerup", "pointercancel"]) $("view").addEventListener(name, (e) => {
  if (!pressedBody || pressedBody.id !== e.pointerId) return;
  if (pressedBody.still && name === "pointerup") choice.set(pressedBody.name);
  pressedBody = null;
  letGo();
}, { capture: true });

// -- by keys: b chooses the next body, arrow keys pull it ----------------------------------------------------------------------

function chooseNext() {
  const names = pulledNames();
  if (names.length) choice.set(names[(names.indexOf(choice.get()) + 1) % names.length]);
  wanted = true;
}

// The middle of what is drawn of a body, in its frame.
function middleOf(name) {
  const body = numberOf(name), points = [], size = view.spatial ? 3 : 2;
  for (const item of data.scene.items) for (const mark of item.role === "body" && item.name === name ? item.marks : []) {
    if (mark[2] !== body) continue;
    const lists = mark[0] === "L" ? [mark[4]] : mark[0] === "S" ? mark[3] : mark[0] === "T" ? [mark[3], mark[4]] : [mark[3]];
    for (const list of lists) for (let i = 0; i < list.length; i += size) points.push(list.slice(i, i + size));
  }
  return Array.from({ length: size }, (_, k) => points.reduce((sum, p) => sum + p[k], 0) / (points.length || 1));
}

window.addEventListener("keydown", (e) => {
  const way = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[e.key], name = choice.get();
  if (!way || !playing || !pulledNames().includes(name) || pressedBody || ["SELECT", "INPUT", "TEXTAREA"].includes(e.target.tagName) && e.target.type !== "checkbox") return;
  e.preventDefault();
  e.stopImmediatePropagation();
  arrowsDown.add(e.key);
  const q = between(motion, time);
  if (!hand) {
    const at = middleOf(name);
    takeBody(name, at, worldOf(q, numberOf(name), at).slice(0, at.length));
  }
  if (!hand) return;
  const [x, y, near] = view.onScreen(hand.to), step = REACH * live.w[live.spec.status.length] * view.camera.scale;
  hand.to = view.fromScreen(x + way[0] * step, y - way[1] * step, near);
}, { capture: true });
window.addEventListener("keyup", (e) => {
  if (arrowsDown.delete(e.key) && !arrowsDown.size && !pressedBody) letGo();
}, { capture: true });
window.addEventListener("blur", () => !pressedBody && arrowsDown.size && letGo());
