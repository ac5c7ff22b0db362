// -- the server -----------------------------------------------------------------------------------------------------------

const tab = Array.from(crypto.getRandomValues(new Uint32Array(2)), String).join("-");
const NOTHING = { emitted: null, makeLive: null, observed: null, makeColumns: null };
const LARGEST = 1000000;
const MOTION = 60, LIVE = 700; // milliseconds of rest before a motion, and its live part, are asked for
let version = 0, checking = false, again = false, timer = 0, resume = null, lively = true, times = {}, fresh = true; // nothing has moved yet

async function post(job, given, further = {}) {
  if (given.text && given.text.length > LARGEST) return { error: `expected a text of at most ${LARGEST} characters, got ${given.text.length}` };
  try {
    const answer = await fetch(job, { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(given), ...further });
    if (!answer.ok) throw new Error(`it refused, with ${answer.status}`);
    return await answer.json();
  } catch (error) {
    return { error: `symgen edit does not answer: ${error.message}; is it still running?` };
  }
}

// What an act did, or why not: it stays until the next one. What a motion says stands apart, until the next motion.
const say = (text, wrong = false) => put("status", text, wrong);
const tell = (text, wrong = false) => put("told", text, wrong);
function put(id, text, wrong) {
  $(id).textContent = text;
  $(id).style.color = wrong ? "var(--bad)" : "";
}

// -- what is shown --------------------------------------------------------------------------------------------------------

// Other data in the page: of a start alone, of a motion, or of a motion with a live part. Where it looks from stays.
function display(next, kind, code = NOTHING) {
  const { camera, spatial } = view, empty = !data.scene.items.length;
  if (resume === null && motion.t.length > 1) resume = time;
  data = opened(next);
  stage();
  underlay();
  motions = data.motions.map(recorded);
  motion = motions[0];
  dropHand();
  follow = null;
  rows = [];
  ranges = null;
  document.querySelector("header h1").textContent = data.title;
  if (view.spatial !== spatial) looked = false;
  if (view.spatial === spatial && (!empty || looked || tool !== "move")) for (const key of ["turn", "tilt", "scale", "at", "width", "height"]) view.camera[key] = camera[key];
  else fitted();
  if (kind === "start") return begun();
  if (kind === "live") begin(code);
  else {
    live = columns = null;
    if (!steering) $("live").inert = true;
  }
  if (kind === "motion") {
    if (!lively) steer();
    facts();
    $("forcesBox").hidden = !(motion.reactions || motion.pulls);
  }
  if (kind === "live") $("live").inert = false;
  offerTraces();
  const shown = resume ?? time;
  resume = null;
  show(motion);
  preferPlot();
  if (fresh) pace();
  if (fresh && tool === "move") fitted();
  else if (!held && !steering && !pressed && !spots.length && kind !== "live") outgrown(); // what a motion shows has its place already: nothing moves under a hand
  fresh = false;
  go(shown);
}

// What was asked for last is plotted again where a motion has it; what nobody asked for is not a mode.
let askedPlot = null;
$("group").addEventListener("change", () => (askedPlot = titled(motion.groups[$("group").value])));
function preferPlot() {
  const before = $("group").value, modes = (g) => g.names.every((name) => name.endsWith(".mode"));
  let at = motion.groups.findIndex((g) => titled(g) === askedPlot);
  if (at < 0 && motion.groups[before] && modes(motion.groups[before])) at = motion.groups.findIndex((g) => !modes(g));
  if (at < 0 || String(at) === before) return;
  $("group").value = String(at);
  choose();
}

// A start alone: what is plotted waits for the motion.
function begun() {
  live = columns = group = null;
  traced = [];
  if (!steering) $("live").inert = true;
  $("plots").classList.add("waiting");
  go(0);
}

// Look at all of the motion; at its start alone while something is drawn, or where something flies away.
const AWAY = 6, ROOM = 0.6, LOST = 40; // times the size of the start; share of the picture that it takes while something is drawn; times as small as that
function fitted() {
  view.fit(motion.rows.slice(0, 1));
  const { scale, at } = view.camera;
  if (tool !== "move") {
    view.camera.scale *= ROOM;
    return;
  }
  view.fit(motion.rows);
  if (scale / view.camera.scale > AWAY) Object.assign(view.camera, { scale, at });
}

