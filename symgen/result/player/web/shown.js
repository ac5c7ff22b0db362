// -- drawing --------------------------------------------------------------------------------------------------------------

const visible = () => $("picture").clientWidth > 0 && $("picture").clientHeight > 0;

function render() {
  if (!visible()) return; // in a frame that is hidden
  const q = between(motion, time) || []; // of nothing, where nothing is drawn yet
  view.clear();
  for (const [name, points, colour] of traced) if (name) view.trace(points, colour);
  const ghosts = motion === motions[0] ? motions.slice(1) : motions.slice(0, 1);
  for (const ghost of ghosts) view.draw(between(ghost, Math.min(time, ghost.end)), 0.25, ["body", "force"]);
  view.draw(q, 1, null, isClosed);
  if ($("forces").checked) arrows(q);
  if ($("gaps").checked) gaps(q);
  if ($("labels").checked) view.names();
  timeline();
  if (group) plot.cursor(columnAt(over().along, motion.t, time), group.columns.map((c) => columnAt(c, motion.t, time)), group.log);
  const doubt = motion.moments.filter((m) => m[0] <= time && time <= m[1]);
  $("clock").textContent = `${local(time.toFixed(3))} s of ${local(motion.end.toFixed(2))}`;
  const bare = $("forces").checked && motion !== motions[0] && !motion.reactions && !motion.pulls ? ["forces are those of the recorded motion"] : [];
  $("hint").textContent = [...doubt.map((m) => m[3]), ...bare, handInWords()].filter(Boolean).join("; ");
  wanted = false;
  for (const each of drawn) each(q);
}

// Whether an item is a contact that is closed: its mode is among the curves, and in frames of a motion that is worked out.
function isClosed(item) {
  if (item.role !== "contact") return false;
  const name = `${item.name}.mode`, k = index(motion.t, time);
  if (!motion.whole) {
    const place = columns ? columns.names.indexOf(name) : -1;
    return place >= 0 && motion.values[k]?.[place] !== 0;
  }
  const part = motion.groups.find((g) => g.names.includes(name));
  return part ? part.columns[part.names.indexOf(name)][k] !== 0 : false;
}

function arrows(q) {
  const { reactions, pulls } = motion;
  const items = Object.fromEntries(data.scene.items.map((item) => [`${item.role} ${item.name}`, item]));
  const long = 0.16 * Math.min(view.camera.width, view.camera.height), d = view.spatial ? 3 : 2;
  if (reactions) {
    const most = largest(reactions, d);
    reactions.names.forEach((name, j) => {
      const item = items[`joint ${name}`];
      if (!item || !item.ends.length || !(most > 0)) return;
      const f = Array.from({ length: d }, (_, c) => columnAt(reactions.columns[j * d + c], motion.t, time));
      view.arrow(item.ends[0][0], item.ends[0][1], f, long / most, palette.reaction);
    });
  }
  if (pulls) {
    const most = largest(pulls, 1);
    pulls.names.forEach((name, j) => {
      const item = items[`force ${name}`], mark = item && item.marks.find((m) => m[0] === "X");
      if (!mark || !(most > 0)) return;
      const [, , , body, at, other, to] = mark, f = columnAt(pulls.columns[j], motion.t, time) / most;
      const a = worldOf(q, body, at), b = worldOf(q, other, to), l = Math.hypot(...b.map((x, i) => x - a[i])) || 1;
      const way = b.map((x, i) => (x - a[i]) / l);
      view.place(q);
      view.arrow(other, to, way.map((x) => x * f), long, palette.push);
      view.arrow(body, at, way.map((x) => -x * f), long, palette.push);
    });
  }
}

const worldOf = (q, body, at) => (body < 0 ? [...at, 0].slice(0, 3) : view.where(q, body, at));

function largest(part, d) {
  if (part.most === undefined) {
    part.most = 0;
    for (let j = 0; j < part.names.length; j++) for (let k = 0; k < motion.t.length; k++) {
      let sum = 0;
      for (let c = 0; c < d; c++) sum += (part.columns[j * d + c][k] || 0) ** 2;
      part.most = Math.max(part.most, Math.sqrt(sum));
    }
  }
  return part.most;
}

// Each joint by how far it is open itself: of a recording that is told, here it would be lost in the last bits.
const PINS = ["revolute", "spherical", "universal", "constant-velocity", "rigid"];
function gaps(q) {
  const told = motion.gaps;
  for (const item of data.scene.items) {
    if (item.role !== "joint" || item.ends.length !== 2 || !PINS.includes(item.kind)) continue;
    const [a, b] = item.ends.map(([body, at]) => worldOf(q, body, at)), seen = Math.hypot(...a.map((x, i) => b[i] - x));
    const k = told ? told.names.indexOf(item.name) : -1;
    const size = k < 0 ? Math.log10(Math.max(seen, 1e-17)) : columnAt(told.columns[k], motion.t, time); // the power of ten
    const hue = Math.round(120 * Math.min(Math.max((-4 - size) / 8, 0), 1)); // red from 1e-4 on, green below 1e-12
    view.gap(q, item.ends, seen > 0 ? (1000 * 10 ** size) / seen : 0, `hsl(${hue},90%,40%)`);
  }
}

function timeline() {
  const canvas = $("timeline"), [context, width, height] = sized(canvas);
  const x = (t) => 6 + ((t - motion.t[0]) / (motion.end - motion.t[0] || 1)) * (width - 12);
  context.fillStyle = palette.track;
  context.fillRect(6, 12, width - 12, 10);
  if (motion.status !== "ok") {
    context.fillStyle = motion.status === "failed" ? palette.failed : palette.doubtful;
    context.fillRect(6, 12, width - 12, 10);
  }
  context.fillStyle = palette.passed;
  context.fillRect(6, 12, x(time) - 6, 10);
  for (const [begin, end, kind] of motion.moments) {
    context.fillStyle = { rank: palette.reaction, event: palette.accent }[kind] || palette.push;
    context.fillRect(x(begin) - 1, 8, Math.max(2, x(end) - x(begin)), 18);
  }
  context.fillStyle = palette.ink;
  context.fillRect(x(time) - 2, 6, 4, 22);
  canvas.setAttribute("aria-valuenow", time.toFixed(3));
  canvas.setAttribute("aria-valuemax", motion.end.toFixed(3));
}
