// Columns over time or another column on a canvas, with a cursor that is the player's.

const COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000"];

function decoded(text) {
  const bytes = atob(text), data = new Uint8Array(bytes.length);
  for (let i = 0; i < bytes.length; i++) data[i] = bytes.charCodeAt(i);
  return data.buffer;
}

function floatColumns(text, count) {
  const all = new Float32Array(decoded(text));
  return Array.from({ length: count ? all.length / count : 0 }, (_, i) => all.subarray(i * count, (i + 1) * count));
}

// Numbers of 16 bits between the smallest and the largest one: the number nearest to 0 stands for 0 itself.
function shortColumns(part, count) {
  const all = new Uint16Array(decoded(part.data));
  const value = (x, low, span) => {
    const number = low + (x / 65534) * span;
    return Math.abs(number) < 0.5 * span / 65534 ? 0 : number;
  };
  return part.low.map((low, i) => Float64Array.from(all.subarray(i * count, (i + 1) * count), (x) => (x === 65535 ? NaN : value(x, low, part.span[i]))));
}

function ticks(low, high, most) {
  const rough = (high - low) / most, power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((k) => k * power).find((s) => s >= rough) || power;
  const found = [];
  for (let x = Math.ceil(low / step - 1e-9) * step; x <= high + 1e-9 * step; x += step) found.push(Math.abs(x) < 1e-9 * step ? 0 : x);
  return found;
}

const local = (text) => (data.locale ? text.replace(".", data.locale.decimal) : text); // for readers: inputs keep points
const short = (x) => local(x === 0 ? "0" : Math.abs(x) >= 1e4 || Math.abs(x) < 1e-3 ? x.toExponential(1) : String(+x.toPrecision(4)));

function sized(canvas) {
  const ratio = window.devicePixelRatio || 1, box = canvas.getBoundingClientRect();
  canvas.width = Math.round(box.width * ratio);
  canvas.height = Math.round(box.height * ratio);
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  return [context, box.width, box.height];
}

// `chosen(i)` is called where a curve is clicked in the key.
function makePlot(canvas, key, chosen) {
  let picture = null, frame = null;

  // The columns of a group, or the single one with a number, over a column that has a label; its time goes with it.
  function lines(group, over, single) {
    const { t, along, label } = over, shown = (i) => single === null || i === single;
    const [context, width, height] = sized(canvas);
    frame = null;
    if (!canvas.width || !canvas.height) return; // in a frame that is hidden: the page draws it when it has a size
    context.clearRect(0, 0, width, height);
    let low = Infinity, high = -Infinity;
    for (const column of group.columns.filter((_, i) => shown(i))) for (const x of column) {
      if (Number.isFinite(x)) {
        low = Math.min(low, x);
        high = Math.max(high, x);
      }
    }
    if (!(high >= low)) [low, high] = [0, 1];
    if (high - low < 1e-12 * Math.max(Math.abs(high), 1e-300)) [low, high] = [low - 0.5 * (Math.abs(low) || 1), high + 0.5 * (Math.abs(high) || 1)];
    context.font = "11px system-ui, sans-serif";
    const marks = ticks(low, high, 5).map((v) => [v, group.log ? `1e${short(v)}` : short(v)]);
    const left = Math.max(58, 22 + Math.max(0, ...marks.map(([, text]) => context.measureText(text).width)));
    const right = 8, top = 10, bottom = 30;
    let [begin, end] = over.ends;
    if (!(end > begin)) [begin, end] = [begin - 0.5, begin + 0.5];
    const x = (value) => left + ((value - begin) / (end - begin)) * (width - left - right);
    const y = (value) => height - bottom - ((value - low) / (high - low)) * (height - top - bottom);
    context.fillStyle = palette.soft;
    context.strokeStyle = palette.line;
    context.lineWidth = 1;
    context.textAlign = "right";
    for (const [v, text] of marks) {
      context.beginPath();
      context.moveTo(left, y(v));
      context.lineTo(width - right, y(v));
      context.stroke();
      context.fillText(text, left - 5, y(v) + 4);
    }
    context.textAlign = "center";
    for (const v of ticks(begin, end, width < 320 ? 4 : 6)) context.fillText(short(v), x(v), height - bottom + 14);
    context.fillText(label, (left + width) / 2, height - 3);
    context.save();
    context.translate(11, (height - bottom + top) / 2);
    context.rotate(-Math.PI / 2);
    const unit = group.unit ? ` [${group.unit}]` : "", room = height - top - bottom;
    let title = group.title;
    while (title.length > 4 && context.measureText(title + unit).width > room) title = `${title.slice(0, -2)}…`;
    context.fillText(title + unit, 0, 0);
    context.restore();
    group.columns.forEach((column, i) => {
      if (!shown(i)) return;
      context.beginPath();
      context.strokeStyle = shade(COLOURS[i % COLOURS.length]);
      context.setLineDash([[], [5, 3], [2, 2]][Math.floor(i / COLOURS.length) % 3]);
      context.lineWidth = 1.4;
      let pen = false;
      for (let k = 0; k < t.length; k++) {
        if (!Number.isFinite(column[k])) pen = false;
        else if (pen) context.lineTo(x(along[k]), y(column[k]));
        else {
          context.moveTo(x(along[k]), y(column[k]));
          pen = true;
        }
      }
      context.stroke();
    });
    context.setLineDash([]);
    picture = document.createElement("canvas");
    Object.assign(picture, { width: canvas.width, height: canvas.height });
    picture.getContext("2d").drawImage(canvas, 0, 0);
    frame = { context, x, top, bottom, height, left, right, width, begin, end, t, along };
    key.textContent = "";
    key.classList.toggle("single", single !== null);
    group.names.forEach((name, i) => {
      const entry = document.createElement("button"), line = document.createElement("i");
      entry.setAttribute("aria-pressed", i === single);
      entry.title = i === single ? "Show all curves" : "Show this curve alone";
      entry.addEventListener("click", () => chosen(i));
      line.style.background = shade(COLOURS[i % COLOURS.length]);
      entry.append(line, name, document.createElement("b"));
      key.append(entry);
    });
  }

  function cursor(at, values, log) {
    if (!frame) return;
    const { context, x, top, bottom, height, width } = frame;
    context.clearRect(0, 0, width, height);
    context.drawImage(picture, 0, 0, width, height);
    context.strokeStyle = palette.ink;
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(x(at), top);
    context.lineTo(x(at), height - bottom);
    context.stroke();
    values.forEach((value, i) => {
      if (key.children[i]) key.children[i].lastChild.textContent = `${log ? local((10 ** value).toExponential(1)) : short(value)}`;
    });
  }

  // The time at a place on the canvas: over another column the one nearest to a time at which the column has that value.
  function timeAt(px, now) {
    if (!frame) return 0;
    const { t, along } = frame, value = frame.begin + ((px - frame.left) / (frame.width - frame.left - frame.right)) * (frame.end - frame.begin);
    if (along === t) return value;
    const room = 0.01 * (frame.end - frame.begin), nearest = Math.min(...along.map((x) => Math.abs(x - value)).filter(Number.isFinite));
    return Array.from(t).filter((_, k) => Math.abs(along[k] - value) <= nearest + room)
      .reduce((a, b) => (Math.abs(b - now) < Math.abs(a - now) ? b : a), Infinity);
  }

  return { lines, cursor, timeAt };
}
