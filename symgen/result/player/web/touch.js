// -- contacts of outlines ---------------------------------------------------------------------------------------------------

// The pieces of outlines at which the surfaces of a contact are nearest to each other, of the frame that is drawn.
function touchedPieces(sides, out, near) {
  const placed = sides.map((side) => side.map(([body, points, radius, whole]) => {
    const places = [];
    for (let i = 0; i < points.length; i += 2) places.push(out(body, [points[i], points[i + 1]]));
    return { body, points, radius, whole, places, gap: Infinity };
  }));
  for (const a of placed[0]) for (const b of placed[1]) {
    const gap = Math.abs(gapOfLines(a.places, b.places) - Math.abs(a.radius + b.radius)); // a hole has a radius below 0
    a.gap = Math.min(a.gap, gap);
    b.gap = Math.min(b.gap, gap);
  }
  const all = placed.flat(), least = Math.min(...all.map((piece) => piece.gap));
  return all.filter((piece) => !piece.whole && piece.gap <= least + near);
}

// The distance of two lines through points that do not cross.
function gapOfLines(a, b) {
  let least = Infinity;
  for (const [some, line] of [[a, b], [b, a]]) for (const p of some) {
    if (line.length === 1) least = Math.min(least, Math.hypot(p[0] - line[0][0], p[1] - line[0][1]));
    for (let i = 1; i < line.length; i++) {
      const [x, y] = line[i - 1], dx = line[i][0] - x, dy = line[i][1] - y;
      const along = ((p[0] - x) * dx + (p[1] - y) * dy) / (dx * dx + dy * dy || 1), s = Math.min(Math.max(along, 0), 1);
      least = Math.min(least, Math.hypot(p[0] - x - s * dx, p[1] - y - s * dy));
    }
  }
  return least;
}
