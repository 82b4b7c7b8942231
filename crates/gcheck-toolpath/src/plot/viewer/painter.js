// The path on the graphics card, in WebGL 2.
//
// Knows: points, marks of pieces, a palette, a camera. Must not know: tools, feeds, what colours mean.
//
// Points are in a texture, so many a row: a piece is two triangles that fetch their ends. (Instances of so few corners are
// slow without a graphics card.) Marks are two bytes a piece: its tone, which is an entry of the palette, and flags.

/** Points in a row of a texture. */
export const ROW = 2048;
/** Flags of a piece. */
export const CHOSEN = 1, HIDDEN = 2;

const VERTEX = `#version 300 es
precision highp float; precision highp int;
uniform highp sampler2D uPoints; uniform highp usampler2D uMarks;
uniform mat3 uTurn; uniform vec3 uTarget, uTip; uniform vec2 uHalf; uniform float uScale, uDepth, uWidth, uSteep;
uniform int uEvery, uLast; uniform bool uRapids, uChosenOnly;
flat out vec2 vTone; out vec3 vPlace;
ivec2 place(int i) { return ivec2(i % ${ROW}, i / ${ROW}); }
void main() {
  int piece = gl_VertexID / 6 * uEvery + 1, corner = gl_VertexID % 6;
  corner = corner > 2 ? corner - 2 : corner;
  vec4 from = texelFetch(uPoints, place(piece - 1), 0), to = texelFetch(uPoints, place(piece), 0);
  uvec2 mark = texelFetch(uMarks, place(piece), 0).rg;
  int kind = int(to.w);
  bool rapid = kind == 1;
  bool hidden = kind == 0 || (mark.g & ${HIDDEN}u) != 0u || (rapid && !uRapids) || (uChosenOnly && (mark.g & ${CHOSEN}u) == 0u);
  vec3 end = piece == uLast ? uTip : to.xyz;
  vec3 a = uTurn * (from.xyz - uTarget), b = uTurn * (end - uTarget);
  vec2 p = a.xy * uScale, q = b.xy * uScale, d = q - p;
  float size = length(d);
  vec2 dir = size > 1e-4 ? d / size : vec2(1.0, 0.0);
  float at = float(corner >> 1), side = float(corner & 1) * 2.0 - 1.0;
  vec2 spot = mix(p, q, at) + (vec2(-dir.y, dir.x) * side + dir * (at * 2.0 - 1.0)) * uWidth * 0.5;
  float away = mix(a.z, b.z, at) / uDepth, z = clamp(away, -0.99, 0.99);
  // A rapid move back through a hole does not cover the cut.
  gl_Position = hidden ? vec4(2.0, 2.0, 2.0, 1.0) : vec4(spot / uHalf, (rapid ? 5e-4 : 0.0) - z, 1.0);
  // Steep pieces are darker, and near ones stronger than far ones: a surface shows its shape.
  vec3 way = to.xyz - from.xyz;
  float shade = 1.0 - uSteep * min(abs(way.z) / max(length(way), 1e-6), 0.6) + 0.14 * clamp(away, -1.0, 1.0);
  vPlace = vec3(at * size, mix(from.z, end.z, at), shade);
  vTone = vec2(float(mark.r), rapid ? 1.0 : 0.0);
}`;

const FRAGMENT = `#version 300 es
precision highp float; precision highp int;
flat in vec2 vTone; in vec3 vPlace; out vec4 color;
uniform sampler2D uPalette;
uniform vec4 uOver; uniform vec3 uRapid; uniform float uDash; uniform bool uChosenOnly;
uniform vec2 uHeights; uniform vec3 uByHeight;
void main() {
  if (vPlace.y < uHeights.x || vPlace.y > uHeights.y) discard;
  if (vTone.y > 0.5) {
    if (!uChosenOnly && fract(vPlace.x / uDash) > 0.55) discard;
    color = vec4(mix(uRapid, uOver.rgb, uOver.a), 1.0);
    return;
  }
  float tone = uByHeight.z > 0.5 ? clamp((vPlace.y - uByHeight.x) * uByHeight.y, 0.0, 1.0) * 253.0 : vTone.x;
  color = vec4(mix(texelFetch(uPalette, ivec2(int(tone + 0.5), 0), 0).rgb * vPlace.z, uOver.rgb, uOver.a), 1.0);
}`;

