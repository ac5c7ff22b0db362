// The scene in space by WebGL: solids with light and shade, lines some pixels wide, each hidden by what stands before it.
// All marks are triangles and strokes in a few buffers; where their bodies are stands in a texture, three texels each.

const COMMON = `#version 300 es
precision highp float;
uniform highp sampler2D poses;
uniform mat3 eye;
uniform vec4 camera; // what is in the middle, in the eye's frame [m], and pixels a metre
uniform vec4 screen; // width, height, pixels of the device a pixel, depth of the picture [m]
vec3 placed(vec4 p, float part) {
  ivec2 at = ivec2(3 * (int(part) >> 10), int(part) & 1023);
  return vec3(dot(texelFetch(poses, at, 0), p), dot(texelFetch(poses, at + ivec2(1, 0), 0), p), dot(texelFetch(poses, at + ivec2(2, 0), 0), p));
}
vec4 projected(vec3 s) {
  s -= camera.xyz;
  return vec4(2.0 * camera.w * s.xy / screen.xy, -s.z / screen.w, 1.0);
}
uniform vec3 paper, ink; // of the page
uniform float night;
vec3 faint(vec3 colour, float strength) { return mix(paper, colour, strength); }
// On dark paper greys change places with each other, and hues are a little lighter, areas a little darker.
vec3 lit(vec3 c, float area) {
  float high = max(max(c.r, c.g), c.b), low = min(min(c.r, c.g), c.b);
  if (night < 0.5) return c;
  if (high - low < 0.125) return mix(ink, paper, 0.5 * (high + low));
  return area > 0.5 ? mix(paper, c, 0.75) : mix(c, vec3(1.0), 0.15);
}
`;
const FACES = `${COMMON}
in vec3 at, normal;
in vec4 fill, edge;
in float part;
uniform float strength, hull; // of the colours; whether outlines are drawn
out vec4 colour;
void main() {
  vec3 n = eye * normalize(placed(vec4(normal, 0.0), part));
  gl_Position = projected(eye * placed(vec4(at, 1.0), part));
  if (hull > 0.0) {
    gl_Position.xy += 8.0 * edge.a * screen.z * n.xy / screen.xy;
    colour = vec4(faint(lit(edge.rgb, 0.0), strength), 1.0);
    return;
  }
  if (fill.a < 1.0 && n.z < 0.0) n = -n;
  vec3 light = normalize(vec3(-0.35, 0.6, 0.75));
  float shade = 0.6 + 0.4 * max(dot(n, light), 0.0), gloss = 0.2 * pow(max(reflect(-light, n).z, 0.0), 20.0);
  colour = vec4(faint(min(lit(fill.rgb, 1.0) * shade + gloss, 1.0), fill.a < 1.0 ? 1.0 : strength), fill.a < 1.0 ? fill.a * strength : 1.0);
}`;
const STROKES = `${COMMON}
in vec3 at, to;
in vec4 edge;
in float part, width;
uniform float strength, bias;
out vec4 colour;
void main() {
  int k = gl_VertexID & 3;
  vec4 a = projected(eye * placed(vec4(at, 1.0), part)), b = projected(eye * placed(vec4(to, 1.0), part));
  vec2 way = (b.xy - a.xy) * screen.xy;
  float l = length(way), w = width * screen.z;
  way = l > 1e-6 ? way / l : vec2(1.0, 0.0);
  gl_Position = (k & 2) == 0 ? a : b;
  vec2 side = vec2(-way.y, way.x) * ((k & 1) == 0 ? -1.0 : 1.0) + way * ((k & 2) == 0 ? -0.5 : 0.5);
  gl_Position.xy += w * side / screen.xy;
  gl_Position.z -= bias;
  colour = vec4(faint(lit(edge.rgb, 0.0), strength), 1.0);
}`;
const PIXEL = `#version 300 es
precision mediump float;
in vec4 colour;
out vec4 pixel;
void main() { pixel = colour; }`;

