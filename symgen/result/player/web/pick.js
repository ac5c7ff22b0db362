// What lies at a place of the picture.

const NEAR = 14; // pixels

// The item of some roles whose marks lie nearest to a place, how near to the eye it is there, or null; of others at the
// same place, joints lie on bodies, and in space what is nearer to the eye on what is farther.
function itemAt(x, y, roles) {
  const q = between(motion, time);
  if (!q) return null;
  let best = { far: NEAR * NEAR, near: -Infinity, item: null };
  view.place(q);
  for (const item of data.scene.items) {
    if (!roles.includes(item.role)) continue;
    for (const mark of item.marks) for (const [points, closed, radius] of outlinesOf(mark)) {
      let { far, near } = distanceTo([x, y], points, closed);
      far = closed && isInside([x, y], points) ? 0.5 * NEAR * NEAR : Math.max(0, Math.sqrt(far) - radius * view.camera.scale) ** 2;
      if (item.role !== "body") far *= 0.64;
      if (far < NEAR * NEAR && (view.spatial && best.item ? near > best.near : far < best.far)) best = { far, near, item };
    }
  }
  return best.item && best;
}

// Outlines of a mark on the picture: points, whether they are closed, and how thick the line is [m].
function outlinesOf(mark) {
  const [kind, , body] = mark, put = (own, at) => view.onScreen(view.out(own, at)), size = view.spatial ? 3 : 2;
  const points = (list) => Array.from({ length: list.length / size }, (_, i) => put(body, list.slice(size * i, size * i + size)));
  if (kind === "L") return [[points(mark[4]), Boolean(mark[3]), 0]];
  if (kind === "D") return [[[put(body, mark[3]), put(body, mark[3])], false, mark[4]]];
  if (kind === "T") return [[[put(body, mark[3]), put(body, mark[4])], false, mark[5]]];
  if (kind === "S") return mark[3].map((face) => [points(face), true, 0]);
  return [[[put(mark[3], mark[4]), put(mark[5], mark[6])], false, 0]];
}

// How far a place is from an outline, squared, and how near to the eye the outline is there.
function distanceTo(place, points, closed) {
  let best = { far: Infinity, near: -Infinity };
  for (let i = 0; i + (closed ? 0 : 1) < points.length; i++) {
    const a = points[i], b = points[(i + 1) % points.length], dx = b[0] - a[0], dy = b[1] - a[1];
    const s = Math.min(Math.max(((place[0] - a[0]) * dx + (place[1] - a[1]) * dy) / (dx * dx + dy * dy || 1), 0), 1);
    const far = (a[0] + s * dx - place[0]) ** 2 + (a[1] + s * dy - place[1]) ** 2;
    if (far < best.far) best = { far, near: a[2] + s * (b[2] - a[2]) };
  }
  return best;
}

function isInside([x, y], points) {
  let inside = false;
  points.forEach(([ax, ay], i) => {
    const [bx, by] = points[(i + 1) % points.length];
    if (ay > y !== by > y && x < ax + ((y - ay) / (by - ay)) * (bx - ax)) inside = !inside;
  });
  return inside;
}

// An item is drawn again, with a glow.
function glow(item, q) {
  const context = $("view").getContext("2d");
  view.place(q);
  context.save();
  Object.assign(context, { strokeStyle: palette.accent, globalAlpha: 0.35, lineWidth: 9, lineCap: "round", lineJoin: "round" });
  for (const mark of item.marks) for (const [points, closed] of outlinesOf(mark)) {
    context.beginPath();
    points.forEach((p, i) => (i ? context.lineTo(p[0], p[1]) : context.moveTo(p[0], p[1])));
    if (closed) context.closePath();
    context.stroke();
  }
  context.restore();
}
