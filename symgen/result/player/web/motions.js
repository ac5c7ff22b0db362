// The page: time, controls, what is drawn beside the mechanism, and the live part.

let data = opened(JSON.parse(document.getElementById("data").textContent));
// Bodies that look alike share their lists of points.
function opened(data) {
  for (const item of data.scene.items) {
    for (const mark of item.marks) {
      if (mark[0] === "L") mark[4] = data.scene.lists[mark[4]];
      else if (mark[0] === "S") mark[3] = mark[3].map((i) => data.scene.lists[i]);
    }
    for (const piece of (item.sides || []).flat()) piece[1] = data.scene.lists[piece[1]];
  }
  return data;
}
const $ = (id) => document.getElementById(id);
const preferred = matchMedia("(prefers-color-scheme: dark)");
let theme = ""; // what the page was set to, else it has that of the system
function paintPage() {
  document.documentElement.dataset.theme = theme || (preferred.matches ? "dark" : "light");
  readPalette();
}
paintPage();
let solid = null, view = null;
function stage() {
  solid = data.scene.spatial ? makeSolid($("solid"), data.scene) : null;
  $("solid").hidden = !solid;
  view = makeScene($("view"), data.scene, solid);
}
stage();
$("solid").addEventListener("webglcontextlost", () => {
  // the canvas above draws what it can
  $("solid").hidden = true;
  solid = null;
  view = makeScene($("view"), data.scene);
  refitUnlooked();
});
let single = null; // the one curve of the group that is shown
const plot = makePlot($("plot"), $("key"), (i) => {
  single = single === i ? null : i;
  choose();
});

function recorded(part) {
  const n = part.count, t = floatColumns(part.t, n)[0] || new Float32Array(0), columns = typeof part.q === "string" ? floatColumns(part.q, n) : shortColumns(part.q, n);
  const rows = Array.from({ length: n }, (_, k) => Float64Array.from(columns, (c) => c[k]));
  const groups = part.groups.map((g) => ({ ...g, columns: g.places ? cleaned(g.places.map((i) => columns[i]), g) : filled(g, n) }));
  for (const name of ["reactions", "pulls", "gaps"]) if (part[name]) part[name].columns = shortColumns(part[name], n);
  return { ...part, t: Float64Array.from(t), rows, groups, end: n ? t[n - 1] : 0, whole: true };
}

// Columns of every so many frames, the last one among them, at all frames.
function filled(g, n) {
  const every = g.every, count = n ? Math.ceil((n - 1) / every) + 1 : 0;
  return shortColumns(g, count).map((column) => Float64Array.from({ length: n }, (_, k) => {
    const j = Math.floor(k / every), begin = j * every, end = Math.min(begin + every, n - 1);
    return k === begin ? column[j] : column[j] + ((column[j + 1] - column[j]) * (k - begin)) / (end - begin);
  }));
}

let motions = data.motions.map(recorded);
let motion = motions[0]; // what is played: the recording, or what the live part works out
let time = motion.t[0] || 0, playing = false, speed = 1, last = 0, group = null, wanted = true;
let traced = [];
const drawn = []; // called after each picture

// -- positions between frames ---------------------------------------------------------------------------------------------

function index(t, time) {
  let low = 0, high = t.length - 1;
  while (high - low > 1) {
    const k = (low + high) >> 1;
    if (t[k] <= time) low = k;
    else high = k;
  }
  return low;
}

// Cubic between frames, with slopes of their neighbours.
function between(motion, time) {
  const { t, rows } = motion;
  if (t.length < 2) return rows[0];
  const k = index(t, time), h = t[k + 1] - t[k] || 1, s = Math.min(Math.max((time - t[k]) / h, 0), 1);
  if (s === 0) return rows[k];
  if (s === 1) return rows[k + 1];
  const a = rows[k], b = rows[k + 1], before = rows[k - 1], after = rows[k + 2];
  const lead = k > 0 ? h / (t[k + 1] - t[k - 1]) : 1, tail = after ? h / (t[k + 2] - t[k]) : 1;
  return a.map((x, i) => {
    const m = before ? (b[i] - before[i]) * lead : b[i] - x, n = after ? (after[i] - x) * tail : b[i] - x;
    return x + s * (m + s * (3 * (b[i] - x) - 2 * m - n + s * (m + n - 2 * (b[i] - x))));
  });
}

function columnAt(column, t, time) {
  const k = index(t, time), s = t.length > 1 ? (time - t[k]) / (t[k + 1] - t[k] || 1) : 0;
  return column[k] + Math.min(Math.max(s, 0), 1) * ((column[k + 1] ?? column[k]) - column[k]);
}
