// -- arrows of velocities and accelerations at points, by differences of the motion that is shown -----------------------------

const RATES = { velocity: ["m/s", 1], acceleration: ["m/s2", 2] };
const shownRate = element("select"), longest = element("output", "", "longest"), rateBox = element("label", "arrows ", "choice");
for (const [word, value] of [["none", ""], ...Object.keys(RATES).map((name) => [name, name])]) shownRate.append(new Option(word, value));
shownRate.id = "rates";
rateBox.append(shownRate);
shownRate.addEventListener("change", () => (wanted = true));
let scaled = { motion: null, kind: "", most: 0 }; // the largest of a motion

// A rate of each point at a time: of the first or second order, between frames that lie around it.
function ratesAt(kind, at) {
  const { t } = motion, n = t.length;
  if (n < 3) return [];
  const h = (t[n - 1] - t[0]) / (n - 1), middle = Math.min(Math.max(at, t[0] + h), t[n - 1] - h);
  const [before, now, after] = [-h, 0, h].map((d) => {
    view.place(between(motion, middle + d));
    return data.points.map(([, body, point]) => Array.from(view.see(body, point)).slice(0, 2));
  });
  return now.map((p, i) => p.map((x, k) => (kind === "velocity" ? (after[i][k] - before[i][k]) / (2 * h) : (after[i][k] - 2 * x + before[i][k]) / (h * h))));
}

function largestRate(kind) {
  if (scaled.motion !== motion || scaled.kind !== kind) {
    const { t } = motion, every = Math.max(1, Math.floor(t.length / 60));
    let most = 0;
    for (let k = 0; k < t.length; k += every) for (const v of ratesAt(kind, t[k])) most = Math.max(most, Math.hypot(...v));
    scaled = { motion, kind, most };
  }
  return scaled.most;
}

drawn.push((q) => {
  const kind = view.spatial ? "" : shownRate.value, most = kind ? largestRate(kind) : 0;
  longest.textContent = kind && most ? `longest ${short(most)} ${RATES[kind][0]}` : "";
  if (!most) return;
  const rates = ratesAt(kind, time), long = 0.2 * Math.min(view.camera.width, view.camera.height);
  view.place(q);
  rates.forEach((v, i) => view.arrow(data.points[i][1], data.points[i][2], v, long / most, kind === "velocity" ? palette.accent : palette.reaction));
});

