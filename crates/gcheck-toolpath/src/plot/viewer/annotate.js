// What is written on the path: its size, zeros, marks, the tool, the travel, what is measured, a bar of a known length.
//
// Knows: a paper, a camera, the data of a drawing. Must not know: how the path itself is drawn.
//
// Words never cover each other: each has several places where it may be, and takes the first that is free.

import { css, onGround, rgb } from "./colors.js";
import { cornerOf, dot } from "./geometry.js";
import { toolShape, travel, zeros } from "./surroundings.js";
import { lengthText } from "./words.js";

/** Contrast of words to the ground (WCAG 2). */
const LEAST_OF_WORDS = 4.5;
const AXES = [["X", "#c2504a"], ["Y", "#27ae60"], ["Z", "#3d8bfd"]];

/** Places that are taken, as [left, top, right, bottom]. */
function createRoom(width, height) {
  const taken = [];
  const isFree = (box) => box[0] >= 2 && box[1] >= 2 && box[2] <= width - 2 && box[3] <= height - 2
    && taken.every((other) => box[2] <= other[0] || box[0] >= other[2] || box[3] <= other[1] || box[1] >= other[3]);
  return {
    take: (box) => taken.push(box),
    /** Takes the first free of some boxes; its index, or -1. */
    first(boxes) {
      const found = boxes.findIndex(isFree);
      if (found >= 0) taken.push(boxes[found]);
      return found;
    },
  };
}

/** The box of words at a place. */
function boxOf(paper, words, [x, y], align) {
  const width = paper.width(words) + 4, left = align === "left" ? x - 2 : align === "right" ? x - width + 2 : x - width / 2;
  return [left, y - 9, left + width, y + 9];
}

/** Writes words at the first place that is free; places are { at, align }. */
function write(paper, room, words, places, color) {
  const found = room.first(places.map(({ at, align }) => boxOf(paper, words, at, align)));
  if (found >= 0) paper.text(words, places[found].at, { color, align: places[found].align });
  return found >= 0;
}

/** Both sides of an edge, in its middle and toward its ends; edges at the rim first, upright ones at the left or right, others below. */
function placesAtEdges(edges) {
  const middle = edges.flat().reduce((sum, [x]) => sum + x, 0) / edges.length / 2;
  // Edges are parallel on the screen as well.
  const upright = edges.every(([a, b]) => Math.abs(a[0] - b[0]) < Math.abs(a[1] - b[1]) / 3);
  const low = ([a, b]) => a[1] + b[1], far = ([a, b]) => upright ? Math.round(Math.abs(a[0] + b[0] - 2 * middle)) : 0;
  const sorted = [...edges].sort((one, other) => far(other) - far(one) || low(other) - low(one));
  const places = sorted.flatMap(([a, b]) => {
    return [0.5, 0.3, 0.7].map((part) => {
      const [x, y] = [a[0] + (b[0] - a[0]) * part, a[1] + (b[1] - a[1]) * part];
      const sides = upright ? [{ at: [x + 8, y], align: "left" }, { at: [x - 8, y], align: "right" }]
        : [{ at: [x, y + 14], align: "center" }, { at: [x, y - 14], align: "center" }];
      return upright && x < middle ? sides.reverse() : sides;
    });
  });
  return { outer: places.map(([outer]) => outer), inner: places.map(([, inner]) => inner) };
}

function extents(paper, room, scene) {
  const { d, camera, theme, width, height } = scene, box = d.cut ?? d.all;
  if (!box) return;
  // Dotted where it is as strong as the path.
  const style = theme.least > 4.3 ? { color: theme.muted, dash: [1, 4] } : { color: theme.muted, opacity: 0.4 };
  for (let i = 0; i < 8; i++) for (const bit of [1, 2, 4]) {
    if (!(i & bit)) paper.line([camera.onScreen(cornerOf(box, i)), camera.onScreen(cornerOf(box, i | bit))], style);
  }
  // Sizes that have no room at their edges are in the corner.
  const corner = [0, 1, 2].map((row) => ({ at: [14, height - 40 - 18 * row], align: "left" }));
  [1, 2, 4].forEach((bit, axis) => {
    const size = box[1][axis] - box[0][axis];
    if (axis === 1 && d.lathe && size === 0) return;
    const edges = [0, 1, 2, 3, 4, 5, 6, 7].filter((i) => !(i & bit)).map((i) => [camera.onScreen(cornerOf(box, i)), camera.onScreen(cornerOf(box, i | bit))]);
    // An edge seen from its end has no length to be named.
    if (Math.abs(dot(camera.rows[2], [0, 1, 2].map((k) => k === axis ? 1 : 0))) > 0.97) return;
    const words = `${axis === 0 && d.diameter ? "X Ø" : "XYZ"[axis]} ${lengthText(size * (axis === 0 && d.diameter ? 2 : 1), d.units)}`;
    // The path is on the inner side: where there is no room around it, the corner is better.
    const { outer, inner } = placesAtEdges(edges);
    write(paper, room, words, [...outer, ...corner, ...inner], theme.text);
  });
}