// Look again where the mechanism has left the picture, or has become small in it; while something is added, where a
// point has left it, all have become one, or room is asked for. What a hand chose to look at stays.
function outgrown(room = false) {
  if (looked) return;
  const within = ([x, y]) => x > 12 && y > 12 && x < view.camera.width - 12 && y < view.camera.height - 12;
  const seen = tool !== "move" && movable.every((h) => within(onPicture(h.x, h.y)));
  const before = { ...view.camera, at: [...view.camera.at] };
  fitted();
  const now = view.camera, ratio = before.scale / now.scale, lost = ratio * LOST < 1; // after an undo of something huge
  if (seen && !room && !lost) {
    for (const key of ["scale", "at"]) view.camera[key] = before[key];
    return;
  }
  const aside = Math.hypot(...before.at.map((x, i) => x - now.at[i])) * before.scale;
  const keep = (seen && !lost && ratio < 1.02) || (ratio < 1.02 && ratio > 0.5 && aside < 16 + 0.5 * (1 - ratio) * Math.min(now.width, now.height));
  if (keep) for (const key of ["scale", "at"]) view.camera[key] = before[key];
}

function showErrors(found, count) {
  bad = new Map();
  for (const { line, text } of found) bad.set(line, bad.has(line) ? `${bad.get(line)}\n${text}` : text);
  mark();
  const box = $("errors");
  box.textContent = "";
  box.hidden = !found.length;
  for (const each of found) {
    const item = element("li"), button = element("button", each.line ? `${each.line}: ${each.text}` : each.text); // of a line, or of no line
    if (each.line) button.addEventListener("click", () => select(startOfLine(each.line), startOfLine(each.line + 1) - 1));
    item.append(button);
    box.append(item);
  }
  if (count > found.length) box.append(element("li", `${count - found.length} more`));
  $("picture").classList.toggle("stale", Boolean(found.length) && !movable.length);
}

// -- checking while it is typed -------------------------------------------------------------------------------------------

async function check() {
  if (checking) {
    again = true;
    return;
  }
  checking = true;
  const own = version, text = T.value, began = performance.now();
  const answer = await post("check", { text });
  checking = false;
  if (own === version || held || steering) checked(answer, text, own, began);
  if (again) {
    again = false;
    check();
  }
}

function checked(answer, text, own, began) {
  times.checked = own;
  if (answer.error) return tell(answer.error, true);
  $("plots").style.visibility = answer.data && !answer.empty ? "" : "hidden"; // it keeps its room
  if (!answer.data) {
    movable = [];
    checkedText = null;
    numbers = {};
    insideOf({ joints: [], bounded: {}, freedoms: {} });
    $("facts").textContent = ""; // of another text
    play(false);
    tell("the picture is pale: it is of the last text without errors", true);
    showErrors(answer.errors, answer.count);
    times.error = performance.now() - began;
    layHandles();
    return;
  }
  movable = answer.handles;
  numbers = answer.numbers;
  numberUnits = answer.units;
  checkedText = text;
  showErrors(answer.errors, answer.count);
  if (!playing || answer.errors.length) display(answer.data, "start");
  insideOf(answer);
  render();
  times.drawing = performance.now() - began;
  times.frames = (times.frames || 0) + 1;
  tell(answer.data.note);
  clearTimeout(timer);
  if (answer.empty) {
    $("facts").textContent = "";
    times.moved = own;
  } else if (!answer.errors.length && own === version && !held) timer = setTimeout(() => move(own, text), MOTION);
}

async function move(own, text) {
  const began = performance.now(), answer = await post("motion", { text, tab, asked: own });
  if (own !== version || answer.superseded) return;
  times.moved = own;
  if (answer.error) return tell(answer.error, true);
  if (answer.data) display(answer.data, "motion");
  render();
  askJoint();
  times.motion = performance.now() - began;
  tell(answer.reason || (answer.data && answer.data.note) || "", answer.status === "failed");
  if (answer.data && answer.status !== "failed") timer = setTimeout(() => enlive(own, text), LIVE);
}

async function enlive(own, text) {
  const began = performance.now(), answer = await post("live", { text, tab, asked: own });
  if (own !== version || answer.superseded || answer.error || held || steering) return;
  lively = answer.data !== null;
  if (!lively) steer();
  else display(answer.data, "live", answer.script ? executed(answer.script) : NOTHING);
  times.live = performance.now() - began;
  times.lived = own;
}

// The script of a live part runs with the word that the page's policy knows.
function executed(script) {
  const tag = document.createElement("script");
  tag.nonce = document.querySelector("script[nonce]").nonce;
  tag.textContent = `window.symgenLive = (() => {\n${script}\n})();`;
  document.head.append(tag);
  tag.remove();
  const code = window.symgenLive;
  delete window.symgenLive;
  return code;
}