/** How large a length may be off: points are told in steps of a ten-thousandth of a millimetre, in single precision. */
const SLACK = 5e-4;

function programOf(gl) {
  const made = gl.createProgram();
  for (const [type, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  // They live as long as the program.
  for (const shader of gl.getAttachedShaders(made) ?? []) gl.deleteShader(shader);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS) && !gl.isContextLost()) {
    throw new Error(`the graphics driver refuses the shaders: ${gl.getProgramInfoLog(made)}`);
  }
  return made;
}

/** Paints on a canvas; throws where the browser has no WebGL 2. */
export function createPainter(canvas) {
  // What is drawn stays, so that a picture of many pieces is finished in parts.
  const gl = canvas.getContext("webgl2", { antialias: true, alpha: false, preserveDrawingBuffer: true });
  if (!gl) throw new Error("this browser has no WebGL 2");
  let gpu = null;
  // Points of the former path, 0 without one.
  let formerCount = 0;

  function fill(texture, inside, width, height, format, type, content) {
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, inside, width, height, 0, format, type, content);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
  }

  const isLost = () => !gpu || gl.isContextLost();

  /** Takes the points: x, y, z and the kind of each. */
  function setPoints(d) {
    if (!gpu) {
      const program = programOf(gl), uniforms = {};
      for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); i++) {
        const { name } = gl.getActiveUniform(program, i);
        uniforms[name] = gl.getUniformLocation(program, name);
      }
      const [points, marks, palette, former, formerMarks] = [1, 2, 3, 4, 5].map(() => gl.createTexture());
      gpu = { program, uniforms, points, marks, palette, former, formerMarks };
    }
    fillPoints(gpu.points, d);
  }

  function fillPoints(texture, { points, kinds, count }) {
    const height = Math.max(Math.ceil(count / ROW), 1), texels = new Float32Array(height * ROW * 4);
    for (let i = 0, from = 0, to = 0; i < count; i++) {
      texels[to++] = points[from++];
      texels[to++] = points[from++];
      texels[to++] = points[from++];
      texels[to++] = kinds[i];
    }
    fill(texture, gl.RGBA32F, ROW, height, gl.RGBA, gl.FLOAT, texels);
    return height;
  }

  /** Takes the part of a former path that is drawn below the path; null for none. */
  function setFormer(former) {
    formerCount = former?.count ?? 0;
    if (!gpu || !former) return;
    const height = fillPoints(gpu.former, former);
    fill(gpu.formerMarks, gl.RG8UI, ROW, height, gl.RG_INTEGER, gl.UNSIGNED_BYTE, new Uint8Array(2 * ROW * height));
  }

  function prepare(view, is, lineWidth) {
    const u = gpu.uniforms, { camera, width, height, theme } = view, chosenOnly = is === "chosen";
    const [points, marks] = is === "former" ? [gpu.former, gpu.formerMarks] : [gpu.points, gpu.marks];
    gl.useProgram(gpu.program);
    [[u.uPoints, points], [u.uMarks, marks], [u.uPalette, gpu.palette]].forEach(([place, texture], i) => {
      gl.activeTexture(gl.TEXTURE0 + i);
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.uniform1i(place, i);
    });
    gl.activeTexture(gl.TEXTURE7);
    // Columns of the matrix are what WebGL reads first.
    gl.uniformMatrix3fv(u.uTurn, false, [0, 1, 2].flatMap((i) => camera.rows.map((row) => row[i])));
    gl.uniform3fv(u.uTarget, camera.target);
    gl.uniform3fv(u.uTip, view.tip);
    gl.uniform2f(u.uHalf, width / 2, height / 2);
    gl.uniform1f(u.uScale, camera.scale);
    gl.uniform1f(u.uDepth, view.depth);
    gl.uniform1f(u.uWidth, Math.max(lineWidth, width / canvas.width));
    gl.uniform1f(u.uSteep, view.steep);
    gl.uniform1f(u.uDash, 9);
    gl.uniform1i(u.uRapids, view.rapids ? 1 : 0);
    gl.uniform1i(u.uChosenOnly, chosenOnly ? 1 : 0);
    gl.uniform1i(u.uLast, -1);
    gl.uniform3fv(u.uRapid, theme.rapid);
    gl.uniform4f(u.uOver, 0, 0, 0, 0);
    gl.uniform2f(u.uHeights, view.section[0] - SLACK, view.section[1] + SLACK);
    const [low, high] = view.heights ?? [0, 1];
    gl.uniform3f(u.uByHeight, low, 1 / Math.max(high - low, 1e-6), view.heights ? 1 : 0);
  }

  /** Draws the pieces from `first` to `end`, every so many of them. */
  function pieces(first, end, every = 1) {
    const count = Math.floor((end - first) / every) + 1, skipped = Math.floor((first - 1) / every);
    gl.uniform1i(gpu.uniforms.uEvery, every);
    if (count > 0) gl.drawArrays(gl.TRIANGLES, 6 * skipped, 6 * count);
  }

  /** What is drawn one after the other: the former path, what is to come, what was done, what is chosen. Each has a range of pieces. */
  function layers({ at, last, selected, former }) {
    const all = [];
    if (last < 1) return all;
    if (former && formerCount > 1) all.push({ is: "former", first: 1, end: formerCount - 1 });
    if (at < last) all.push({ is: "coming", first: Math.max(at, 1), end: last });
    all.push({ is: "done", first: 1, end: Math.min(at, last) });
    if (selected) all.push({ is: "chosen", first: selected[0], end: selected[1] });
    return all;
  }

  /** Draws a part of a layer. */
  function paintPart(view, is, first, end, every) {
    const { theme, at, last } = view;
    prepare(view, is, { chosen: 4, former: 1 }[is] ?? 1.5);
    if (is === "chosen" || is === "former") {
      // Over all of the path, and below all of it.
      gl.disable(gl.DEPTH_TEST);
      gl.uniform4f(gpu.uniforms.uOver, ...(is === "chosen" ? theme.accent : theme.former), 1);
    } else {
      gl.enable(gl.DEPTH_TEST);
      gl.depthFunc(gl.LEQUAL);
    }
    if (is === "coming") {
      // What is still to come does not cover what was done.
      gl.uniform4f(gpu.uniforms.uOver, ...theme.background, theme.faint);
      gl.depthMask(false);
    } else if (is === "done" && at < last) gl.uniform1i(gpu.uniforms.uLast, at);
    pieces(first, end, every);
    gl.depthMask(true);
  }

  /**
   * Begins a picture: every so many pieces of each layer. `view` has camera, width, height, depth, theme (colours as numbers:
   * background, rapid, accent, former; and faint), steep (how much darker steep pieces are), tip, at, last, rapids, section,
   * heights, selected and former (whether the former path is shown).
   */
  function begin(view, every) {
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(...view.theme.background, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    // Few pieces are chosen at a time, and none of them may be passed over.
    for (const { is, first, end } of layers(view)) paintPart(view, is, first, end, is === "chosen" && end - first < 20000 ? 1 : every);
  }

  /** The rest of a picture in parts of so many pieces: a function that draws the next part, and says whether there are more. */
  function finishing(view) {
    const left = layers(view);
    return (most) => {
      for (let count = most; count > 0 && left.length;) {
        const [layer] = left, end = Math.min(layer.first + count - 1, layer.end);
        paintPart(view, layer.is, layer.first, end, 1);
        count -= end - layer.first + 1;
        layer.first = end + 1;
        if (layer.first > layer.end) left.shift();
      }
      return left.length > 0;
    };
  }

  /** Waits until the picture is there. */
  const wait = () => gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));

  /** Gives the memory of the graphics card back. */
  function destroy() {
    if (gpu) {
      for (const texture of [gpu.points, gpu.marks, gpu.palette, gpu.former, gpu.formerMarks]) gl.deleteTexture(texture);
      gl.deleteProgram(gpu.program);
    }
    gpu = null;
  }

  return {
    isLost, setPoints, setFormer, destroy, begin, finishing, wait,
    setMarks: (marks) => { if (gpu) fill(gpu.marks, gl.RG8UI, ROW, marks.length / 2 / ROW, gl.RG_INTEGER, gl.UNSIGNED_BYTE, marks); },
    setPalette: (bytes) => { if (gpu) fill(gpu.palette, gl.RGBA8, 256, 1, gl.RGBA, gl.UNSIGNED_BYTE, bytes); },
    clear: (color) => { gl.clearColor(...color, 1); gl.clear(gl.COLOR_BUFFER_BIT); },
    forget: () => { gpu = null; },
  };
}