// Corners of the triangles of a polygon that may be no convex one: ears are cut off until nothing is left.
function triangles(points, normal) {
  const skip = normal.map(Math.abs).reduce((best, x, i, all) => (x > all[best] ? i : best), 0);
  const [u, v] = [[1, 2], [2, 0], [0, 1]][skip], sign = normal[skip] < 0 ? -1 : 1;
  const turn = (a, b, c) => sign * ((b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]));
  const left = [...points.keys()], found = [];
  while (left.length > 2) {
    let ear = left.findIndex((_, k) => {
      const [a, b, c] = [-1, 0, 1].map((d) => points[left[(k + d + left.length) % left.length]]);
      return turn(a, b, c) > 0 && left.every((i) => [a, b, c].includes(points[i]) || turn(a, b, points[i]) < 0 || turn(b, c, points[i]) < 0 || turn(c, a, points[i]) < 0);
    });
    if (ear < 0) ear = 0;
    found.push(left[(ear - 1 + left.length) % left.length], left[ear], left[(ear + 1) % left.length]);
    left.splice(ear, 1);
  }
  return found;
}

const minus = (a, b) => a.map((x, i) => x - b[i]);
const plus = (a, b, f = 1) => a.map((x, i) => x + f * b[i]);
const product = (u, v) => [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
const unitOf = (a) => a.map((x) => x / (Math.hypot(...a) || 1));
function frameOf(axis) {
  const k = axis.map(Math.abs).reduce((best, x, i, all) => (x < all[best] ? i : best), 0);
  const first = unitOf(product([0, 1, 2].map((i) => +(i === k)), axis));
  return [first, product(axis, first)];
}

// The triangles and strokes of a scene, those of bodies and forces first, which alone are drawn of a ghost.
function meshes(scene, ground) {
  const lists = () => ({ faces: [], glass: [], strokes: [] }), first = lists(), rest = lists(), stretches = [];
  let into = first;
  // round things have fewer sides where there are many
  const marks = scene.items.reduce((sum, item) => sum + item.marks.length, 0), sides = marks > 300 ? 8 : 16;

  function corner(list, at, normal, part, fill, alpha, ink, width) {
    list.push([...at, ...normal, part], [...fill, Math.round(255 * alpha), ...ink, Math.round((255 * width) / 4)]);
  }
  function stroke(part, a, b, look) {
    if (look.ink && look.width) into.strokes.push([...a, ...b, part, look.width], channels(look.ink));
  }
  function path(part, points, look, closed) {
    const all = closed ? [...points, points[0]] : points, pieces = look.dashed && all.length === 2 ? 24 : 1;
    for (let i = 0; i + 1 < all.length; i++) for (let k = 0; k < pieces; k++) {
      if (look.dashed && (i + k) % 2) continue;
      const on = (s) => plus(all[i], minus(all[i + 1], all[i]), s / pieces);
      stroke(part, on(k), on(k + 1), look);
    }
  }
  // What is opaque has the tint that it would have on white.
  const tint = (look) => channels(look.plain || "#ffffff").map((x) => Math.round(255 - (255 - x) * (0.35 + 0.65 * look.opacity)));
  const edge = (look) => (look.ink ? channels(look.ink) : [0, 0, 0]);
  function area(part, corners, normals, look, glass) {
    const list = glass ? into.glass : into.faces, fill = glass ? channels(look.plain) : tint(look);
    corners.forEach((p, i) => corner(list, p, normals[i], part, fill, glass ? look.opacity : 1, edge(look), glass ? 0 : look.width));
  }
  function tube(part, a, b, r, look) {
    const axis = unitOf(minus(b, a)), [e, f] = frameOf(axis), n = sides;
    const out = Array.from({ length: n + 1 }, (_, k) => plus(e.map((x) => x * Math.cos((2 * Math.PI * k) / n)), f, Math.sin((2 * Math.PI * k) / n)));
    const back = axis.map((x) => -x);
    for (let k = 0; k < n; k++) {
      const [p, q] = [out[k], out[k + 1]], [ap, aq, bp, bq] = [plus(a, p, r), plus(a, q, r), plus(b, p, r), plus(b, q, r)];
      area(part, [ap, aq, bq, ap, bq, bp], [p, q, q, p, q, p], look);
      area(part, [b, bp, bq, a, aq, ap], [axis, axis, axis, back, back, back], look);
      stroke(part, bp, bq, look);
      stroke(part, ap, aq, look);
    }
  }
  function ball(part, at, r, look, mass) {
    const n = r > 2 * scene.unit ? 2 * sides : sides, m = n / 2;
    const on = (i, k) => {
      const a = (2 * Math.PI * i) / n, b = Math.PI * (k / m - 0.5);
      return [Math.cos(b) * Math.cos(a), Math.cos(b) * Math.sin(a), Math.sin(b)];
    };
    for (let i = 0; i < n; i++) for (let k = 0; k < m; k++) {
      const corners = [on(i, k), on(i + 1, k), on(i + 1, k + 1), on(i, k), on(i + 1, k + 1), on(i, k + 1)];
      const dark = ((4 * i) / n) % 2 < 1 !== k < m / 2; // quarters, as centres of mass are drawn
      const own = mass ? { ...look, plain: dark ? "#20262e" : "#ffffff", opacity: 1, ink: "#20262e", width: 0.8 } : look;
      area(part, corners.map((p) => plus(at, p, r)), corners, own, !mass && own.plain && own.opacity < 0.5);
    }
  }
  const three = (p) => Array.from({ length: p.length / 3 }, (_, i) => p.slice(3 * i, 3 * i + 3));
  const normalOf = (points) => unitOf(points.reduce((sum, p, i) => plus(sum, product(p, points[(i + 1) % points.length])), [0, 0, 0]));
  // What reaches from one body to another lies between 0 and 1 along x, and is as wide as symbols are.
  function stretch(kind, part, look) {
    if (kind === "gap") return path(part, [[0, 0, 0], [1, 0, 0]], look);
    if (kind === "rod") return tube(part, [0, 0, 0], [1, 0, 0], 0.16, { ...look, plain: "#8b94a0", opacity: 1, width: 0.8 });
    if (kind.includes("spring")) {
      const coil = Array.from({ length: 129 }, (_, k) => {
        const s = k / 128, a = 16 * Math.PI * s, r = 0.55 * Math.min(1, 8 * s, 8 * (1 - s));
        return [0.12 + 0.76 * s, r * Math.cos(a), r * Math.sin(a)];
      });
      path(part, [[0, 0, 0], ...coil, [1, 0, 0]], { ...look, width: 1.3 * look.width });
    }
    if (kind.includes("damper") || kind === "actuator") {
      const steel = { ...look, plain: "#dfe4ea", opacity: 1, width: 0.8 };
      tube(part, [0, 0, 0], [0.5, 0, 0], 0.1, steel);
      tube(part, [0.4, 0, 0], [0.82, 0, 0], 0.3, steel);
      tube(part, [0.82, 0, 0], [1, 0, 0], 0.1, steel);
    }
  }

  const looks = scene.looks.map(([ink, fill, width, opacity, dashed]) => ({ ink, plain: fill, width: ink ? 1.25 * width : 0, opacity, dashed }));
  const draws = {
    L: ([, l, body, closed, flat]) => {
      const points = three(flat), look = looks[l], part = body < 0 ? ground : body;
      path(part, points, look, closed);
      if (!closed || !look.plain || points.length < 3) return;
      const normal = normalOf(points.map((p) => minus(p, points[0]))), corners = triangles(points, normal).map((i) => points[i]);
      area(part, corners, corners.map(() => normal), look, look.opacity < 0.5);
      if (look.opacity >= 0.5) area(part, [...corners].reverse(), corners.map(() => normal.map((x) => -x)), look);
    },
    D: ([, l, body, at, r, mass]) => ball(body < 0 ? ground : body, at, r, looks[l], mass),
    T: ([, l, body, a, b, r]) => tube(body < 0 ? ground : body, a, b, r, looks[l]),
    S: ([, l, body, faces]) => {
      const look = looks[l], part = body < 0 ? ground : body;
      for (const face of faces.map(three)) {
        const normal = normalOf(face.map((p) => minus(p, face[0]))), corners = [];
        for (let i = 1; i + 1 < face.length; i++) corners.push(face[0], face[i], face[i + 1]);
        area(part, corners, corners.map(() => normal), look, look.opacity < 0.5);
        if (faces.length <= 12 || face.length > 4) path(part, face, look, true);
      }
    },
    X: ([, l, kind, body, at, other, to]) => {
      stretches.push([body, at, other, to, kind === "gap"]);
      stretch(kind, ground + stretches.length, looks[l]);
    },
  };
  for (const item of scene.items) {
    into = ["body", "force"].includes(item.role) ? first : rest;
    for (const mark of item.marks) draws[mark[0]](mark);
  }
  return { first, rest, stretches };
}

function makeSolid(canvas, scene) {
  const gl = canvas.getContext("webgl2", { antialias: true, alpha: false });
  if (!gl) return null;
  const ground = groundOf(scene), { first, rest, stretches } = meshes(scene, ground);
  const parts = ground + 1 + stretches.length, rows = Math.min(parts, 1024), wide = 3 * Math.ceil(parts / 1024);
  const poses = new Float32Array(4 * rows * wide), traces = new Map();

  function program(vertices) {
    const made = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertices], [gl.FRAGMENT_SHADER, PIXEL]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(made, shader);
    }
    gl.linkProgram(made);
    if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(made) || "no shaders");
    const places = {};
    return { made, at: (name) => (places[name] ??= gl.getUniformLocation(made, name)) };
  }
  const faces = program(FACES), strokes = program(STROKES);

  function buffer(own, values, target = gl.ARRAY_BUFFER) {
    const made = gl.createBuffer();
    gl.bindBuffer(target, made);
    gl.bufferData(target, values, gl.STATIC_DRAW);
    own.push(made);
  }
  function attribute(of, name, size, type, stride, offset) {
    const place = gl.getAttribLocation(of.made, name);
    if (place < 0) return;
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, size, type, type === gl.UNSIGNED_BYTE, stride, offset);
  }
  // Two lists to one buffer: numbers and bytes of each corner in turn.
  function packed(list, floats, bytes, copies) {
    const stride = 4 * floats + bytes, count = list.length / 2, data = new DataView(new ArrayBuffer(stride * copies * count));
    for (let i = 0, o = 0; i < count; i++) for (let k = 0; k < copies; k++, o += stride) {
      list[2 * i].forEach((x, j) => data.setFloat32(o + 4 * j, x, true));
      list[2 * i + 1].forEach((x, j) => data.setUint8(o + 4 * floats + j, x));
    }
    return data;
  }
  function solid(list) {
    const vao = gl.createVertexArray(), own = [];
    gl.bindVertexArray(vao);
    buffer(own, packed(list, 7, 8, 1));
    [["at", 3, 0], ["normal", 3, 12], ["part", 1, 24]].forEach(([name, size, o]) => attribute(faces, name, size, gl.FLOAT, 36, o));
    [["fill", 28], ["edge", 32]].forEach(([name, o]) => attribute(faces, name, 4, gl.UNSIGNED_BYTE, 36, o));
    return { vao, count: list.length / 2, own };
  }
  function lines(list) {
    const vao = gl.createVertexArray(), own = [], count = list.length / 2, order = new Uint32Array(6 * count);
    for (let i = 0; i < count; i++) [0, 1, 2, 2, 1, 3].forEach((k, j) => (order[6 * i + j] = 4 * i + k));
    gl.bindVertexArray(vao);
    buffer(own, packed(list.map((x, i) => (i % 2 ? [...x, 255] : x)), 8, 4, 4));
    [["at", 3, 0], ["to", 3, 12], ["part", 1, 24], ["width", 1, 28]].forEach(([name, size, o]) => attribute(strokes, name, size, gl.FLOAT, 36, o));
    attribute(strokes, "edge", 4, gl.UNSIGNED_BYTE, 36, 32);
    buffer(own, order, gl.ELEMENT_ARRAY_BUFFER);
    return { vao, count, own };
  }
  const all = { faces: solid([...first.faces, ...rest.faces]), glass: solid([...first.glass, ...rest.glass]), strokes: lines([...first.strokes, ...rest.strokes]) };
  const ghostly = { faces: first.faces.length / 2, glass: first.glass.length / 2, strokes: first.strokes.length / 2 };
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, wide, rows, 0, gl.RGBA, gl.FLOAT, null);
  place(Float64Array.from({ length: 12 * ground + 12 }, (_, i) => +(i % 4 === 0 && i % 12 < 9))); // traces are the ground's

  // Rotations and centres of bodies as the page keeps them, twelve numbers each; the ground's come last.
  function place(given) {
    const put = (part, numbers) => poses.set(numbers, 4 * (wide * (part & 1023) + 3 * (part >> 10)));
    const out = (body, p) => [0, 1, 2].map((k) => {
      const o = 12 * (body < 0 ? ground : body);
      return given[o + 3 * k] * p[0] + given[o + 3 * k + 1] * p[1] + given[o + 3 * k + 2] * p[2] + given[o + 9 + k];
    });
    for (let i = 0; i <= ground; i++) {
      const o = 12 * i, g = (k) => given[o + k];
      put(i, [g(0), g(1), g(2), g(9), g(3), g(4), g(5), g(10), g(6), g(7), g(8), g(11)]);
    }
    stretches.forEach(([body, at, other, to], k) => {
      const a = out(body, at), d = minus(out(other, to), a), [e, f] = frameOf(unitOf(d)), u = scene.unit;
      put(ground + 1 + k, [0, 1, 2].flatMap((i) => [d[i], u * e[i], u * f[i], a[i]]));
    });
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, wide, rows, gl.RGBA, gl.FLOAT, poses);
  }

  let seen = null;
  function use(of, strength) {
    gl.useProgram(of.made);
    gl.uniformMatrix3fv(of.at("eye"), true, seen.eye);
    gl.uniform4fv(of.at("camera"), seen.camera);
    gl.uniform4fv(of.at("screen"), seen.screen);
    gl.uniform1f(of.at("strength"), strength);
    gl.uniform3fv(of.at("paper"), channels(palette.paper).map((x) => x / 255));
    gl.uniform3fv(of.at("ink"), channels(palette.ink).map((x) => x / 255));
    gl.uniform1f(of.at("night"), palette.night ? 1 : 0);
  }
  function stroked(mesh, count, strength) {
    use(strokes, strength);
    gl.uniform1f(strokes.at("bias"), (0.12 * scene.unit) / seen.screen[3]);
    gl.bindVertexArray(mesh.vao);
    gl.drawElements(gl.TRIANGLES, 6 * count, gl.UNSIGNED_INT, 0);
  }

  function clear(eye, camera) {
    const w = Math.round(camera.width * camera.ratio), h = Math.round(camera.height * camera.ratio);
    if (canvas.width !== w || canvas.height !== h) Object.assign(canvas, { width: w, height: h });
    seen = { eye: Float32Array.from(eye), camera: [camera.x, camera.y, camera.z, camera.scale * camera.ratio], screen: [w, h, camera.ratio, camera.reach] };
    gl.viewport(0, 0, w, h);
    gl.clearColor(...channels(palette.paper).map((x) => x / 255), 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
  }

  function draw(given, strength, ghost) {
    place(given);
    const count = (name) => (ghost ? ghostly[name] : all[name].count);
    use(faces, strength);
    gl.bindVertexArray(all.faces.vao);
    gl.enable(gl.CULL_FACE);
    for (const hull of [0, 1]) {
      gl.cullFace(hull ? gl.FRONT : gl.BACK);
      gl.uniform1f(faces.at("hull"), hull);
      gl.drawArrays(gl.TRIANGLES, 0, count("faces"));
    }
    gl.disable(gl.CULL_FACE);
    stroked(all.strokes, count("strokes"), strength);
  }

  // What light passes through, after everything else.
  function veil(strength, ghost) {
    use(faces, strength);
    gl.uniform1f(faces.at("hull"), 0);
    gl.bindVertexArray(all.glass.vao);
    gl.enable(gl.BLEND);
    gl.depthMask(false);
    gl.drawArrays(gl.TRIANGLES, 0, ghost ? ghostly.glass : all.glass.count);
    gl.depthMask(true);
    gl.disable(gl.BLEND);
  }

  function trace(points, colour) {
    if (!traces.has(points)) {
      const list = [], own = channels(colour);
      for (let k = 0; k + 1 < points.length; k++) list.push([...points[k], ...points[k + 1], ground, 1.3], own);
      traces.set(points, lines(list));
    }
    const mesh = traces.get(points);
    stroked(mesh, mesh.count, 0.8);
  }
  function forget() {
    for (const mesh of traces.values()) {
      mesh.own.forEach((each) => gl.deleteBuffer(each));
      gl.deleteVertexArray(mesh.vao);
    }
    traces.clear();
  }
  return { clear, draw, veil, trace, forget };
}