changes.push((moving) => {
  version++;
  clearTimeout(timer);
  if (!moving) say("");
  showWhetherSaved();
  $("undo").disabled = !CodeMirror.undoDepth(box.state);
  $("redo").disabled = !CodeMirror.redoDepth(box.state);
  check();
});

// A slider's number goes into the text when it is let go.
$("live").addEventListener("change", (e) => {
  const name = e.target.dataset.name, span = name && Object.hasOwn(numbers, name) && checkedText === T.value ? numbers[name] : null;
  if (!span) return;
  const value = [...$("live").querySelectorAll('input[type="number"]')].find((x) => x.dataset.name === name).valueAsNumber;
  const before = T.value.slice(...span), text = String(value);
  if (Number.isFinite(value)) setText(T.value.slice(0, span[0]) + (/[.e]/i.test(before) && !/[.e]/i.test(text) ? `${text}.0` : text) + T.value.slice(span[1]));
});

// -- names ----------------------------------------------------------------------------------------------------------------

// The path of what the cursor is at: a parameter, a named point, or the table.
function atCursor() {
  const c = context(), [section, name] = c.table, line = T.value.split("\n")[lineAt(T.selectionStart) - 1] || "";
  const key = /^\s*["']?([\w-]+)["']?\s*=/.exec(line)?.[1];
  const begin = T.value.lastIndexOf("\n", T.selectionStart - 1) + 1, header = /^\s*\[+([\w.-]+)\]/.exec(line);
  if (header) return header[1].split(".").slice(0, 2).join(".");
  if (section === "bodies" && key === "points") {
    const inner = [...line.matchAll(/([A-Za-z]\w*)\s*=\s*\[/g)].find((m) => begin + m.index <= T.selectionStart && T.selectionStart <= begin + m.index + m[1].length);
    if (inner) return `bodies.${name}.points.${inner[1]}`;
  }
  if (["parameters", "inputs", "outputs"].includes(section) && c.table.length === 1) return key ? `${section}.${key}` : "";
  return name ? `${section}.${name}` : "";
}

let naming = "";
function rename() {
  naming = document.activeElement !== T && selected ? selected : atCursor();
  if (!naming) return say("put the cursor at a body, a joint, a force, a point or a parameter", true);
  $("naming").hidden = false;
  $("named").textContent = `New name of ${naming}`;
  $("name").value = naming.split(".").pop();
  $("name").select();
}

async function named_so(on) {
  $("naming").hidden = true;
  const text = T.value, place = T.selectionStart;
  T.focus();
  if (!on) return;
  const answer = await post("rename", { text, path: naming, name: $("name").value.trim() });
  if (answer.error) return say(answer.error, true);
  if (T.value === text) setText(answer.text, Math.min(place, answer.text.length));
}

async function remove(path = atCursor()) {
  const text = T.value, place = T.selectionStart;
  if (!path) return say("put the cursor into the table that is to be taken out", true);
  const answer = await post("remove", { text, path });
  if (answer.error) return say(answer.error, true);
  if (T.value !== text) return;
  setText(answer.text, Math.min(place, answer.text.length));
  say(`took out ${path}`);
}
$("rename").addEventListener("click", rename);
$("remove").addEventListener("click", () => remove());
$("give").addEventListener("click", () => named_so(true));
$("keep").addEventListener("click", () => named_so(false));
$("name").addEventListener("keydown", (e) => {
  if (e.key === "Enter" || e.key === "Escape") {
    e.preventDefault();
    named_so(e.key === "Enter");
  }
});

// -- keys -----------------------------------------------------------------------------------------------------------------

$("undo").addEventListener("click", undo);
$("redo").addEventListener("click", redo);
window.addEventListener("keydown", (e) => {
  const key = e.key.toLowerCase(), act = e.ctrlKey || e.metaKey
    ? { s: save, f: seek, z: e.shiftKey ? redo : undo, y: redo }[key]
    : { f2: rename, escape: tool !== "move" && (() => choosing("move")) }[key];
  if (!act || (key === "z" && e.target !== T && e.target.tagName === "INPUT")) return;
  if (key !== "escape") e.preventDefault();
  e.stopPropagation();
  act();
}, { capture: true });

window.symgen.editor = { times: () => times, version: () => version, handles: () => movable, place: onPicture, grid: (scale) => [gridded(BETWEEN, scale), parted(gridded(BETWEEN, scale))], check, offer, rates: (kind) => [data.points.map((p) => p[0]), ratesAt(kind, time), largestRate(kind)], kept: () => !keeping && !newer && kept && !forgetting, checked: () => times.checked === version, rest: () => !checking && !again && times.moved === version };
choosing("move");
open();
