// Distances on the path: places that a pick snaps to, and what lies between two of them.
//
// Knows: the data of a drawing. Must not know: the screen, elements of a page.

import { KIND } from "./data.js";
import { between, circleThrough, minus } from "./geometry.js";
import { axesOf, coordinateText, lengthText } from "./words.js";

/** Points of an arc that are looked at for its centre. */
const MOST_CHORDS = 2000;

const pointAt = (d, i) => [d.points[3 * i], d.points[3 * i + 1], d.points[3 * i + 2]];

/** The first and last piece of the arc that a chord is of. */
function arcAround(d, piece) {
  const isSame = (i, j) => d.kinds[i] === KIND.ARC && d.kinds[j] === KIND.ARC && d.lines[i] === d.lines[j] && d.toolOf[i] === d.toolOf[j];
  let [first, last] = [piece, piece];
  while (first > 1 && piece - first < MOST_CHORDS && isSame(first - 1, piece)) first--;
  while (last < d.count - 1 && last - piece < MOST_CHORDS && isSame(last + 1, piece)) last++;
  return [first, last];
}

/** Where a pick on a piece may snap to: { is, words, point }. An arc counts as a whole. */
export function snapsOf(d, piece) {
  if (piece < 1 || piece >= d.count || d.kinds[piece] === KIND.START) return [];
  if (d.kinds[piece] !== KIND.ARC) {
    const [a, b] = [pointAt(d, piece - 1), pointAt(d, piece)];
    return [{ is: "start", words: "start", point: a }, { is: "end", words: "end", point: b }, { is: "middle", words: "middle", point: between(a, b, 0.5) }];
  }
  const [first, last] = arcAround(d, piece), points = [];
  for (let i = first - 1; i <= last; i++) points.push(pointAt(d, i));
  const half = (points.length - 1) / 2, [a, b] = [points[Math.floor(half)], points[Math.ceil(half)]];
  const snaps = [{ is: "start", words: "start", point: points[0] }, { is: "end", words: "end", point: points.at(-1) }];
  const circle = circleThrough(points);
  let middle = between(a, b, 0.5);
  if (circle) {
    // The middle of a chord is inside the circle.
    const out = minus(middle, circle.point);
    out[circle.axis] = 0;
    const far = Math.hypot(...out);
    if (far > 1e-9) middle = middle.map((v, i) => i === circle.axis ? v : circle.point[i] + out[i] / far * circle.radius);
    snaps.push({ is: "centre", words: `centre of the arc, R ${lengthText(circle.radius, d.units)}`, point: circle.point });
  }
  snaps.push({ is: "middle", words: "middle", point: middle });
  return snaps;
}

/** What lies between two points: rows of a name and a value, and the distance. */
export function distanceOf(d, from, to) {
  const way = minus(to, from), unit = d.units === "inch" ? "inch" : "mm";
  const rows = axesOf(d).map((axis) => ({
    name: `Δ${"XYZ"[axis]}${axis === 0 && d.diameter ? " (diameter)" : ""}`, value: `${coordinateText(d, way[axis], axis)} ${unit}`,
  }));
  const distance = `${lengthText(Math.hypot(...way), d.units)} ${unit}`;
  return { rows: [...rows, { name: "distance", value: distance }], distance };
}

/** A point in words. */
export const pointText = (d, point) => axesOf(d).map((axis) => `${"XYZ"[axis]}${coordinateText(d, point[axis], axis)}`).join(" ");

/** Pixels from which a pick snaps. */
const REACH = 14;
/** Centres of arcs that were pointed at last stay to be picked. */
const MOST_CENTRES = 2;

/**
 * The picks and what is between them. `view` has data(), current() (the piece that is chosen or stepped to), onScreen(point),
 * pieceAt(x, y), and changed(state), which hears of every change.
 */
export function createMeasure(view) {
  let isOn = false, picks = [], centres = [], snap = null;
  const d = () => view.data();

  function state() {
    const between = picks.length === 2 ? distanceOf(d(), picks[0].point, picks[1].point) : null;
    return {
      isOn, centres, snap, rows: between?.rows ?? [], distanceText: between?.distance ?? "",
      picks: picks.map((pick) => ({ ...pick, text: pointText(d(), pick.point) })),
    };
  }

  const tell = () => view.changed(state());

  /** The nearest point of a piece on the screen. */
  function alongPiece(piece, x, y) {
    const [from, to] = [pointAt(d(), piece - 1), pointAt(d(), piece)], [a, b] = [view.onScreen(from), view.onScreen(to)];
    const [dx, dy] = [b[0] - a[0], b[1] - a[1]], square = dx * dx + dy * dy;
    const part = square > 0 ? Math.min(Math.max(((x - a[0]) * dx + (y - a[1]) * dy) / square, 0), 1) : 0;
    return { is: "path", words: "on the path", point: between(from, to, part) };
  }

  function snapAt(x, y) {
    const piece = view.pieceAt(x, y), own = piece ? snapsOf(d(), piece) : [];
    const fresh = own.filter(({ is, point }) => is === "centre" && centres.every((other) => minus(other.point, point).some(Boolean)));
    centres = [...centres, ...fresh].slice(-MOST_CENTRES);
    const away = ({ point }) => { const p = view.onScreen(point); return Math.hypot(p[0] - x, p[1] - y); };
    const near = [...own, ...centres].map((one) => ({ one, far: away(one) })).filter(({ far }) => far < REACH).sort((one, other) => one.far - other.far);
    return near[0]?.one ?? (piece ? alongPiece(piece, x, y) : null);
  }

  function add(found) {
    // After two picks a third begins again.
    if (found) picks = [...(picks.length === 2 ? [] : picks), found];
    tell();
    return found !== null && found !== undefined;
  }

  const measure = {
    state,
    start() { isOn = true; picks = []; tell(); },
    stop() { isOn = false; picks = []; centres = []; snap = null; tell(); },
    toggle() { if (isOn) measure.stop(); else measure.start(); },
    pick: (x, y) => add(snapAt(x, y)),
    hover(x, y) { snap = snapAt(x, y); tell(); },
    /** Takes the start, the end, the middle or the centre of the piece that is chosen; false where it has none. */
    take(is) {
      isOn = true;
      return add(snapsOf(d(), view.current()).find((one) => one.is === is));
    },
    /** The picks belong to other data. */
    forget() { picks = []; centres = []; snap = null; if (isOn) tell(); },
  };
  return measure;
}
