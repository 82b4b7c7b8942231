// What is around the path: the tool in its size, the zeros of work offsets, how far the machine goes.
//
// Knows: a paper, a camera, the data of a drawing. Must not know: how the path itself is drawn, where words have room.

import { css, onGround, rgb } from "./colors.js";
import { cross, dot, unit } from "./geometry.js";

/** Corners of a circle that looks round. */
const CORNERS = 36;
/** Pixels: a tool of a smaller radius is a sign and not a shape. */
const LEAST_RADIUS = 2;
/** How long a tool is drawn, in its diameters, and in pixels at least: its real length is not told. */
const LONG = 3, LEAST_LENGTH = 40;
const UP = [0, 0, 1];

/** Do rotary axes turn where the tool is? Then the direction of the tool to the work is not known here. */
function isTilted(d, at) {
  if (!d.rotary) return false;
  return [...d.rotary.axes].some((axis, i) => !(Math.abs(d.rotary.values[i * d.count + at]) < 0.01));
}

/** Draws the tool as a cylinder on its tip, where its diameter is known; says whether it did. */
export function toolShape(paper, { d, camera, theme, tip, at }) {
  const tool = d.tools[d.toolOf[at]], radius = (tool?.diameter ?? 0) / 2;
  if (d.lathe || radius * camera.scale < LEAST_RADIUS || isTilted(d, at)) return false;
  const long = Math.max(2 * radius * LONG, LEAST_LENGTH / camera.scale);
  const style = { color: css(onGround(rgb(tool.color), { ...theme, least: Math.max(theme.least, 3) })), width: 1.5 };
  const on = ([x, y], height) => camera.onScreen([tip[0] + x * radius, tip[1] + y * radius, tip[2] + height]);
  for (const height of [0, long]) {
    paper.line(Array.from({ length: CORNERS + 1 }, (_, i) => on([Math.cos(2 * Math.PI * i / CORNERS), Math.sin(2 * Math.PI * i / CORNERS)], height)), style);
  }
  // The outline of its side, which is not seen from above.
  const across = cross(UP, camera.rows[2]);
  if (Math.hypot(...across) > 0.02) {
    const side = unit(across), other = side.map((part) => -part);
    for (const way of [side, other]) paper.line([on(way, 0), on(way, long)], style);
  }
  paper.disc(camera.onScreen(tip), 2, { fill: style.color });
  return true;
}

/** Draws zeros beside the one of the path; gives the names of all, with places where they may be written. */
export function zeros(paper, { d, camera, theme }) {
  if (d.zeros.length < 2) return [];
  return d.zeros.map(({ name, at }) => {
    const [x, y] = camera.onScreen(at);
    if (Math.hypot(...at) > 0) {
      for (const row of [0, 1, 2]) {
        const way = [camera.rows[0][row] * 16, -camera.rows[1][row] * 16];
        paper.line([[x, y], [x + way[0], y + way[1]]], { color: theme.text, width: 1.5 });
      }
    }
    return { name, places: [[-8, 12], [-8, -12], [8, 12], [8, -12]].map(([dx, dy]) => ({ at: [x + dx, y + dy], align: dx < 0 ? "right" : "left" })) };
  });
}

/** Draws the ends of the travel, at the height of the lowest point; gives their names, with places where they may be written. */
export function travel(paper, { d, camera, theme }) {
  if (!d.all || !d.travel.some(Boolean)) return [];
  const within = [0, 1].map((axis) => d.travel[axis] ?? [d.all[0][axis], d.all[1][axis]]);
  const names = [];
  d.travel.forEach((range, axis) => range?.forEach((limit, end) => {
    const isCrossed = end ? d.all[1][axis] > limit + 1e-3 : d.all[0][axis] < limit - 1e-3;
    const corner = (along) => { const p = [0, 0, d.all[0][2]]; [p[axis], p[1 - axis]] = [limit, along]; return camera.onScreen(p); };
    const [from, to] = within[1 - axis].map(corner);
    // An edge seen from its end is a point.
    if (Math.hypot(to[0] - from[0], to[1] - from[1]) < 12 && dot(camera.rows[2], UP) < 0.1) return;
    const color = isCrossed ? theme.error : theme.muted;
    paper.line([from, to], { color, width: isCrossed ? 2 : 1, dash: [10, 6] });
    const at = [0.5, 0.25, 0.75].map((part) => ({ at: [from[0] + (to[0] - from[0]) * part, from[1] + (to[1] - from[1]) * part], align: "center" }));
    names.push({ name: `${"XY"[axis]}${end ? "+" : "−"} travel${isCrossed ? ", crossed" : ""}`, places: at, color: isCrossed ? theme.error : theme.text });
  }));
  return names;
}
