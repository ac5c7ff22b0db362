// -- three positions of a body, or a path, for which linkages are offered ---------------------------------------------------

const STEPS_OF_STROKE = 9, SHOWN = 6, STARTS = 6; // parts of a path drawn by hand; linkages that are offered; searches
let task = null, stroke = [], lookedAt = null, replaced = {}; // what is searched for; a hand's way; pins that are shown; the text before and with a linkage

const isTask = (name) => name === "positions" || name === "path";
const isSame = (a, b) => a && b && Math.hypot(a.x - b.x, a.y - b.y) * view.camera.scale < 1;

// Three positions have six points; a path ends where its last point is taken again, or its first one, which closes it.
function isTaskWhole() {
  if (tool === "positions") return spots.length === 6;
  const last = spots.at(-1);
  if (isSame(last, spots.at(-2))) return Boolean(spots.pop());
  return spots.length > 3 && isSame(last, spots[0]);
}

// A path drawn by hand: points at even parts of its length, the last one at the first where the hand comes back.
function takeStroke() {
  const ways = [0];
  for (let k = 1; k < stroke.length; k++) ways.push(ways.at(-1) + Math.hypot(stroke[k][0] - stroke[k - 1][0], stroke[k][1] - stroke[k - 1][1]));
  const step = gridded(0.5);
  for (let i = 0; i <= STEPS_OF_STROKE; i++) {
    const way = (ways.at(-1) * i) / STEPS_OF_STROKE, k = Math.min(Math.max(1, ways.findIndex((x) => x >= way)), stroke.length - 1);
    const part = (way - ways[k - 1]) / (ways[k] - ways[k - 1] || 1), [a, b] = [stroke[k - 1], stroke[k]];
    spots.push(onGround(...a.map((x, axis) => onLattice(x + part * (b[axis] - x), step))));
  }
  const first = spots[0], last = spots.at(-1);
  if (Math.hypot(first.x - last.x, first.y - last.y) * view.camera.scale < 2 * NEAR) spots[spots.length - 1] = first;
  search(spots.splice(0));
}
$("picture").addEventListener("pointermove", (e) => pressed && tool === "path" && stroke.push(onPlane(...inPicture(e))));

async function search(points, kind = tool, starts = STARTS) {
  const own = (task = { kind, points }), began = performance.now();
  lookedAt = null;
  withdraw("linkages");
  const telling = () => say(`searching for linkages: ${Math.round((performance.now() - began) / 1000)} s, of some 10 s`), clock = setInterval(telling, 1000);
  telling();
  const answer = await post("synthesize", { part: kind, spots: points, tab, starts });
  clearInterval(clock);
  if (task !== own) return;
  own.answered = true;
  times.synthesis = performance.now() - began;
  wanted = true;
  if (answer.error) return say(answer.error, true);
  say("");
  if (answer.reason) offer("linkages", answer.reason, [["Search longer", () => search(points, kind, 4 * starts)]]);
  else offerLinkages(answer.linkages);
  $("offer").scrollIntoView({ block: "nearest" });
}

function offerLinkages(found) {
  const passed = task.kind === "path" ? "come nearest to the path" : "pass the positions", shown = found.slice(0, SHOWN);
  const words = (each, k) => [`${k + 1}: ${each.kind}, transmission ${Math.round(each.transmission)} deg`, ...(task.kind === "path" ? [`off by ${short(each.deviation)} m`] : [])].join(", ");
  offer("linkages", `${shown.length} of ${found.length} linkages that ${passed}, the best first. Each has moved through them in a run of its own, on one circuit and branch. Transmission angles are the smallest on the way.`, shown.map((each, k) => [words(each, k), () => putLinkage(found, k), () => {
    lookedAt = each.pins;
    wanted = true;
  }]));
}

// A click puts a linkage in; a click on another one puts that in its place.
async function putLinkage(found, k) {
  const now = T.value, text = replaced.text === now ? replaced.before : now;
  offerLinkages(found);
  const answer = await post("linkage", { text, asked: k, tab });
  if (answer.error) return say(answer.error, true);
  if (T.value !== now) return;
  lookedAt = null;
  replaced = { before: text, text: answer.text };
  setText(answer.text);
  choosing("move");
  say(`added linkage ${k + 1}; another one takes its place`);
}

// What was drawn, and the linkage that the hand is at in the list.
function drawTask() {
  if (view.spatial) return;
  const context = $("view").getContext("2d"), wanting = task && (!task.answered || offers.has("linkages")) ? task : { points: [] };
  const { kind, points } = spots.length && isTask(tool) ? { kind: tool, points: spots } : wanting;
  const way = (list, colour, thick) => list.forEach((b, k) => k && line(context, onPicture(...list[k - 1]), onPicture(...b), colour, thick));
  const places = points.map(({ x, y }) => [x, y]);
  if (kind === "positions") for (let k = 0; k + 1 < places.length; k += 2) {
    const [a, b] = places.slice(k, k + 2), turned = [[-0.2, 0.1], [-0.2, -0.1]].map(([u, v]) => [b[0] + u * (b[0] - a[0]) - v * (b[1] - a[1]), b[1] + u * (b[1] - a[1]) + v * (b[0] - a[0])]);
    way([a, b, turned[0]], palette.reaction, 2);
    way([b, turned[1]], palette.reaction, 2);
  } else way(places, palette.reaction, 2);
  if (pressed && tool === "path") way(stroke, palette.reaction, 2);
  if (!lookedAt) return;
  const { crank_pivot, crank_pin, rocker_pin, rocker_pivot, tip } = lookedAt;
  way([crank_pivot, crank_pin, tip, rocker_pin, crank_pin], palette.ink, 2.5);
  way([rocker_pin, rocker_pivot], palette.ink, 2.5);
}
drawn.push(drawTask);