function zero(paper, room, { camera, theme }) {
  const origin = camera.onScreen([0, 0, 0]);
  AXES.forEach(([name, usual], i) => {
    const color = css(onGround(rgb(usual), { ...theme, least: Math.max(theme.least, LEAST_OF_WORDS) }));
    const way = [camera.rows[0][i], -camera.rows[1][i]];
    if (Math.hypot(...way) < 0.1) return;
    const at = (far) => [origin[0] + way[0] * far, origin[1] + way[1] * far];
    paper.line([origin, at(44)], { color, width: 1.5 });
    write(paper, room, name, [54, 64, 34].map((far) => ({ at: at(far), align: "center" })), color);
  });
}

function measured(paper, room, { camera, theme, measure }) {
  if (!measure.isOn && !measure.picks.length) return;
  const color = theme.measure, cross = (p, r, width) => {
    paper.line([[p[0] - r, p[1]], [p[0] + r, p[1]]], { color, width });
    paper.line([[p[0], p[1] - r], [p[0], p[1] + r]], { color, width });
  };
  for (const { point } of measure.centres) cross(camera.onScreen(point), 5, 1);
  const ends = measure.picks.map(({ point }) => camera.onScreen(point));
  if (ends.length === 2) {
    paper.line(ends, { color, width: 2, dash: [6, 4] });
    const words = measure.distanceText;
    const [x, y] = [(ends[0][0] + ends[1][0]) / 2, (ends[0][1] + ends[1][1]) / 2];
    write(paper, room, words, [[0, -14], [0, 14], [0, -30], [0, 30], [60, 0], [-60, 0]].map(([dx, dy]) => ({ at: [x + dx, y + dy], align: "center" })), color);
  }
  for (const end of ends) { paper.disc(end, 5, { color, width: 2 }); cross(end, 2, 2); }
  if (measure.snap) paper.disc(camera.onScreen(measure.snap.point), 7, { color, width: 2 });
}

function bar(paper, room, { d, camera, theme, height }) {
  const unit = d.units === "inch" ? 25.4 : 1, most = 110 / camera.scale / unit;
  const ten = 10 ** Math.floor(Math.log10(most)), round = [5, 2, 1].map((k) => k * ten).find((k) => k <= most) ?? ten;
  const long = round * unit * camera.scale, y = height - 14, style = { color: theme.text };
  const words = `${+round.toPrecision(3)} ${d.units}`;
  paper.line([[14, y], [14 + long, y]], style);
  for (const x of [14, 14 + long]) paper.line([[x, y - 4], [x, y + 4]], style);
  paper.text(words, [20 + long, y], { color: theme.text, align: "left" });
  room.take([10, y - 9, 24 + long + paper.width(words), y + 9]);
}

/** Draws it all. */
export function annotate(paper, scene) {
  const { d, camera, theme, width, height, marks, tip, isPart } = scene, room = createRoom(width, height);
  bar(paper, room, scene);
  // Marks are drawn over words, so that no words may be where they are.
  for (const { point } of [...marks, ...d.alarms.filter(({ at }) => at).map(({ at }) => ({ point: at })), ...scene.measure.picks]) {
    const [x, y] = camera.onScreen(point);
    room.take([x - 6, y - 6, x + 6, y + 6]);
  }
  measured(paper, room, scene);
  zero(paper, room, scene);
  for (const { name, places, color } of [...zeros(paper, scene), ...travel(paper, scene)]) write(paper, room, name, places, color ?? theme.text);
  extents(paper, room, scene);
  for (const mark of marks) {
    paper.disc(camera.onScreen(mark.point), 5, { fill: theme[mark.severity] ?? theme.info, color: theme.background });
  }
  // Where the control would stop: a cross.
  for (const alarm of d.alarms) {
    if (!alarm.at) continue;
    const [x, y] = camera.onScreen(alarm.at), style = { color: theme.error, width: 3 };
    paper.line([[x - 6, y - 6], [x + 6, y + 6]], style);
    paper.line([[x - 6, y + 6], [x + 6, y - 6]], style);
  }
  if (isPart && !toolShape(paper, scene)) {
    const p = camera.onScreen(tip), up = d.lathe ? [1, 0, 0] : [0, 0, 1];
    paper.disc(p, 6, { color: theme.text, width: 2 });
    paper.line([p, [p[0] + dot(camera.rows[0], up) * 40, p[1] - dot(camera.rows[1], up) * 40]], { color: theme.text, width: 2 });
  }
}
