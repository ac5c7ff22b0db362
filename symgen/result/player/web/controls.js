// -- controls -------------------------------------------------------------------------------------------------------------

function facts() {
  $("facts").textContent = "";
  motion.facts.forEach(([label, text], i) => {
    const part = document.createElement("span");
    part.textContent = `${i ? " · " : ""}${label ? `${label} ` : ""}${text}`;
    if (label === "status" && text !== "ok") part.className = "bad";
    $("facts").append(part);
  });
  $("note").textContent = data.note;
}

// A motion of less than a second is slowed down until an eye can follow it.
const SPEEDS = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.25, 0.5, 1, 2, 5, 10];
for (const s of SPEEDS) $("speed").append(new Option(`${s}×`, s));
function pace() {
  speed = motion.end - time < 1 ? SPEEDS.filter((s) => motion.end - time >= 2 * s).pop() || SPEEDS[0] : 1;
  $("speed").value = speed;
}
// Points that no joint ties draw what a mechanism is for: the foot of a leg, the blade of a wiper.
function offerTraces() {
  const free = data.points.some((p) => p[3]), before = $("trace").value, first = !$("trace").length;
  fill($("trace"), [["", "none", ""], ...(free ? [["", "free points", "free"]] : []), ["", "all", "all"], ...data.points.map((p) => ["", p[0], p[0]])]);
  if (first || $("trace").value !== before) $("trace").value = free ? "free" : data.points.length <= 12 ? "all" : "";
}
$("speed").addEventListener("change", () => (speed = Number($("speed").value)));
$("trace").addEventListener("change", traces);
$("group").addEventListener("change", () => {
  single = null;
  choose();
});
$("over").addEventListener("change", choose);
$("play").addEventListener("click", () => play(!playing));
$("fit").addEventListener("click", refit);
for (const id of ["labels", "forces", "gaps"]) $(id).addEventListener("change", () => (wanted = true));

function retheme() {
  paintPage();
  view.dress();
  choose();
  traces();
}
$("theme").addEventListener("click", () => {
  theme = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
  retheme();
});
preferred.addEventListener("change", retheme);

// What a hand has chosen to look at stays until it asks for all.
let looked = false;
function refit() {
  looked = false;
  view.fit(motion.rows);
  wanted = true;
}
function refitUnlooked() {
  if (looked) wanted = true;
  else refit();
}

function drag(canvas, move) {
  const held = new Map();
  canvas.addEventListener("pointerdown", (e) => {
    canvas.setPointerCapture(e.pointerId);
    held.set(e.pointerId, [e.clientX, e.clientY]);
    move(e, 0, 0, null);
  });
  canvas.addEventListener("pointermove", (e) => {
    const before = held.get(e.pointerId);
    if (!before) return;
    let pinch = null;
    if (held.size === 2) {
      const other = [...held].find(([id]) => id !== e.pointerId)[1];
      pinch = Math.hypot(e.clientX - other[0], e.clientY - other[1]) / (Math.hypot(before[0] - other[0], before[1] - other[1]) || 1);
    }
    move(e, e.clientX - before[0], e.clientY - before[1], pinch);
    held.set(e.pointerId, [e.clientX, e.clientY]);
  });
  for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, (e) => held.delete(e.pointerId));
}

drag($("timeline"), (e) => {
  const box = $("timeline").getBoundingClientRect();
  go(motion.t[0] + ((e.clientX - box.left - 6) / (box.width - 12)) * (motion.end - motion.t[0]));
});
drag($("plot"), (e) => go(plot.timeAt(e.clientX - $("plot").getBoundingClientRect().left, time)));
drag($("view"), (e, dx, dy, pinch) => {
  const { camera } = view;
  looked ||= Boolean(pinch || (!view.spatial && (dx || dy)));
  if (pinch) {
    camera.scale *= pinch; // each finger moves the middle by half its way
    view.pan((-0.5 * dx) / camera.scale, (0.5 * dy) / camera.scale);
  } else if (view.spatial && !e.shiftKey && e.button !== 2) {
    camera.turn += 0.01 * dx;
    camera.tilt = Math.min(Math.max(camera.tilt + 0.01 * dy, -1.57), 1.57);
  } else {
    view.pan(-dx / camera.scale, dy / camera.scale);
  }
  wanted = true;
});
$("view").addEventListener("wheel", (e) => {
  e.preventDefault();
  looked = true;
  view.camera.scale *= Math.exp(-0.0015 * e.deltaY);
  wanted = true;
}, { passive: false });

window.addEventListener("keydown", (e) => {
  if (["SELECT", "INPUT", "BUTTON", "TEXTAREA"].includes(e.target.tagName) && e.target.type !== "checkbox") return;
  const frame = (motion.end - motion.t[0]) / 100;
  const act = {
    " ": () => play(!playing), ArrowRight: () => go(time + frame), ArrowLeft: () => go(time - frame),
    Home: () => go(motion.t[0]), End: () => go(motion.end), 0: refit, l: () => $("loop").click(),
    f: () => $("forces").click(), g: () => $("gaps").click(), n: () => $("labels").click(), d: () => $("theme").click(), b: chooseNext,
    "+": () => faster(1), "-": () => faster(-1),
  }[e.key];
  if (!act) return;
  e.preventDefault();
  act();
});

function faster(by) {
  const select = $("speed");
  select.selectedIndex = Math.min(Math.max(select.selectedIndex + by, 0), select.length - 1);
  speed = Number(select.value);
}

window.addEventListener("resize", () => {
  refitUnlooked();
  choose();
});
// A frame that was hidden when the page began gets its size without a word.
let wasVisible = visible();
new ResizeObserver(() => {
  if (visible() && !wasVisible) {
    refitUnlooked();
    choose();
  }
  wasVisible = visible();
}).observe($("picture"));
