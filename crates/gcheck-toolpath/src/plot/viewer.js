// A toolpath in three dimensions, in WebGL 2.
//
// Knows: points, tools, kinds of moves, a camera, a canvas. Must not know: the page around it, program text, where data comes
// from. It loads nothing and asks nobody; the page of `gcheck plot` and the preview of editors both use it.
//
//   const viewer = createViewer(canvas, data, callbacks);
//
// The canvas fills a positioned element; what is written on the path stands on a canvas that the viewer puts behind it.
//
// `data` (`Drawing::to_json` in plot/data.rs writes it), version 1; lengths are millimetres whatever `units` says:
//
//   version    1
//   units      "mm" or "inch": how lengths are shown
//   lathe      true: the first view is ZX, with X up
//   diameter   true: X is shown doubled
//   tools      [{ number: 3 or null, name: "…" or null, color: "#rrggbb" }]
//   files      ["part.nc", …]
//   count      how many points there are; the arrays have one entry a point, in the order of the run:
//   points     Float32: x, y, z
//   seconds    Float32: time since the start when the point is reached
//   lines      Uint32: line, from 1, of the block that moves to the point
//   kinds      Uint8: how the point is reached; see KIND
//   toolOf     Uint8: index in `tools`
//   fileOf     Uint8: index in `files`; null when there is one file
//   thinned    true: a piece may stand for several moves, so that it covers the lines behind its start up to its end
//   alarms     [{ file, line, at: [x, y, z] or null }]: blocks at which the control would stop, and where the tool was then; may
//              be missing
//   cut, all   [[x, y, z], [x, y, z]]: smallest and largest of the moves that cut, and of all moves; null when there are none
//
// An array is base64 of little-endian bytes, or a typed array. What ends at point i is piece i.
//
// `callbacks`, each optional:
//
//   onPick(place)       a piece was clicked; null: beside all of them
//   onProgress(place)   the tool has come to a place of the run, by play or by `goTo`
//   onPlay(isPlaying)   play began or ended
//
// A place is { piece, file, line, kind, tool, point: [x, y, z], seconds }.
//
// The viewer: `setView(name)` of VIEWS, `fit()`, `select(file, first, last)` or `select(null)`, `setMarks([{ file, line,
// severity }])`, `goTo(piece)`, `goToTime(seconds)`, `step(by)`, `stepBlock(by)`,
// `stepTool(by)`, `play()`, `pause()`, `setSpeed(factor)`, `showRapids(yes)`,
// `showTool(index, yes)`, `setTheme(THEMES.dark)`, `setData(data)`, `draw()`, `destroy()`, and to read: `place()`, `pieces()`,
// `duration()`, `isPlaying()`. Drag turns, with Shift or another button it shifts; the wheel zooms where it points; on the
// focused canvas arrows turn, with Shift they shift, + and - zoom, F fits, 1 to 4 choose a view.

/** How a point is reached. At START a new path begins: nothing leads to it. */
export const KIND = { START: 0, RAPID: 1, FEED: 2, ARC: 3, PROBE: 4, SPINDLE: 5 };

// Rows of the camera: what is to the right on the screen, up, and toward the eye.
const S2 = Math.SQRT1_2, S3 = 1 / Math.sqrt(3), S6 = 1 / Math.sqrt(6);
/** Views by name. */
export const VIEWS = {
  top: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
  front: [[1, 0, 0], [0, 0, 1], [0, -1, 0]],
  side: [[0, 1, 0], [0, 0, 1], [1, 0, 0]],
  iso: [[S2, S2, 0], [-S6, S6, 2 * S6], [S3, -S3, S3]],
  lathe: [[0, 0, 1], [1, 0, 0], [0, 1, 0]],
};

/** Colours, as CSS writes them. */
export const THEMES = {
  dark: { background: "#15181c", text: "#d6dbe1", muted: "#5d6773", accent: "#ffffff", error: "#ff6b6b", warning: "#f5b041", info: "#5dade2" },
  light: { background: "#fbfbfa", text: "#23282e", muted: "#9aa3ad", accent: "#000000", error: "#c62828", warning: "#b26a00", info: "#1565c0" },
};

// Points stand in a texture, this many a row: a piece is two triangles that fetch their ends. (Instances of so few corners
// are slow without a graphics card.)
const ROW = 2048;

