// -- room for the drawing: the player's parts at other places than in a page that only plays -----------------------------------

// What is seldom used is folded away behind a word, above what lies there.
function menu(id, word, ...parts) {
  const box = element("details", "", "menu"), inside = element("div", "", "folded");
  box.id = id;
  box.append(element("summary", word), inside);
  inside.append(...parts);
  box.addEventListener("keydown", (e) => {
    if (e.key !== "Escape" || !box.open) return;
    e.stopPropagation();
    box.open = false;
    box.firstChild.focus();
  });
  document.addEventListener("pointerdown", (e) => box.open && !box.contains(e.target) && (box.open = false));
  return box;
}

{
  const [first, second] = document.querySelectorAll("#controls > .row"), shown = ["loop", "labels", "forces", "gaps"].map((id) => $(id).closest("label"));
  second.prepend(menu("seen", "View", $("trace").closest("label"), rateBox, longest, ...shown.slice(0, 2), sizesBox, ...shown.slice(2), second.querySelector(".end")));
  first.after(second);
  const head = document.querySelector("body > header"), title = element("div", "", "title"), placed = element("div", "", "placed");
  title.append(...head.children, freedomLine, modeLine);
  placed.append(snap, where, bench.querySelector(".photo"));
  head.append(title, placed);
  $("pane").insertBefore(inside, $("about"));
  $("pane").insertBefore($("live"), $("about"));
  $("pane").append($("note"));
}

// -- what is selected: by a click in the picture or the cursor in the text ------------------------------------------------------

let selected = ""; // the path of a body, joint or force

// The table of a path in the text: its header and its end.
function tableOf(path) {
  const header = T.value.indexOf(`[${path}]`), next = header < 0 ? -1 : T.value.indexOf("\n[", header + 1);
  return header < 0 ? null : [header, next < 0 ? T.value.length : next];
}

function selectPart(path) {
  selected = path;
  const found = path && tableOf(path);
  if (found) select(found[0], found[0] + path.length + 2, false);
  wanted = true;
}

// The body, joint or force that is nearest to a place of the picture.
const SECTIONS = { body: "bodies", joint: "joints", force: "forces", contact: "contacts" };
const pathOf = (item) => `${SECTIONS[item.role]}.${item.name}`;
function partAt(px, py) {
  const found = view.spatial ? null : itemAt(px, py, Object.keys(SECTIONS));
  return found && tableOf(pathOf(found.item)) ? pathOf(found.item) : "";
}

// A press that does not move selects; one that moves turns the player's camera, as before.
let pressedAt = null;
$("view").addEventListener("pointerdown", (e) => tool === "move" && (pressedAt = inPicture(e)));
$("view").addEventListener("pointerup", (e) => {
  if (!pressedAt || tool !== "move") return;
  const at = inPicture(e), still = Math.hypot(at[0] - pressedAt[0], at[1] - pressedAt[1]) < 4;
  pressedAt = null;
  if (!still) return;
  choosePart(partAt(...at));
});
function choosePart(path) {
  selectPart(path);
  say(selected ? `${selected} is selected: Del takes it out, F2 renames it` : "");
}
// A body that is selected is the one that arrow keys pull while the motion plays.
Object.assign(choice, { get: () => (selected.startsWith("bodies.") ? selected.slice(7) : ""), set: (name) => choosePart(`bodies.${name}`) });

// What is selected is drawn again, with a glow.
drawn.push((q) => {
  const item = selected && !view.spatial && data.scene.items.find((each) => SECTIONS[each.role] && selected === pathOf(each));
  if (item) glow(item, q);
});
selections.push(() => {
  if (document.activeElement !== T) return;
  const path = atCursor().split(".").slice(0, 2).join(".");
  if (path === selected || !/^(bodies|joints|forces|contacts)\./.test(path)) return;
  selected = path;
  wanted = true;
});
window.addEventListener("keydown", (e) => {
  if (e.key !== "Delete" || !selected || e.target === T || /^(INPUT|SELECT|TEXTAREA)$/.test(e.target.tagName)) return;
  e.preventDefault();
  remove(selected);
});
changes.push(() => selected && !tableOf(selected) && (selected = ""));

