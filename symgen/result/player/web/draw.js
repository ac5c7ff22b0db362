// The scene: marks fixed to bodies, placed for coordinates q, seen from somewhere, drawn on a canvas.

// Numbers of frames: first bodies, then what they carry, the ground's is the last one.
const groundOf = (scene) => scene.frames.length + (scene.carried || []).length;

// In space `solid` draws bodies, symbols and traces, on a canvas beneath; where there is none, this one draws them all.
function makeScene(canvas, scene, solid = null) {
  const { spatial, frames, unit, carried = [] } = scene; // older scenes carry nothing
  const size = spatial ? 3 : 2;
  const context = canvas.getContext("2d");
  let looks = [];
  // Take the page's colours, which may have changed.
  function dress() {
    looks = scene.looks.map(([ink, fill, width, opacity, dashed]) => ({
      ink: ink && shade(ink), width: ink ? 1.25 * width : 0, dashed, fill: fill ? rgba(shade(fill), opacity) : null, plain: fill && shade(fill), opacity,
    }));
  }
  dress();
  const ground = groundOf(scene);
  const poses = new Float64Array(12 * (ground + 1)); // rotation by rows, then the centre; the ground's last
  // `at` is the point in the middle of the picture, x, y and z the same as the eye has it, all in metres.
  const camera = { turn: scene.view[0], tilt: scene.view[1], scale: 1, at: [0, 0, 0], x: 0, y: 0, z: 0, reach: 1, width: 1, height: 1, ratio: 1 };
  const eye = new Float64Array(9);

  function place(q) {
    poses.fill(0);
    for (let i = 0; i <= ground; i++) {
      const o = 12 * i;
      poses[o] = poses[o + 4] = poses[o + 8] = 1;
      if (i >= frames.length) continue;
      const [, first, n, bent] = frames[i];
      if (bent) { bend(o, bent, q); continue; }
      for (let k = 0; k < size; k++) poses[o + 9 + k] = q[first + k];
      if (!spatial && n === 3) {
        const c = Math.cos(q[first + 2]), s = Math.sin(q[first + 2]);
        poses[o] = poses[o + 4] = c;
        poses[o + 1] = -s;
        poses[o + 3] = s;
      } else if (spatial && n === 7) {
        let a = q[first + 3], b = q[first + 4], c = q[first + 5], d = q[first + 6];
        const l = Math.hypot(a, b, c, d) || 1;
        a /= l; b /= l; c /= l; d /= l;
        poses[o] = a * a + b * b - c * c - d * d; poses[o + 1] = 2 * (b * c - a * d); poses[o + 2] = 2 * (b * d + a * c);
        poses[o + 3] = 2 * (b * c + a * d); poses[o + 4] = a * a - b * b + c * c - d * d; poses[o + 5] = 2 * (c * d - a * b);
        poses[o + 6] = 2 * (b * d - a * c); poses[o + 7] = 2 * (c * d + a * b); poses[o + 8] = a * a - b * b - c * c + d * d;
      }
    }
    carry();
  }

  // A frame that modes of a body move, whose own frame comes before it: turned by the Euler parameters (1, p).
  function bend(o, [host, first, at, shape, turn], q) {
    const place = [...at], p = [0, 0, 0], h = 12 * host;
    shape.forEach((u, i) => { for (let k = 0; k < 3; k++) { place[k] += q[first + i] * u[k]; p[k] += 0.5 * q[first + i] * turn[i][k]; } });
    if (!spatial) p[2] = Math.tan(p[2]);
    const l = Math.hypot(1, ...p), [a, b, c, d] = [1 / l, p[0] / l, p[1] / l, p[2] / l];
    const R = [a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c), 2 * (b * c + a * d), a * a - b * b + c * c - d * d,
      2 * (c * d - a * b), 2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d];
    const origin = out(host, place);
    for (let i = 0; i < 3; i++) {
      for (let j = 0; j < 3; j++) poses[o + 3 * i + j] = poses[h + 3 * i] * R[j] + poses[h + 3 * i + 1] * R[3 + j] + poses[h + 3 * i + 2] * R[6 + j];
      poses[o + 9 + i] = origin[i];
    }
  }

  // Where frames are that go with a point of one body and have the directions of another one, or of the ground.
  function carry() {
    carried.forEach(([body, at, turned], k) => {
      const o = 12 * (frames.length + k), from = 12 * (turned < 0 ? ground : turned);
      const origin = out(body, at);
      for (let i = 0; i < 9; i++) poses[o + i] = poses[from + i];
      for (let i = 0; i < 3; i++) poses[o + 9 + i] = origin[i];
    });
  }

  // A point of a body in the ground frame.
  function out(body, at) {
    const o = 12 * (body < 0 ? ground : body), z = spatial ? at[2] : 0;
    return [0, 1, 2].map((k) => poses[o + 3 * k] * at[0] + poses[o + 3 * k + 1] * at[1] + poses[o + 3 * k + 2] * z + poses[o + 9 + k]);
  }

  // A point of a body as the eye has it: to the right, upwards, towards the eye [m].
  const seen = new Float64Array(3);
  function see(body, p, at = 0) {
    const o = 12 * (body < 0 ? ground : body), x = p[at], y = p[at + 1], z = spatial ? p[at + 2] : 0;
    const X = poses[o] * x + poses[o + 1] * y + poses[o + 2] * z + poses[o + 9];
    const Y = poses[o + 3] * x + poses[o + 4] * y + poses[o + 5] * z + poses[o + 10];
    if (!spatial) {
      seen[0] = X; seen[1] = Y; seen[2] = 0;
      return seen;
    }
    const Z = poses[o + 6] * x + poses[o + 7] * y + poses[o + 8] * z + poses[o + 11];
    return look(X, Y, Z);
  }

  function look(X, Y, Z) {
    seen[0] = eye[0] * X + eye[1] * Y + eye[2] * Z;
    seen[1] = eye[3] * X + eye[4] * Y + eye[5] * Z;
    seen[2] = eye[6] * X + eye[7] * Y + eye[8] * Z;
    return seen;
  }

  function aim() {
    turned();
    [camera.x, camera.y, camera.z] = look(...camera.at);
  }

  function turned() {
    if (!spatial) {
      eye.set([1, 0, 0, 0, 1, 0, 0, 0, 1]);
      return;
    }
    const [a, b, c] = scene.up;
    const right = cross([a, b, c], [c, a, b]), depth = cross(right, [a, b, c]);
    const { turn, tilt } = camera;
    const side = right.map((x, i) => Math.cos(turn) * x + Math.sin(turn) * depth[i]);
    const forward = right.map((x, i) => -Math.sin(turn) * x + Math.cos(turn) * depth[i]);
    const upward = [a, b, c].map((x, i) => Math.cos(tilt) * x - Math.sin(tilt) * forward[i]); // what is near sinks
    eye.set([...side, ...upward, ...cross(side, upward)]);
  }

  function cross(u, v) {
    return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
  }

  // Bring another point into the middle: so far to the right and upwards [m].
  function pan(right, up) {
    turned();
    camera.at = camera.at.map((x, i) => x + right * eye[i] + up * eye[3 + i]);
  }

  const px = (x) => (x - camera.x) * camera.scale + camera.width / 2;
  const py = (y) => camera.height / 2 - (y - camera.y) * camera.scale;

  // Where a point of the ground frame is on the picture, and how near to the eye [pixel, pixel, m].
  function onScreen(point) {
    const s = look3(point);
    return [px(s[0]), py(s[1]), spatial ? s[2] : 0];
  }

  // The point of the ground frame at a place of the picture, so near to the eye.
  function fromScreen(x, y, near = 0) {
    const s = [(x - camera.width / 2) / camera.scale + camera.x, (camera.height / 2 - y) / camera.scale + camera.y, near];
    return spatial ? [0, 1, 2].map((k) => eye[k] * s[0] + eye[3 + k] * s[1] + eye[6 + k] * s[2]) : s.slice(0, 2);
  }

  // Coordinates in a body's frame of a point of the ground frame, for coordinates q.
  function into(q, body, point) {
    place(q);
    const o = 12 * body, from = [0, 1, 2].map((k) => (point[k] || 0) - poses[o + 9 + k]);
    return [0, 1, 2].slice(0, size).map((k) => poses[o + k] * from[0] + poses[o + 3 + k] * from[1] + poses[o + 6 + k] * from[2]);
  }

  // -- marks ------------------------------------------------------------------------------------------------------------

  let tint = ""; // of lit items
  function paint(l, closed) {
    if (closed && l.fill) {
      context.fillStyle = l.fill;
      context.fill();
    }
    if (l.width) {
      context.strokeStyle = tint || l.ink;
      context.lineWidth = l.width;
      if (l.dashed) context.setLineDash([5, 3]);
      context.stroke();
      if (l.dashed) context.setLineDash([]);
    }
  }

  function polygon(body, points, closed, l) {
    context.beginPath();
    for (let i = 0; i < points.length; i += size) {
      const s = see(body, points, i);
      if (i) context.lineTo(px(s[0]), py(s[1]));
      else context.moveTo(px(s[0]), py(s[1]));
    }
    if (closed) context.closePath();
    paint(l, closed);
  }

  function circle(x, y, r, l) {
    context.beginPath();
    context.arc(x, y, Math.max(r, 0.5), 0, 2 * Math.PI);
    paint(l, true);
  }

  const draws = {
    L: ([, l, body, closed, points]) => polygon(body, points, closed, looks[l]),
    D: ([, l, body, at, radius, mass]) => {
      const s = see(body, at), x = px(s[0]), y = py(s[1]), r = radius * camera.scale;
      if (!mass) return circle(x, y, r, looks[l]);
      circle(x, y, r, { ink: palette.ink, width: 0.8, fill: palette.paper });
      context.fillStyle = palette.ink;
      for (const start of [-Math.PI / 2, Math.PI / 2]) {
        context.beginPath();
        context.moveTo(x, y);
        context.arc(x, y, r, start, start + Math.PI / 2);
        context.fill();
      }
    },
    T: ([, l, body, from, to, radius]) => {
      let a = Array.from(see(body, from)), b = Array.from(see(body, to));
      if (a[2] > b[2]) [a, b] = [b, a];
      const dx = b[0] - a[0], dy = b[1] - a[1], dz = b[2] - a[2], flat = Math.hypot(dx, dy);
      const squeeze = Math.abs(dz) / (Math.hypot(flat, dz) || 1), turn = Math.atan2(-dy, dx), r = Math.max(radius * camera.scale, 0.6);
      const ax = px(a[0]), ay = py(a[1]), bx = px(b[0]), by = py(b[1]), half = Math.PI / 2;
      context.beginPath();
      context.ellipse(ax, ay, squeeze * r, r, turn, half, 3 * half);
      context.ellipse(bx, by, squeeze * r, r, turn, -half, half);
      context.closePath();
      paint(looks[l], true);
      if (squeeze > 0.05) {
        context.beginPath();
        context.ellipse(bx, by, squeeze * r, r, turn, 0, 2 * Math.PI);
        paint(looks[l], true);
      }
    },
    S: ([, l, body, faces]) => {
      for (const face of faces) {
        const s = [0, 3, 6].map((i) => Array.from(see(body, face, i)));
        const n = cross(s[1].map((x, i) => x - s[0][i]), s[2].map((x, i) => x - s[1][i]));
        if (n[2] <= 0) continue;
        const light = 0.75 + (0.25 * n[1]) / (Math.hypot(...n) || 1), own = looks[l];
        polygon(body, face, true, { ...own, fill: own.plain ? rgba(own.plain, own.opacity * light) : null });
      }
    },
    X: ([, l, kind, body, at, other, to]) => {
      const a = Array.from(see(body, at)), b = see(other, to);
      stretch(kind, px(a[0]), py(a[1]), px(b[0]), py(b[1]), looks[l]);
    },
  };

  function stretch(kind, ax, ay, bx, by, l) {
    const dx = bx - ax, dy = by - ay, length = Math.hypot(dx, dy) || 1e-9, u = unit * camera.scale;
    const path = (points, closed, own = l) => {
      context.beginPath();
      for (const [s, n] of points) context.lineTo(ax + (s * dx) + (n * u * dy) / length, ay + s * dy - (n * u * dx) / length);
      if (closed) context.closePath();
      paint(own, closed);
    };
    if (kind === "rod" || kind === "gap") return path([[0, 0], [1, 0]]);
    const both = kind === "spring-damper", n = both ? 0.75 : 0, start = 0.18, end = 0.82;
    if (kind.includes("spring")) {
      const zigzag = Array.from({ length: 12 }, (_, k) => [start + ((k + 0.5) * (end - start)) / 12, n + (k % 2 ? 0.55 : -0.55)]);
      path([[0, 0], [start, 0], [start, n], ...zigzag, [end, n], [end, 0], [1, 0]]);
    }
    if (kind.includes("damper") || kind === "actuator") {
      const m = -n, box = kind === "actuator";
      path([[both ? start : 0, 0], [start, m], [0.52, m]]);
      path([[0.4, m - 0.45], [0.62, m - 0.45], [0.62, m + 0.45], [0.4, m + 0.45]], box, box ? { ...l, fill: shade("#dfe4ea") } : l);
      if (!box) path([[0.52, m - 0.36], [0.52, m + 0.36]]);
      path([[0.62, m], [end, m], [both ? end : 1, 0]]);
    }
  }

  // -- frames -----------------------------------------------------------------------------------------------------------

  function depth(item) {
    let sum = 0, count = 0;
    for (const mark of item.marks) {
      const [body, p] = mark[0] === "X" ? [mark[3], mark[4]] : [mark[2], mark[0] === "S" ? mark[3][0] : mark[0] === "L" ? mark[4] : mark[3]];
      const o = 12 * (body < 0 ? ground : body);
      sum += mark[0] === "L" || mark[0] === "S" ? look(poses[o + 9], poses[o + 10], poses[o + 11])[2] : see(body, p)[2];
      count++;
    }
    return count ? sum / count : 0;
  }

  function clear() {
    const ratio = window.devicePixelRatio || 1, box = canvas.getBoundingClientRect();
    if (canvas.width !== Math.round(box.width * ratio) || canvas.height !== Math.round(box.height * ratio)) {
      canvas.width = Math.round(box.width * ratio);
      canvas.height = Math.round(box.height * ratio);
    }
    Object.assign(camera, { width: box.width, height: box.height, ratio });
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.lineJoin = context.lineCap = "round";
    context.fillStyle = palette.paper;
    context[solid ? "clearRect" : "fillRect"](0, 0, box.width, box.height);
    aim();
    if (solid) solid.clear(eye, camera);
  }

  // `lit` tells which items are drawn in another colour.
  function draw(q, strength = 1, roles = null, lit = null) {
    place(q);
    if (solid) {
      solid.draw(poses, strength, roles);
      solid.veil(strength, roles);
      return;
    }
    context.globalAlpha = strength;
    let items = roles ? scene.items.filter((item) => roles.includes(item.role)) : scene.items;
    if (spatial) items = items.map((item) => [depth(item), item]).sort((a, b) => a[0] - b[0]).map((pair) => pair[1]);
    for (const item of items) {
      const on = lit && lit(item) ? palette.push : "";
      for (const mark of item.marks) {
        tint = mark[0] === "L" && mark[6] ? "" : on; // of an outline the piece in touch is lit
        draws[mark[0]](mark);
      }
    }
    tint = palette.push;
    for (const item of items) if (item.sides && lit && lit(item)) {
      for (const { body, points } of touchedPieces(item.sides, out, 0.02 * unit)) polygon(body, points, false, { width: 3.2 });
    }
    tint = "";
    context.globalAlpha = 1;
  }

  function names() {
    context.font = "12px system-ui, sans-serif";
    context.textAlign = "center";
    context.lineWidth = 3;
    for (const item of scene.items) {
      if (!item.label) continue;
      const s = see(item.label[0], item.label[1]);
      context.strokeStyle = palette.paper;
      context.strokeText(item.name, px(s[0]), py(s[1]) - 9);
      context.fillStyle = palette.ink;
      context.fillText(item.name, px(s[0]), py(s[1]) - 9);
    }
  }

  // An arrow that begins or ends at a point of a body, along a vector of the ground frame [pixel a unit].
  function arrow(body, at, vector, scale, colour) {
    const s = see(body, at), x = px(s[0]), y = py(s[1]);
    const d = spatial ? look(...vector) : vector;
    const dx = d[0] * scale, dy = -d[1] * scale, l = Math.hypot(dx, dy);
    if (!(l > 1.5)) return;
    const ux = dx / l, uy = dy / l, head = Math.min(9, 0.5 * l);
    context.strokeStyle = context.fillStyle = colour;
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(x, y);
    context.lineTo(x + dx - ux * head, y + dy - uy * head);
    context.stroke();
    context.beginPath();
    context.moveTo(x + dx, y + dy);
    context.lineTo(x + dx - ux * head - uy * head * 0.4, y + dy - uy * head + ux * head * 0.4);
    context.lineTo(x + dx - ux * head + uy * head * 0.4, y + dy - uy * head - ux * head * 0.4);
    context.fill();
  }

  function trace(points, colour) {
    if (solid) {
      solid.trace(points, colour);
      return;
    }
    context.beginPath();
    points.forEach((p, k) => {
      const s = look3(p);
      if (k) context.lineTo(px(s[0]), py(s[1]));
      else context.moveTo(px(s[0]), py(s[1]));
    });
    context.strokeStyle = shade(colour);
    context.lineWidth = 1.2;
    context.stroke();
  }

  const look3 = (p) => (spatial ? look(p[0], p[1], p[2]) : p);

  function where(q, body, at) {
    place(q);
    return out(body, at);
  }

  // Between two points that ought to be one: a ring, and the gap magnified.
  function gap(q, ends, factor, colour) {
    place(q);
    const a = Array.from(see(ends[0][0], ends[0][1])), b = see(ends[1][0], ends[1][1]);
    const x = px(a[0]), y = py(a[1]);
    circle(x, y, Math.max(7, 0.8 * unit * camera.scale), { ink: colour, width: 2, fill: null });
    context.strokeStyle = colour;
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(x, y);
    context.lineTo(x + (b[0] - a[0]) * factor * camera.scale, y - (b[1] - a[1]) * factor * camera.scale);
    context.stroke();
  }

  function fit(rows) {
    camera.at = [0, 0, 0];
    clear();
    const low = [Infinity, Infinity, Infinity], high = low.map((x) => -x);
    const every = Math.max(1, Math.floor(rows.length / 40));
    const take = (s, r = 0) => {
      for (let k = 0; k < 3; k++) {
        low[k] = Math.min(low[k], s[k] - r);
        high[k] = Math.max(high[k], s[k] + r);
      }
    };
    for (let r = 0; r < rows.length; r += every) {
      place(rows[r]);
      for (const item of scene.items) for (const mark of item.marks) {
        if (mark[0] === "L" && mark[5]) continue; // a rail is as long as the motion; what slides on it is there
        if (mark[0] === "L") for (let i = 0; i < mark[4].length; i += size) take(see(mark[2], mark[4], i));
        else if (mark[0] === "S") for (const face of mark[3]) for (let i = 0; i < face.length; i += 3) take(see(mark[2], face, i));
        else if (mark[0] === "D") take(see(mark[2], mark[3]), mark[4]);
        else if (mark[0] === "T") { take(see(mark[2], mark[3]), mark[5]); take(see(mark[2], mark[4]), mark[5]); }
        else { take(see(mark[3], mark[4])); take(see(mark[5], mark[6])); }
      }
    }
    if (!(high[0] >= low[0])) for (let k = 0; k < 3; k++) [low[k], high[k]] = [-1, 1];
    const [wide, tall, deep] = high.map((x, k) => Math.max(x - low[k], 1e-9));
    camera.scale = Math.min((camera.width - 40) / wide, (camera.height - 40) / tall);
    const middle = low.map((x, k) => 0.5 * (x + high[k]));
    camera.at = [0, 1, 2].map((i) => middle[0] * eye[i] + middle[1] * eye[3 + i] + middle[2] * eye[6 + i]);
    camera.reach = 8 * Math.hypot(wide, tall, deep); // before and behind the middle; live motions may reach farther
    aim();
  }

  const forget = () => solid && solid.forget();
  return { camera, scene, spatial, dress, clear, draw, names, arrow, trace, forget, pan, where, gap, fit, see, place, out, onScreen, fromScreen, into };
}