const VERTEX = `#version 300 es
precision highp float; precision highp int;
uniform highp sampler2D uPoints, uTools; uniform highp usampler2D uChosen;
uniform mat3 uTurn; uniform vec3 uTarget, uTip; uniform vec2 uHalf; uniform float uScale, uDepth, uWidth;
uniform int uEvery, uLast, uPass; uniform bool uRapids;
flat out vec4 vColor; out float vAlong; flat out float vDash;
ivec2 place(int i) { return ivec2(i % ${ROW}, i / ${ROW}); }
void main() {
  int piece = gl_VertexID / 6 * uEvery + 1, corner = gl_VertexID % 6;
  corner = corner > 2 ? corner - 2 : corner;
  vec4 from = texelFetch(uPoints, place(piece - 1), 0), to = texelFetch(uPoints, place(piece), 0);
  int how = int(to.w);
  vec4 tool = texelFetch(uTools, ivec2(how >> 3, 0), 0);
  bool rapid = (how & 7) == 1;
  bool hidden = (how & 7) == 0 || tool.a < 0.5 || (rapid && !uRapids) || (uPass == 2 && texelFetch(uChosen, place(piece), 0).r == 0u);
  vec3 a = uTurn * (from.xyz - uTarget), b = uTurn * ((piece == uLast ? uTip : to.xyz) - uTarget);
  vec2 p = a.xy * uScale, q = b.xy * uScale, d = q - p;
  float size = length(d);
  vec2 dir = size > 1e-4 ? d / size : vec2(1.0, 0.0);
  float at = float(corner >> 1), side = float(corner & 1) * 2.0 - 1.0;
  vec2 spot = mix(p, q, at) + (vec2(-dir.y, dir.x) * side + dir * (at * 2.0 - 1.0)) * uWidth * 0.5;
  float z = clamp(mix(a.z, b.z, at) / uDepth, -0.99, 0.99);
  gl_Position = hidden ? vec4(2.0, 2.0, 2.0, 1.0) : vec4(spot / uHalf, -z, 1.0);
  vAlong = at * size;
  vDash = rapid && uPass != 1 ? 1.0 : 0.0;
  // Steep pieces are darker, and near ones stronger than far ones: a surface shows its shape.
  vec3 way = to.xyz - from.xyz;
  float shade = 1.0 - 0.5 * min(abs(way.z) / max(length(way), 1e-6), 0.6) + 0.14 * clamp(mix(a.z, b.z, at) / uDepth, -1.0, 1.0);
  vColor = uPass == 1 ? vec4(piece & 255, (piece >> 8) & 255, (piece >> 16) & 255, piece >> 24) / 255.0 : vec4(tool.rgb * shade, 1.0);
}`;

const FRAGMENT = `#version 300 es
precision highp float; precision highp int;
flat in vec4 vColor; in float vAlong; flat in float vDash; out vec4 color;
uniform vec4 uOver; uniform vec3 uBack; uniform float uDash; uniform int uPass;
void main() {
  if (uPass == 1) { color = vColor; return; }
  if (vDash > 0.5 && fract(vAlong / uDash) > 0.55) discard;
  vec3 own = vDash > 0.5 ? mix(vColor.rgb, uBack, 0.35) : vColor.rgb;
  color = vec4(mix(own, uOver.rgb, uOver.a), 1.0);
}`;

function bytesOf(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; i++) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

function array(Type, value) {
  if (value == null || typeof value !== "string") return value ?? null;
  return new Type(bytesOf(value).buffer);
}

/** The arrays of `data` as typed arrays; everything else as it is. */
export function decode(data) {
  if (data.version !== 1) throw new Error(`toolpath data of version ${data.version}; this viewer reads version 1`);
  return {
    ...data,
    points: array(Float32Array, data.points),
    seconds: array(Float32Array, data.seconds),
    lines: array(Uint32Array, data.lines),
    kinds: array(Uint8Array, data.kinds),
    toolOf: array(Uint8Array, data.toolOf),
    fileOf: array(Uint8Array, data.fileOf),
  };
}

