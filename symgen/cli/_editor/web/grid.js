// -- places on the picture, and the grid of 1, 2 and 5 that a hand is rounded to -------------------------------------------

const BETWEEN = 40; // pixels between lines with numbers, at least

// By what is in the middle: where the camera was last drawn from may be a picture ago.
const onPicture = (x, y) => {
  const { at, scale, width, height } = view.camera;
  return [(x - at[0]) * scale + width / 2, height / 2 - (y - at[1]) * scale];
};
const onPlane = (px, py) => {
  const { at, scale, width, height } = view.camera;
  return [(px - width / 2) / scale + at[0], (height / 2 - py) / scale + at[1]];
};

// The smallest of 1, 2, 5, 10, ... that is some pixels wide [m].
function gridded(pixels, scale = view.camera.scale) {
  const least = (pixels / scale) * (1 - 1e-9), ten = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map((x) => +(x * ten).toPrecision(1)).find((x) => x >= least);
}
// Lines with numbers, and the finer ones that places are rounded to.
const parted = (step) => step / (Math.round(step / 10 ** Math.floor(Math.log10(step) + 1e-9)) === 2 ? 4 : 5);
const handStep = () => (snapping.checked ? parted(gridded(BETWEEN)) : gridded(0.5));
const onGrid = (x, step) => Math.round(x / step) * step;
const decimals = (step) => Math.max(0, Math.min(12, -Math.floor(Math.log10(step) + 1e-9)));
const onLattice = (x, step) => +onGrid(x, step).toFixed(decimals(step));

// A number as it is written in place of another one.
function written(x, step, before) {
  const text = String(onLattice(x, step));
  return /[.e]/i.test(before) && !/[.e]/i.test(text) ? `${text}.0` : text;
}

// -- what is seen of it ---------------------------------------------------------------------------------------------------

let hovered = null; // where the hand is, as it would be taken
const pointer = element("div");
pointer.id = "pointer";
pointer.setAttribute("aria-hidden", "true"); // what is taken is said by the points themselves

// Behind everything that the player draws.
function underlay() {
  const bare = view.clear;
  view.clear = () => {
    bare();
    if (view.spatial) return;
    drawGrid($("view").getContext("2d"));
    if (motion.rows.length) return;
    drawHand(); // nothing else is drawn
    drawTask();
  };
}

function drawGrid(context) {
  const { width, height } = view.camera, step = gridded(BETWEEN), fine = parted(step);
  const [left, top] = onPlane(0, 0), [right, low] = onPlane(width, height);
  const across = (x, colour, thick) => line(context, [onPicture(x, 0)[0], 0], [onPicture(x, 0)[0], height], colour, thick);
  const along = (y, colour, thick) => line(context, [0, onPicture(0, y)[1]], [width, onPicture(0, y)[1]], colour, thick);
  for (const [every, thick] of [[fine, 0.35], [step, 0.8]]) {
    for (let k = Math.ceil(left / every); k <= right / every; k++) across(k * every, palette.line, thick);
    for (let k = Math.ceil(low / every); k <= top / every; k++) along(k * every, palette.line, thick);
  }
  across(0, palette.passed, 1);
  along(0, palette.passed, 1);
  context.font = "10px system-ui, sans-serif";
  context.fillStyle = palette.soft;
  context.textAlign = "center";
  for (let k = Math.ceil(left / step); k <= right / step; k++) {
    const x = onPicture(k * step, 0)[0];
    if (x > 40 && x < width - 20) context.fillText(String(onLattice(k * step, step)), x, 10);
  }
  context.textAlign = "left";
  for (let k = Math.ceil(low / step); k <= top / step; k++) {
    const y = onPicture(0, k * step)[1];
    if (y > 20 && y < height - 30) context.fillText(String(onLattice(k * step, step)), 3, y + 3);
  }
  const long = step * view.camera.scale, y = height - 8, x = width - 12 - long;
  for (const [a, b] of [[[x, y], [x + long, y]], [[x, y - 4], [x, y + 4]], [[x + long, y - 4], [x + long, y + 4]]]) line(context, a, b, palette.ink, 1.5);
  context.textAlign = "center";
  context.fillStyle = palette.ink;
  context.fillText(`${short(step)} m`, x + long / 2, y - 6);
}

function line(context, a, b, colour, thick) {
  context.strokeStyle = colour;
  context.lineWidth = thick;
  context.beginPath();
  context.moveTo(...a);
  context.lineTo(...b);
  context.stroke();
}

// Where the hand is, and how far and in which direction from the point that was taken last.
function drawHand() {
  pointer.hidden = !hovered || view.spatial;
  if (pointer.hidden) return;
  const from = pressed || spots.at(-1), dx = from ? hovered.x - from.x : 0, dy = from ? hovered.y - from.y : 0;
  const place = `x ${short(hovered.x)}, y ${short(hovered.y)} m`;
  pointer.textContent = from && (dx || dy) ? `${place}; ${short(Math.hypot(dx, dy))} m at ${short((Math.atan2(dy, dx) * 180) / Math.PI)} deg` : place;
  if (!from) return;
  const context = $("view").getContext("2d");
  context.setLineDash([6, 4]);
  line(context, onPicture(from.x, from.y), onPicture(hovered.x, hovered.y), palette.reaction, 1.5);
  context.setLineDash([]);
}
drawn.push(drawHand);
