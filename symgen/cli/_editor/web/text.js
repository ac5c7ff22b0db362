// -- the text -------------------------------------------------------------------------------------------------------------

const T = $("text"), LINE = 19, TOP = 6, LARGE = 200000, STEPS = 500;
const editor = data.editor;
let past = [], future = [], entry = { text: "", from: 0, to: 0 }, typed = { at: 0, kind: "" };
const changes = []; // called after each change, with whether a hand is moving something

function noteChange(moving = false) {
  paint();
  for (const each of changes) each(moving);
}

function remember(now, together = false) {
  if (!together) {
    past.push(entry);
    if (past.length > STEPS) past.shift();
  }
  future = [];
  entry = now;
}

// Another text, as one step of undo; the cursor goes to a place.
function setText(text, from = null, to = from) {
  T.classList.remove("moved");
  if (text === entry.text && text === T.value) return;
  const place = from ?? Math.min(T.selectionStart, text.length);
  T.value = text;
  T.setSelectionRange(place, to ?? place);
  remember({ text, from: place, to: to ?? place });
  typed = { at: 0, kind: "" };
  noteChange();
}

// A text that is still being dragged about: no step of undo.
function preview(text) {
  if (T.value === text) return;
  T.classList.add("moved"); // what is seen is the coloured text: nothing of a long field is laid out meanwhile
  T.value = text;
  noteChange(true);
}

// Begin with a text: nothing can be undone.
function beginText(text) {
  past = [];
  future = [];
  T.value = text;
  T.setSelectionRange(0, 0);
  entry = { text, from: 0, to: 0 };
  noteChange();
}

function travel(from, onto) {
  if (!from.length) return;
  onto.push({ text: T.value, from: T.selectionStart, to: T.selectionEnd });
  entry = from.pop();
  T.value = entry.text;
  T.setSelectionRange(entry.from, entry.to);
  typed = { at: 0, kind: "" };
  reveal(entry.from);
  noteChange();
}
const undo = () => travel(past, future), redo = () => travel(future, past);

T.addEventListener("beforeinput", (e) => {
  if (e.inputType !== "historyUndo" && e.inputType !== "historyRedo") return;
  e.preventDefault();
  (e.inputType === "historyUndo" ? undo : redo)();
});
T.addEventListener("input", (e) => {
  const now = performance.now(), together = now - typed.at < 600 && typed.kind === e.inputType && /^(insertText|delete)/.test(e.inputType);
  typed = { at: now, kind: e.inputType };
  reveal(T.selectionStart);
  remember({ text: T.value, from: T.selectionStart, to: T.selectionEnd }, together);
  noteChange();
});

// -- lines ----------------------------------------------------------------------------------------------------------------

let lines = [], bad = new Map();
const lineAt = (place) => T.value.slice(0, place).split("\n").length;

// Only lines that changed are painted anew; a very large text has no colours.
function paint() {
  const next = T.value.split("\n"), paper = $("paint"), numbers = $("numbers"), plain = T.value.length > LARGE;
  let head = 0, tail = 0;
  while (head < Math.min(lines.length, next.length) && lines[head] === next[head]) head++;
  while (tail < Math.min(lines.length, next.length) - head && lines[lines.length - 1 - tail] === next[next.length - 1 - tail]) tail++;
  for (let k = lines.length - tail; k > head; k--) paper.children[k - 1].remove();
  const fresh = document.createDocumentFragment();
  for (let k = head; k < next.length - tail; k++) fresh.append(colouredLine(next[k], plain));
  paper.insertBefore(fresh, paper.children[head] || null);
  while (numbers.children.length > next.length) numbers.lastChild.remove();
  while (numbers.children.length < next.length) numbers.append(element("div", String(numbers.children.length + 1)));
  lines = next;
  mark();
}

function mark() {
  for (const box of [$("paint"), $("numbers")]) {
    for (const each of box.querySelectorAll(":scope > .bad")) each.className = "";
    for (const line of bad.keys()) if (box.children[line - 1]) box.children[line - 1].className = "bad";
  }
  for (const each of $("numbers").querySelectorAll("[title]")) each.removeAttribute("title");
  for (const [line, text] of bad) if ($("numbers").children[line - 1]) $("numbers").children[line - 1].title = text;
}

// Bring a character into view.
function reveal(place) {
  const top = TOP + (lineAt(place) - 1) * LINE, box = $("paper");
  const column = place - (T.value.lastIndexOf("\n", place - 1) + 1), far = T.offsetLeft + 8 * (column + 3); // of its end, at most
  if (far < box.clientWidth) box.scrollLeft = 0; // what a long line has moved goes back
  if (top < box.scrollTop + LINE || top > box.scrollTop + box.clientHeight - 2 * LINE) box.scrollTop = Math.max(0, top - box.clientHeight / 3);
}

function select(from, to = from, focus = true) {
  if (focus) T.focus({ preventScroll: true });
  T.setSelectionRange(from, to);
  reveal(from);
  about();
}

const startOfLine = (line) => T.value.split("\n").slice(0, line - 1).join("\n").length + (line > 1 ? 1 : 0);

// -- find -----------------------------------------------------------------------------------------------------------------

function seek(on) {
  $("find").hidden = !on;
  $("seek").setAttribute("aria-expanded", on);
  if (on) $("sought").select();
  else T.focus();
}

function findNext() {
  const sought = $("sought").value.toLowerCase(), text = T.value.toLowerCase();
  if (!sought) return;
  const count = text.split(sought).length - 1;
  let at = text.indexOf(sought, T.selectionEnd);
  if (at < 0) at = text.indexOf(sought);
  $("found").textContent = count ? `${count} in the text` : "not in the text";
  if (at >= 0) {
    select(at, at + sought.length, false);
    T.focus({ preventScroll: true });
  }
}
$("seek").addEventListener("click", () => seek($("find").hidden));
$("next").addEventListener("click", findNext);
$("sought").addEventListener("keydown", (e) => {
  if (e.key === "Enter") findNext();
  else if (e.key === "Escape") seek(false);
});
