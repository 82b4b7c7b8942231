// Work on a rotary axis: the tool goes around the part as the axis turns, or the part is unrolled.
//
// Knows: points, angles of one axis that turns about X, Y or Z through the zero of the program. Must not know: machines, how
// anything is drawn.

import { KIND } from "./data.js";

/** Degrees of a turn that are drawn as a straight line. */
const STEP = 4;
/** Points that a picture of turns may have. */
const MOST = 3e6;

/** By the letter of the axis: the linear axis that it turns about, and the two that it turns, from the first towards the second. */
const ABOUT = { A: [0, 1, 2], B: [1, 2, 0], C: [2, 0, 1] };

/** The one axis that turns, as an index in `rotary.axes`; null where none turns or several do. */
function turning(d) {
  if (!d.rotary || !d.count) return null;
  const { axes, values } = d.rotary;
  const moving = [...axes].flatMap((axis, k) => {
    let first = NaN;
    for (let i = 0; i < d.count; i++) {
      const value = values[k * d.count + i];
      if (!Number.isFinite(value)) continue;
      if (Number.isNaN(first)) first = value;
      else if (value !== first) return [k];
    }
    return [];
  });
  return moving.length === 1 && ABOUT[axes[moving[0]]] ? moving[0] : null;
}

/** The ways in which the axis can be drawn: names and words; none where no axis, or more than one, turns. */
export function rotaryWays(d) {
  const k = turning(d);
  if (k === null) return [];
  const axis = d.rotary.axes[k];
  return [["still", `${axis} does not turn`], ["around", `${axis} around the part`], ["unrolled", `${axis} unrolled`]];
}

/** How far from the axis cuts are at most. */
function radiusOf(d, [, u, v]) {
  let most = 0;
  for (let i = 1; i < d.count; i++) {
    if (d.kinds[i] !== KIND.START && d.kinds[i] !== KIND.RAPID) most = Math.max(most, Math.hypot(d.points[3 * i + u], d.points[3 * i + v]));
  }
  return most;
}

/**
 * The data with the axis drawn in a way of `rotaryWays`; the same data for `still` and where there is no such way. A move that
 * turns becomes several pieces. `own` has the points as the program has them.
 */
export function drawnWith(d, way) {
  const k = turning(d);
  if (k === null || (way !== "around" && way !== "unrolled")) return d;
  const angles = d.rotary.values.subarray(k * d.count, (k + 1) * d.count), about = ABOUT[d.rotary.axes[k]], [, u, v] = about;
  const isTurn = (i) => i > 0 && d.kinds[i] !== KIND.START && Number.isFinite(angles[i - 1]) && Number.isFinite(angles[i]);
  let count = 0, step = STEP;
  const partsOf = (i) => isTurn(i) ? Math.max(Math.ceil(Math.abs(angles[i] - angles[i - 1]) / step), 1) : 1;
  for (;;) {
    count = 0;
    for (let i = 0; i < d.count; i++) count += partsOf(i);
    if (count <= MOST || step > 360) break;
    step *= 2;
  }
  const like = (array, width = 1) => array && new array.constructor(count * width);
  const one = ["seconds", "lines", "kinds", "toolOf", "fileOf", "driveOf", "callOf"];
  const made = { ...d, count, points: like(d.points, 3), own: like(d.points, 3), ...Object.fromEntries(one.map((name) => [name, like(d[name])])) };
  const values = new Float32Array(count * d.rotary.axes.length), radius = radiusOf(d, about);
  const box = () => [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]], all = box(), cut = box();
  const widen = (ends, to) => {
    for (let c = 0; c < 3; c++) {
      ends[0][c] = Math.min(ends[0][c], made.points[3 * to + c]);
      ends[1][c] = Math.max(ends[1][c], made.points[3 * to + c]);
    }
  };
  let to = 0, known = 0;
  for (let i = 0; i < d.count; i++) {
    const parts = partsOf(i), before = Math.max(i - 1, 0);
    for (let part = 1; part <= parts; part++, to++) {
      const done = part / parts, mix = (a, b) => parts === 1 ? b : a + (b - a) * done;
      for (const name of one) if (made[name]) made[name][to] = d[name][i];
      made.seconds[to] = mix(d.seconds[before], d.seconds[i]);
      for (let c = 0; c < 3; c++) made.own[3 * to + c] = made.points[3 * to + c] = mix(d.points[3 * before + c], d.points[3 * i + c]);
      for (let axis = 0; axis < d.rotary.axes.length; axis++) values[axis * count + to] = mix(d.rotary.values[axis * d.count + before], d.rotary.values[axis * d.count + i]);
      const angle = values[k * count + to];
      // An angle that nobody knows is drawn as the one before.
      if (Number.isFinite(angle)) known = angle;
      const turn = known * Math.PI / 180, [a, b] = [made.own[3 * to + u], made.own[3 * to + v]];
      if (way === "around") {
        made.points[3 * to + u] = a * Math.cos(turn) - b * Math.sin(turn);
        made.points[3 * to + v] = a * Math.sin(turn) + b * Math.cos(turn);
      } else if (Math.abs(b) >= Math.abs(a)) made.points[3 * to + u] = a - radius * turn;
      else made.points[3 * to + v] = b + radius * turn;
    }
  }
  for (let i = 1; i < count; i++) {
    if (made.kinds[i] === KIND.START) continue;
    for (const end of [i - 1, i]) {
      widen(all, end);
      if (made.kinds[i] !== KIND.RAPID) widen(cut, end);
    }
  }
  const filled = (ends) => ends[0][0] <= ends[1][0] ? ends : null;
  // Places that belong to no moment of the run have no angle.
  const alarms = d.alarms.map((alarm) => ({ ...alarm, at: null }));
  return { ...made, rotary: { axes: d.rotary.axes, values }, all: filled(all), cut: filled(cut), alarms, zeros: [], travel: [null, null] };
}
