// -- the file: read, saved, kept while it is not saved --------------------------------------------------------------------

const LOOK = 2000; // milliseconds between looks at the file on the disk
let digest = "", saved = null, original = ""; // of the file; its text, null where it does not exist yet; what it began with

const isUnsaved = () => T.value !== (saved ?? original);
function showWhetherSaved() {
  $("dirty").hidden = !isUnsaved();
  $("dirty").textContent = saved === null ? "never saved" : "changed";
}

async function open(again = false) {
  const answer = await post("load", {});
  if (answer.error) return say(answer.error, true);
  digest = answer.digest;
  saved = digest ? answer.text : null;
  original = answer.text;
  if (again) {
    setText(answer.text, 0);
    say(`loaded ${editor.file}`);
  } else beginText(answer.text);
  showWhetherSaved();
  if (!again) answer.unsaved.forEach(offerUnsaved);
}

async function save(force = false) {
  const text = T.value, answer = await post("save", { text, digest, force });
  if (answer.error) return say(answer.error, true);
  if (answer.changed) {
    $("question").textContent = `${editor.file} has changed on the disk since it was read here.`;
    return $("ask").showModal();
  }
  digest = answer.digest;
  saved = text;
  withdraw("disk");
  showWhetherSaved();
  keep();
  say(`saved ${editor.file}`);
}
$("save").addEventListener("click", () => save());
for (const [id, act] of [["overwrite", () => save(true)], ["take", () => open(true)], ["back", () => {}]]) {
  $(id).addEventListener("click", () => {
    $("ask").close();
    act();
  });
}
window.addEventListener("beforeunload", (e) => isUnsaved() && e.preventDefault());

// -- kept by the server, until it is saved ----------------------------------------------------------------------------------

let keeping = false, newer = false, kept = true;
async function keep() {
  if (keeping) return (newer = true);
  keeping = true;
  do {
    newer = false;
    const answer = await post("keep", { text: T.value, tab });
    const now = !answer.error && answer.kept;
    if (kept && !now) offer("kept", answer.error || `Texts that are not saved cannot be kept on this computer: until it is saved, ${editor.file} is in this page alone.`, [["Download it", download]]);
    else if (now) withdraw("kept");
    kept = now;
  } while (newer);
  keeping = false;
}
changes.push((moving) => moving || keep());
window.addEventListener("pagehide", () => (keeping || newer) && navigator.sendBeacon("keep", new Blob([JSON.stringify({ text: T.value, tab })], { type: "application/json" })));

function download() {
  const link = element("a");
  link.href = URL.createObjectURL(new Blob([T.value], { type: "application/toml" }));
  link.download = editor.file;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

let forgetting = 0;
async function forget(page) {
  forgetting++;
  await post("forget", { tab: page }, { keepalive: true }); // also where the page is left at once
  forgetting--;
}

// A text of an earlier page, of one that crashed, or of another window.
function offerUnsaved({ page, time, text }) {
  const when = new Date(1000 * time), today = when.toDateString() === new Date().toDateString();
  const at = today ? when.toLocaleTimeString() : when.toLocaleString(), lines = text.split("\n").length;
  offer(`unsaved ${page}`, `There is a text of ${editor.file} that was never saved, of ${at}, with ${lines} lines.`, [
    ["Go on with it", async () => {
      setText(text, 0);
      await keep();
      if (kept) forget(page);
      say("this is the text that was never saved; Undo goes back to the one before");
    }],
    ["Throw it away", () => forget(page)],
  ]);
}

// -- what is offered: one thing after the other, and Cancel first ------------------------------------------------------------

const offers = new Map();
function offer(kind, text, acts) {
  offers.set(kind, [text, acts]);
  showOffer();
}
function withdraw(kind) {
  if (!offers.delete(kind)) return;
  lookedAt = null;
  showOffer();
}
function showOffer() {
  const [first] = offers;
  $("offer").hidden = !first;
  $("answers").textContent = "";
  if (!first) return ($("offered").textContent = "");
  const [kind, [text, acts]] = first;
  $("offered").textContent = text;
  for (const [word, act, look] of [["Cancel", () => {}], ...acts]) {
    const button = element("button", word);
    if (look) for (const name of ["pointerenter", "focus"]) button.addEventListener(name, look);
    button.addEventListener("click", () => {
      withdraw(kind);
      act();
    });
    $("answers").append(button);
  }
}

// -- changes of others -------------------------------------------------------------------------------------------------------

let seen = null; // the digest of the file that was offered last
async function look() {
  const before = digest, answer = await post("state", {});
  if (answer.error) {
    if (kept) keep(); // which says that nobody answers
    return;
  }
  if (!kept) keep();
  if (digest !== before || answer.digest === digest) return answer.digest === digest && withdraw("disk");
  if (answer.digest === seen) return;
  seen = answer.digest;
  if (!answer.digest) return offer("disk", `${editor.file} has gone from the disk.`, [["Save it again", () => save(true)]]);
  const also = isUnsaved() ? " Your text is not saved: Undo brings it back after the file was loaded." : "";
  offer("disk", `${editor.file} has changed on the disk.${also}`, [["Load the file", () => open(true)], ...(also ? [["Save over it", () => save(true)]] : [])]);
}
setInterval(() => document.hidden || look(), LOOK);
window.addEventListener("focus", look);

