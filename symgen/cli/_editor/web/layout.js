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
  second.prepend(menu("seen", "View", $("trace").closest("label"), ...shown, second.querySelector(".end")));
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

// The body or joint whose marks lie nearest to a place of the picture, within some pixels.
function partAt(px, py) {
  const q = between(motion, time);
  if (!q || view.spatial) return "";
  let best = [NEAR * NEAR, ""];
  view.place(q);
  for (const item of data.scene.items) {
    if (item.role !== "body" && item.role !== "joint" && item.role !== "force") continue;
    for (const mark of item.marks) {
      const ends = outlineOf(mark, q);
      for (let i = 0; i + 1 < ends.length; i++) {
        const far = fromStretch([px, py], ends[i], ends[i + 1]) * (item.role === "body" ? 1 : 0.8); // joints lie on bodies
        if (far < best[0]) best = [far, `${{ body: "bodies", joint: "joints", force: "forces" }[item.role]}.${item.name}`];
      }
    }
  }
  return tableOf(best[1]) ? best[1] : "";
}

function outlineOf(mark, q) {
  const put = (body, at) => onPicture(...worldOf(q, body, at));
  if (mark[0] === "L") {
    const [, , body, closed, points] = mark, all = [];
    for (let i = 0; i < points.length; i += 2) all.push(put(body, points.slice(i, i + 2)));
    return closed && all.length ? [...all, all[0]] : all;
  }
  if (mark[0] === "D") return [put(mark[2], mark[3]), put(mark[2], mark[3])];
  if (mark[0] === "X") return [put(mark[3], mark[4]), put(mark[5], mark[6])];
  return [];
}

function fromStretch([x, y], [ax, ay], [bx, by]) {
  const dx = bx - ax, dy = by - ay, s = Math.min(Math.max(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy || 1), 0), 1);
  return (ax + s * dx - x) ** 2 + (ay + s * dy - y) ** 2;
}

// A press that does not move selects; one that moves turns the player's camera, as before.
let pressedAt = null;
$("view").addEventListener("pointerdown", (e) => tool === "move" && (pressedAt = inPicture(e)));
$("view").addEventListener("pointerup", (e) => {
  if (!pressedAt || tool !== "move") return;
  const at = inPicture(e), still = Math.hypot(at[0] - pressedAt[0], at[1] - pressedAt[1]) < 4;
  pressedAt = null;
  if (!still) return;
  selectPart(partAt(...at));
  say(selected ? `${selected} is selected: Del takes it out, F2 renames it` : "");
});

// What is selected is drawn again, with a glow.
drawn.push((q) => {
  const item = selected && data.scene.items.find((each) => selected === `${{ body: "bodies", joint: "joints", force: "forces" }[each.role]}.${each.name}`);
  if (!item || view.spatial) return;
  const context = $("view").getContext("2d");
  context.save();
  Object.assign(context, { strokeStyle: palette.accent, globalAlpha: 0.35, lineWidth: 9, lineCap: "round", lineJoin: "round" });
  for (const mark of item.marks) {
    const ends = outlineOf(mark, q);
    context.beginPath();
    ends.forEach((p, i) => (i ? context.lineTo(...p) : context.moveTo(...p)));
    context.stroke();
  }
  context.restore();
});
document.addEventListener("selectionchange", () => {
  if (document.activeElement !== T) return;
  const path = atCursor().split(".").slice(0, 2).join(".");
  if (path === selected || !/^(bodies|joints|forces)\./.test(path)) return;
  selected = path;
  wanted = true;
});
window.addEventListener("keydown", (e) => {
  if (e.key !== "Delete" || !selected || e.target === T || /^(INPUT|SELECT|TEXTAREA)$/.test(e.target.tagName)) return;
  e.preventDefault();
  remove(selected);
});
changes.push(() => selected && !tableOf(selected) && (selected = ""));

