// The view as an SVG picture: the same lines and colours, in the order of the run.
//
// Knows: the data of a drawing, a camera, marks of pieces. Must not know: the graphics card, where the picture goes.
//
// A picture has no depth: what is done later covers what was done before, and cuts cover rapid moves. Points
// nearer to each other than a third of a pixel are one.

import { KIND } from "./data.js";
import { between } from "./geometry.js";
import { css, SCALE } from "./colors.js";
import { CHOSEN, HIDDEN } from "./painter.js";

const NEAR = 0.35;

/** The part of a piece that is between two heights; null when none is. */
function cut(from, to, [low, high]) {
  const rise = to[2] - from[2];
  if (Math.abs(rise) < 1e-9) return from[2] >= low - 5e-4 && from[2] <= high + 5e-4 ? [from, to] : null;
  const ends = [(low - from[2]) / rise, (high - from[2]) / rise].sort((a, b) => a - b);
  const [first, last] = [Math.max(ends[0], 0), Math.min(ends[1], 1)];
  return first < last ? [between(from, to, first), between(from, to, last)] : null;
}

/** Draws the pieces of a scene on a paper. */
export function drawPieces(paper, scene) {
  const { d, camera, theme, marks, palette, heights, section, at, tip, rapids, former } = scene;
  const last = d.count - 1, pointAt = (i) => [d.points[3 * i], d.points[3 * i + 1], d.points[3 * i + 2]];
  const depth = camera.depth(d.all ?? [[0, 0, 0], [1, 1, 1]]);
  const mix = (color, part) => color.map((value, i) => value + (scene.ground[i] - value) * part);
  let open = null;
  const close = () => { if (open && open.points.length > 1) paper.line(open.points, open.style); open = null; };
  const add = (style, a, b) => {
    const key = `${style.color} ${style.width} ${style.dash}`, end = open?.points.at(-1);
    if (!open || open.key !== key || Math.hypot(end[0] - a[0], end[1] - a[1]) > NEAR) {
      close();
      open = { key, style, points: [a, b] };
    } else if (Math.hypot(end[0] - b[0], end[1] - b[1]) > NEAR) open.points.push(b);
  };
  const colorOf = (i, a, b, way) => {
    const tone = heights ? Math.round(Math.min(Math.max(((a[2] + b[2]) / 2 - heights[0]) / (heights[1] - heights[0]), 0), 1) * (SCALE - 1)) : marks[2 * i];
    const near = b.map((v, k) => v - camera.target[k]).reduce((sum, v, k) => sum + v * camera.rows[2][k], 0) / depth;
    const steep = Math.min(Math.abs(way[2]) / Math.max(Math.hypot(...way), 1e-6), 0.6);
    // Few shades, so that lines stay long.
    const shade = Math.round((1 - scene.steep * steep + 0.14 * Math.min(Math.max(near, -1), 1)) * 16) / 16;
    return [0, 1, 2].map((k) => palette[4 * tone + k] / 255 * shade);
  };
  const each = (first, end, faint, tipAt, rapid) => {
    for (let i = Math.max(first, 1); i <= end; i++) {
      const kind = d.kinds[i], isRapid = kind === KIND.RAPID;
      if (kind === KIND.START || marks[2 * i + 1] & HIDDEN || isRapid !== rapid) continue;
      const from = pointAt(i - 1), whole = pointAt(i), part = cut(from, i === tipAt ? tip : whole, section);
      if (!part) continue;
      const color = isRapid ? scene.rapid : colorOf(i, ...part, whole.map((v, k) => v - from[k]));
      add({ color: css(faint ? mix(color, theme.faint) : color), width: 1.5, dash: isRapid ? [5, 4] : [] }, ...part.map(camera.onScreen));
    }
    close();
  };
  for (let i = 1; i < (former?.count ?? 0); i++) {
    if (former.kinds[i] === KIND.START || (former.kinds[i] === KIND.RAPID && !rapids)) continue;
    const [from, to] = [i - 1, i].map((end) => [...former.points.slice(3 * end, 3 * end + 3)]), part = cut(from, to, section);
    if (part) add({ color: theme.former, width: 1, dash: former.kinds[i] === KIND.RAPID ? [5, 4] : [] }, ...part.map(camera.onScreen));
  }
  close();
  // A rapid move back through a hole does not cover the cut.
  for (const rapid of rapids ? [true, false] : [false]) {
    if (at < last) each(at, last, true, -1, rapid);
  }
  for (const rapid of rapids ? [true, false] : [false]) each(1, Math.min(at, last), false, at < last ? at : -1, rapid);
  for (let i = 1; i <= last; i++) {
    if (!(marks[2 * i + 1] & CHOSEN) || marks[2 * i + 1] & HIDDEN) continue;
    const part = cut(pointAt(i - 1), pointAt(i), section);
    if (part) add({ color: theme.accent, width: 4, dash: [] }, ...part.map(camera.onScreen));
  }
  close();
}