function rgb(css) {
  const n = parseInt(css.slice(1), 16);
  return [(n >> 16 & 255) / 255, (n >> 8 & 255) / 255, (n & 255) / 255];
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => { const size = Math.hypot(...a) || 1; return a.map((v) => v / size); };

/** `v` turned about the unit vector `axis`. */
function turned(v, axis, angle) {
  const c = Math.cos(angle), s = Math.sin(angle), w = cross(axis, v), k = dot(axis, v) * (1 - c);
  return v.map((x, i) => x * c + w[i] * s + axis[i] * k);
}

/** A length in the units shown. */
export function lengthText(mm, units) {
  return units === "inch" ? (mm / 25.4).toFixed(4) : mm.toFixed(3);
}

/** Draws `data` on `canvas`; throws where the browser has no WebGL 2. */
export function createViewer(canvas, data, callbacks = {}) {
  const overlay = document.createElement("canvas");
  overlay.className = "toolpath-overlay";
  overlay.style.cssText = "position:absolute;inset:0;width:100%;height:100%;pointer-events:none";
  canvas.after(overlay);
  const paper = overlay.getContext("2d");
  const gl = canvas.getContext("webgl2", { antialias: true, alpha: false });
  if (!gl) { overlay.remove(); throw new Error("this browser has no WebGL 2"); }

  let d, chosen, marks = [], theme = THEMES.dark;
  let rows = VIEWS.iso, target = [0, 0, 0], scale = 1;
  let hiddenTools = new Set(), rapids = true;
  // Where the tool is: on its way to the point `at`, at the time `clock`.
  let at = 0, clock = 0, tip = [0, 0, 0];
  let playing = false, speed = 10, frame = 0, playFrame = 0, playedAt = 0, slow = 0, moving = 0;
  let gpu = null;

  const last = () => d.count - 1;
  const pointOf = (i) => [d.points[3 * i], d.points[3 * i + 1], d.points[3 * i + 2]];
  const size = () => [Math.max(canvas.clientWidth, 1), Math.max(canvas.clientHeight, 1)];

  function program() {
    const made = gl.createProgram();
    for (const [type, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(made, shader);
    }
    gl.linkProgram(made);
    if (!gl.getProgramParameter(made, gl.LINK_STATUS) && !gl.isContextLost()) {
      throw new Error(`the graphics driver refuses the shaders: ${gl.getProgramInfoLog(made)}`);
    }
    return made;
  }

  function upload() {
    const made = program();
    const uniforms = {};
    for (let i = 0; i < gl.getProgramParameter(made, gl.ACTIVE_UNIFORMS); i++) {
      const { name } = gl.getActiveUniform(made, i);
      uniforms[name] = gl.getUniformLocation(made, name);
    }
    gpu = { program: made, uniforms, points: gl.createTexture(), tools: gl.createTexture(), chosen: gl.createTexture(), picking: null };
    const rowsOfPoints = Math.max(Math.ceil(d.count / ROW), 1), texels = new Float32Array(rowsOfPoints * ROW * 4);
    for (let i = 0; i < d.count; i++) {
      texels.set([d.points[3 * i], d.points[3 * i + 1], d.points[3 * i + 2], d.kinds[i] + 8 * d.toolOf[i]], 4 * i);
    }
    fill(gpu.points, gl.RGBA32F, ROW, rowsOfPoints, gl.RGBA, gl.FLOAT, texels);
    uploadChosen();
    uploadTools();
  }

  function fill(texture, inside, width, height, format, type, content) {
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, inside, width, height, 0, format, type, content);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
  }

  function uploadChosen() {
    fill(gpu.chosen, gl.R8UI, ROW, chosen.length / ROW, gl.RED_INTEGER, gl.UNSIGNED_BYTE, chosen);
  }

  function uploadTools() {
    const colors = new Uint8Array(256 * 4);
    d.tools.slice(0, 256).forEach((tool, i) => {
      colors.set([...rgb(tool.color).map((part) => Math.round(part * 255)), hiddenTools.has(i) ? 0 : 255], 4 * i);
    });
    fill(gpu.tools, gl.RGBA8, 256, 1, gl.RGBA, gl.UNSIGNED_BYTE, colors);
  }

  /** Draws the pieces from `first` to `end`, every so many of them. */
  function pieces(first, end, every = 1) {
    const count = Math.floor((end - first) / every) + 1, skipped = Math.floor((first - 1) / every);
    gl.uniform1i(gpu.uniforms.uEvery, every);
    if (count > 0) gl.drawArrays(gl.TRIANGLES, 6 * skipped, 6 * count);
  }

  function prepare(width, height, pass, lineWidth) {
    const u = gpu.uniforms, ratio = canvas.width / width;
    gl.useProgram(gpu.program);
    [[u.uPoints, gpu.points], [u.uTools, gpu.tools], [u.uChosen, gpu.chosen]].forEach(([place, texture], i) => {
      gl.activeTexture(gl.TEXTURE0 + i);
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.uniform1i(place, i);
    });
    gl.activeTexture(gl.TEXTURE7);
    // Columns of the matrix are what WebGL reads first.
    gl.uniformMatrix3fv(u.uTurn, false, [0, 1, 2].flatMap((i) => rows.map((row) => row[i])));
    gl.uniform3fv(u.uTarget, target);
    gl.uniform3fv(u.uTip, tip);
    gl.uniform2f(u.uHalf, width / 2, height / 2);
    gl.uniform1f(u.uScale, scale);
    gl.uniform1f(u.uDepth, depth());
    gl.uniform1f(u.uWidth, Math.max(lineWidth, 1 / ratio));
    gl.uniform1f(u.uDash, 9);
    gl.uniform1i(u.uRapids, rapids ? 1 : 0);
    gl.uniform1i(u.uPass, pass);
    gl.uniform1i(u.uLast, -1);
    gl.uniform3fv(u.uBack, rgb(theme.background));
    gl.uniform4f(u.uOver, 0, 0, 0, 0);
  }

  function depth() {
    const box = d.all ?? [[0, 0, 0], [1, 1, 1]];
    let far = 1;
    for (let i = 0; i < 8; i++) far = Math.max(far, Math.abs(dot(rows[2], cornerOf(box, i).map((v, k) => v - target[k]))));
    return far * 1.1;
  }

  const cornerOf = (box, i) => [box[i & 1][0], box[i >> 1 & 1][1], box[i >> 2 & 1][2]];

  function paint() {
    frame = 0;
    if (!gpu || gl.isContextLost()) return;
    const [width, height] = size(), ratio = window.devicePixelRatio || 1;
    for (const one of [canvas, overlay]) {
      const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
      if (one.width !== w || one.height !== h) { one.width = w; one.height = h; }
    }
    const begin = performance.now();
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(...rgb(theme.background), 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    // Where a picture takes long, every so many pieces are drawn while the view moves, and all of them when it rests.
    const every = moving && slow > 60 ? Math.min(20, Math.ceil(slow / 30)) : 1;
    if (d.count > 1) {
      prepare(width, height, 0, 1.5);
      // What is still to come lies behind all that was done.
      if (at < last()) {
        gl.uniform4f(gpu.uniforms.uOver, ...rgb(theme.background), 0.78);
        gl.depthMask(false);
        pieces(Math.max(at, 1), last(), every);
        gl.depthMask(true);
        gl.uniform4f(gpu.uniforms.uOver, 0, 0, 0, 0);
        if (every === 1) gl.uniform1i(gpu.uniforms.uLast, at);
      }
      pieces(1, Math.min(at, last()), every);
      if (selected) {
        gl.disable(gl.DEPTH_TEST);
        prepare(width, height, 2, 4);
        gl.uniform4f(gpu.uniforms.uOver, ...rgb(theme.accent), 1);
        pieces(1, last());
      }
    }
    if (every === 1 && moving && d.count > 100000) {
      // Reading a pixel waits for the picture.
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
      slow = performance.now() - begin;
    }
    annotate(width, height, ratio);
  }

  const onScreen = (p) => {
    const v = p.map((x, i) => x - target[i]), [width, height] = size();
    return [width / 2 + dot(rows[0], v) * scale, height / 2 - dot(rows[1], v) * scale];
  };

  function annotate(width, height, ratio) {
    paper.setTransform(ratio, 0, 0, ratio, 0, 0);
    paper.clearRect(0, 0, width, height);
    paper.font = "12px system-ui, sans-serif";
    paper.lineWidth = 1;
    const line = (a, b, color) => {
      paper.strokeStyle = color;
      paper.beginPath(); paper.moveTo(...a); paper.lineTo(...b); paper.stroke();
    };
    const text = (words, [x, y], color, align = "center") => {
      paper.textAlign = align; paper.textBaseline = "middle";
      paper.strokeStyle = theme.background; paper.lineWidth = 4; paper.lineJoin = "round";
      paper.strokeText(words, x, y);
      paper.lineWidth = 1; paper.fillStyle = color;
      paper.fillText(words, x, y);
    };
    const box = d.cut ?? d.all;
    if (box) {
      for (let i = 0; i < 8; i++) for (const bit of [1, 2, 4]) {
        if (!(i & bit)) line(onScreen(cornerOf(box, i)), onScreen(cornerOf(box, i | bit)), theme.muted + "66");
      }
      // Each size stands at the edge of its axis that is lowest on the screen, where it is seen from the side.
      [1, 2, 4].forEach((bit, axis) => {
        const edges = [0, 1, 2, 3, 4, 5, 6, 7].filter((i) => !(i & bit)).map((i) => [onScreen(cornerOf(box, i)), onScreen(cornerOf(box, i | bit))]);
        const [a, b] = edges.reduce((best, edge) => edge[0][1] + edge[1][1] > best[0][1] + best[1][1] ? edge : best);
        if (Math.hypot(a[0] - b[0], a[1] - b[1]) < 34) return;
        const doubled = axis === 0 && d.diameter ? 2 : 1;
        const words = `${"XYZ"[axis]} ${lengthText((box[1][axis] - box[0][axis]) * doubled, d.units)}`;
        const upright = Math.abs(a[0] - b[0]) < Math.abs(a[1] - b[1]) / 3;
        const middle = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
        text(words, upright ? [middle[0] + 8, middle[1]] : [middle[0], middle[1] + 14], theme.text, upright ? "left" : "center");
      });
    }
    const zero = onScreen([0, 0, 0]);
    [["X", "#e74c3c"], ["Y", "#27ae60"], ["Z", "#3d8bfd"]].forEach(([name, color], i) => {
      const way = [rows[0][i], -rows[1][i]];
      if (Math.hypot(...way) < 0.1) return;
      line(zero, [zero[0] + way[0] * 44, zero[1] + way[1] * 44], color);
      text(name, [zero[0] + way[0] * 54, zero[1] + way[1] * 54], color);
    });
    for (const mark of marks) {
      const p = onScreen(pointOf(mark.piece));
      paper.fillStyle = theme[mark.severity] ?? theme.info;
      paper.strokeStyle = theme.background;
      paper.beginPath(); paper.arc(p[0], p[1], 5, 0, 2 * Math.PI); paper.fill(); paper.stroke();
    }
    // Where the control would stop: a cross.
    for (const alarm of d.alarms ?? []) {
      if (!alarm.at) continue;
      const [x, y] = onScreen(alarm.at);
      paper.lineWidth = 3;
      line([x - 6, y - 6], [x + 6, y + 6], theme.error);
      line([x - 6, y + 6], [x + 6, y - 6], theme.error);
    }
    if (d.count > 1 && at < last()) {
      const p = onScreen(tip);
      paper.lineWidth = 2; paper.strokeStyle = theme.text;
      paper.beginPath(); paper.arc(p[0], p[1], 6, 0, 2 * Math.PI); paper.stroke();
      const up = d.lathe ? [1, 0, 0] : [0, 0, 1];
      line(p, [p[0] + dot(rows[0], up) * 40, p[1] - dot(rows[1], up) * 40], theme.text);
    }
    // A bar of a round length.
    const unitMm = d.units === "inch" ? 25.4 : 1, most = 110 / scale / unitMm;
    const ten = 10 ** Math.floor(Math.log10(most)), round = [5, 2, 1].map((k) => k * ten).find((k) => k <= most) ?? ten;
    const bar = round * unitMm * scale, y = height - 14;
    line([14, y], [14 + bar, y], theme.text);
    for (const x of [14, 14 + bar]) line([x, y - 4], [x, y + 4], theme.text);
    text(`${+round.toPrecision(3)} ${d.units}`, [20 + bar, y], theme.text, "left");
  }

  function draw() {
    if (!frame) frame = requestAnimationFrame(paint);
  }

  /** The view moves; when it has rested for a while everything is drawn. */
  function drawMoving() {
    clearTimeout(moving);
    moving = setTimeout(() => { moving = 0; draw(); }, 150);
    draw();
  }

  let selected = false;

  function covers(i, file, first, end) {
    const line = d.lines[i];
    if (d.fileOf && d.fileOf[i] !== file) return false;
    if (!d.fileOf && file !== 0) return false;
    if (line >= first && line <= end) return true;
    const before = d.lines[i - 1];
    return d.thinned && line > end && before < first && (!d.fileOf || d.fileOf[i - 1] === file);
  }

  function select(file, first = 0, end = first) {
    chosen.fill(0);
    selected = false;
    let found = -1;
    if (file !== null) {
      for (let i = 1; i < d.count; i++) {
        if (d.kinds[i] !== KIND.START && covers(i, file, first, end)) {
          chosen[i] = 1;
          if (found < 0) found = i;
        }
      }
      selected = found >= 0;
    }
    if (gpu) uploadChosen();
    draw();
    return found < 0 ? null : placeOf(found);
  }

  function setMarks(wanted) {
    const open = new Map();
    for (const mark of wanted) {
      const key = `${mark.file}:${mark.line}`;
      if (!open.has(key)) open.set(key, { ...mark, piece: 0 });
    }
    // One pass: a mark stands where the run first comes to its line.
    let left = open.size;
    for (let i = 1; i < d.count && left; i++) {
      if (d.kinds[i] === KIND.START) continue;
      const mark = open.get(`${d.fileOf ? d.fileOf[i] : 0}:${d.lines[i]}`);
      if (mark && !mark.piece) { mark.piece = i; left--; }
    }
    marks = [...open.values()].filter((mark) => mark.piece).slice(0, 1000);
    draw();
  }

  function placeOf(i) {
    return {
      piece: i, file: d.fileOf ? d.fileOf[i] : 0, line: d.lines[i], kind: d.kinds[i], tool: d.tools[d.toolOf[i]] ?? null,
      point: i === at ? [...tip] : pointOf(i), seconds: i === at ? clock : d.seconds[i],
    };
  }

  /** The tool at a time. */
  function goToTime(seconds) {
    if (d.count < 2) return;
    clock = Math.min(Math.max(seconds, 0), d.seconds[last()]);
    let low = 1, high = last();
    while (low < high) {
      const middle = (low + high) >> 1;
      if (d.seconds[middle] < clock) low = middle + 1; else high = middle;
    }
    at = low;
    const [from, to] = [d.seconds[at - 1], d.seconds[at]];
    const part = d.kinds[at] === KIND.START || to <= from ? 1 : (clock - from) / (to - from);
    const [a, b] = [pointOf(at - 1), pointOf(at)];
    tip = part >= 1 ? b : a.map((v, i) => v + (b[i] - v) * part);
    draw();
    callbacks.onProgress?.(placeOf(at));
  }

  /** The tool at the end of a piece. */
  function goTo(piece) {
    if (d.count < 2) return;
    at = Math.min(Math.max(piece, 0), last());
    clock = d.seconds[at];
    tip = pointOf(at);
    draw();
    callbacks.onProgress?.(placeOf(at));
  }

  function step(by) {
    let next = at;
    do next += Math.sign(by); while (next > 0 && next < last() && d.kinds[next] === KIND.START);
    goTo(Math.abs(by) > 1 ? at + by : next);
  }

  /** To the end of the next group of pieces, or of the one before. */
  function stepGroup(by, same) {
    let next = at;
    if (by > 0) {
      next++;
      while (next < last() && same(next + 1, next)) next++;
    } else {
      while (next > 0 && same(next, at)) next--;
    }
    goTo(next);
  }

  const stepBlock = (by) => stepGroup(by, (i, j) => d.lines[i] === d.lines[j] && (!d.fileOf || d.fileOf[i] === d.fileOf[j]));
  const stepTool = (by) => stepGroup(by, (i, j) => d.toolOf[i] === d.toolOf[j]);

  function play() {
    if (playing || d.count < 2) return;
    if (at >= last()) goTo(0);
    playing = true;
    playedAt = performance.now();
    const tick = (time) => {
      if (!playing) return;
      const passed = Math.min(Math.max(time - playedAt, 0), 250);
      playedAt = time;
      goToTime(clock + passed / 1000 * speed);
      if (clock >= d.seconds[last()]) { goTo(last()); pause(); return; }
      playFrame = requestAnimationFrame(tick);
    };
    playFrame = requestAnimationFrame(tick);
    callbacks.onPlay?.(true);
  }

  function pause() {
    if (!playing) return;
    playing = false;
    cancelAnimationFrame(playFrame);
    draw();
    callbacks.onPlay?.(false);
  }

  /** What is cut, with as much of the way there as lies near: a retract to the end of the machine would leave a dot of the part. */
  function near() {
    if (!d.all) return [[-10, -10, -10], [10, 10, 10]];
    if (!d.cut) return d.all;
    const around = Math.max(...d.cut[1].map((v, i) => v - d.cut[0][i])) / 4;
    const box = [d.cut[0].map((v, i) => Math.max(v - around, d.all[0][i])), d.cut[1].map((v, i) => Math.min(v + around, d.all[1][i]))];
    if (d.lathe) box[0][0] = Math.min(box[0][0], 0);
    return box;
  }

  function fit() {
    const box = near(), [width, height] = size();
    target = box[0].map((v, i) => (v + box[1][i]) / 2);
    const reach = [0, 0];
    for (let i = 0; i < 8; i++) {
      const v = cornerOf(box, i).map((x, k) => x - target[k]);
      for (const k of [0, 1]) reach[k] = Math.max(reach[k], Math.abs(dot(rows[k], v)));
    }
    const wanted = Math.min((width - 90) / 2 / Math.max(reach[0], 1e-3), (height - 90) / 2 / Math.max(reach[1], 1e-3));
    scale = Math.min(Math.max(wanted, 1e-4), 1e4);
    draw();
  }

  function setView(name) {
    rows = VIEWS[name] ?? VIEWS.iso;
    fit();
  }

  function turn(dx, dy) {
    const up = d.lathe ? [1, 0, 0] : [0, 0, 1];
    const about = rows.map((row) => turned(row, up, -dx * 0.008));
    const tilted = about.map((row) => turned(row, about[0], -dy * 0.008));
    rows = [unit(tilted[0]), unit(cross(tilted[2], tilted[0])), unit(tilted[2])];
    drawMoving();
  }

  function shift(dx, dy) {
    target = target.map((v, i) => v - (rows[0][i] * dx - rows[1][i] * dy) / scale);
    drawMoving();
  }

  function zoom(factor, x, y) {
    const [width, height] = size(), before = scale;
    scale = Math.min(Math.max(scale * factor, 1e-4), 1e5);
    // The point under the pointer stays.
    const k = 1 / before - 1 / scale, [right, up] = [(x - width / 2) * k, (height / 2 - y) * k];
    target = target.map((v, i) => v + rows[0][i] * right + rows[1][i] * up);
    drawMoving();
  }

  /** The piece at a place of the canvas, or 0. */
  function pieceAt(x, y) {
    if (d.count < 2 || !gpu || gl.isContextLost()) return 0;
    const [width, height] = size(), reach = 6;
    if (!gpu.picking || gpu.picking.width !== canvas.width || gpu.picking.height !== canvas.height) {
      const frame = gl.createFramebuffer(), buffers = [gl.createRenderbuffer(), gl.createRenderbuffer()];
      gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
      [[gl.RGBA8, gl.COLOR_ATTACHMENT0], [gl.DEPTH_COMPONENT16, gl.DEPTH_ATTACHMENT]].forEach(([format, place], i) => {
        gl.bindRenderbuffer(gl.RENDERBUFFER, buffers[i]);
        gl.renderbufferStorage(gl.RENDERBUFFER, format, canvas.width, canvas.height);
        gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, buffers[i]);
      });
      gpu.picking = { frame, width: canvas.width, height: canvas.height };
    }
    gl.bindFramebuffer(gl.FRAMEBUFFER, gpu.picking.frame);
    const ratio = canvas.width / width, px = Math.round(x * ratio), py = Math.round((height - y) * ratio);
    const side = 2 * reach + 1, left = px - reach, bottom = py - reach;
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(left, bottom, side, side);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    prepare(width, height, 1, 2);
    pieces(1, last());
    gl.disable(gl.SCISSOR_TEST);
    const pixels = new Uint8Array(4 * side * side);
    gl.readPixels(left, bottom, side, side, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    let best = 0, nearest = Infinity;
    for (let i = 0; i < side * side; i++) {
      const id = pixels[4 * i] + pixels[4 * i + 1] * 256 + pixels[4 * i + 2] * 65536 + pixels[4 * i + 3] * 16777216;
      const away = Math.hypot(i % side - reach, Math.floor(i / side) - reach);
      if (id && away < nearest) { best = id; nearest = away; }
    }
    return best;
  }

  const listening = new AbortController();
  const listen = (on, name, then, options = {}) => on.addEventListener(name, then, { ...options, signal: listening.signal });
  const fingers = new Map();
  let travelled = 0;

  listen(canvas, "pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, [event.offsetX, event.offsetY]);
    travelled = fingers.size > 1 ? Infinity : 0;
  });
  listen(canvas, "pointermove", (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) return;
    const now = [event.offsetX, event.offsetY], [dx, dy] = [now[0] - before[0], now[1] - before[1]];
    fingers.set(event.pointerId, now);
    travelled += Math.hypot(dx, dy);
    if (travelled < 4) return;
    if (fingers.size > 1) {
      const other = [...fingers].find(([id]) => id !== event.pointerId)[1];
      const apart = (p) => Math.max(Math.hypot(p[0] - other[0], p[1] - other[1]), 1);
      shift(dx / 2, dy / 2);
      zoom(apart(now) / apart(before), (now[0] + other[0]) / 2, (now[1] + other[1]) / 2);
    } else if (event.shiftKey || event.buttons & 6) shift(dx, dy);
    else turn(dx, dy);
  });
  for (const name of ["pointerup", "pointercancel"]) listen(canvas, name, (event) => {
    const isClick = fingers.delete(event.pointerId) && travelled < 4 && name === "pointerup" && event.button === 0;
    if (!isClick) return;
    const piece = pieceAt(event.offsetX, event.offsetY);
    callbacks.onPick?.(piece ? placeOf(piece) : null);
  });
  listen(canvas, "contextmenu", (event) => event.preventDefault());
  listen(canvas, "wheel", (event) => {
    event.preventDefault();
    const pixels = event.deltaY * (event.deltaMode === 1 ? 16 : 1);
    zoom(Math.exp(-Math.min(Math.max(pixels, -300), 300) * 0.0015), event.offsetX, event.offsetY);
  }, { passive: false });
  listen(canvas, "keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const ways = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const views = { 1: "top", 2: "front", 3: "side", 4: "iso", 5: "lathe" };
    const [width, height] = size(), way = ways[event.key];
    if (way) (event.shiftKey ? shift : turn)(way[0] * 20, way[1] * 20);
    else if (event.key === "+" || event.key === "=") zoom(1.25, width / 2, height / 2);
    else if (event.key === "-") zoom(0.8, width / 2, height / 2);
    else if (event.key === "f" || event.key === "F") fit();
    else if (views[event.key]) setView(views[event.key]);
    else return;
    event.preventDefault();
    event.stopPropagation();
  });
  listen(canvas, "webglcontextlost", (event) => { event.preventDefault(); gpu = null; });
  listen(canvas, "webglcontextrestored", () => { upload(); draw(); });
  const watcher = new ResizeObserver(draw);
  watcher.observe(canvas);

  function setData(next) {
    pause();
    d = decode(next);
    chosen = new Uint8Array(Math.max(Math.ceil(d.count / ROW), 1) * ROW);
    selected = false; marks = []; hiddenTools = new Set(); slow = 0;
    upload();
    at = Math.max(last(), 0);
    clock = d.count ? d.seconds[at] : 0;
    tip = d.count ? pointOf(at) : [0, 0, 0];
    setView(d.lathe ? "lathe" : "iso");
  }

  setData(data);
  return {
    setView, fit, select, setMarks, goTo, goToTime, step, stepBlock, stepTool, play, pause, draw, setData,
    setSpeed: (factor) => { speed = factor; },
    showRapids: (yes) => { rapids = yes; draw(); },
    showTool: (index, yes) => { hiddenTools[yes ? "delete" : "add"](index); if (gpu) uploadTools(); draw(); },
    setTheme: (colors) => { theme = { ...THEMES.dark, ...colors }; draw(); },
    place: () => placeOf(at),
    pieces: () => Math.max(d.count - 1, 0),
    duration: () => d.count ? d.seconds[last()] : 0,
    isPlaying: () => playing,
    destroy: () => { pause(); listening.abort(); watcher.disconnect(); overlay.remove(); },
  };
}
