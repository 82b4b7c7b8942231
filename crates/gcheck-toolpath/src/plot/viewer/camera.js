// From where the path is seen: turned, shifted, zoomed; without perspective, so that lengths compare.
//
// Knows: points and a rectangle of pixels. Must not know: what is drawn, and on what.

import { cornerOf, cross, dot, minus, turned, unit } from "./geometry.js";

// Rows: what is to the right on the screen, up, and toward the eye.
const S2 = Math.SQRT1_2, S3 = 1 / Math.sqrt(3), S6 = 1 / Math.sqrt(6);
/** Views by name. */
export const VIEWS = {
  top: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
  front: [[1, 0, 0], [0, 0, 1], [0, -1, 0]],
  side: [[0, 1, 0], [0, 0, 1], [1, 0, 0]],
  iso: [[S2, S2, 0], [-S6, S6, 2 * S6], [S3, -S3, S3]],
  lathe: [[0, 0, 1], [1, 0, 0], [0, 1, 0]],
};

const CLOSEST = 1e5, FURTHEST = 1e-4;

/** A camera for a canvas whose size in CSS pixels `size` tells. */
export function createCamera(size) {
  const camera = {
    rows: VIEWS.iso,
    /** The point in the middle. */
    target: [0, 0, 0],
    /** Pixels a millimetre. */
    scale: 1,

    onScreen(p) {
      const v = minus(p, camera.target), [width, height] = size();
      return [width / 2 + dot(camera.rows[0], v) * camera.scale, height / 2 - dot(camera.rows[1], v) * camera.scale];
    },

    /** How far a box goes toward the eye or away from it. */
    depth(box) {
      let far = 1;
      for (let i = 0; i < 8; i++) far = Math.max(far, Math.abs(dot(camera.rows[2], minus(cornerOf(box, i), camera.target))));
      return far * 1.1;
    },

    /** Puts a box into the middle, as large as fits with room for words around it. */
    fit(box) {
      const [width, height] = size();
      camera.target = box[0].map((v, i) => (v + box[1][i]) / 2);
      const reach = [0, 0];
      for (let i = 0; i < 8; i++) {
        const v = minus(cornerOf(box, i), camera.target);
        for (const k of [0, 1]) reach[k] = Math.max(reach[k], Math.abs(dot(camera.rows[k], v)));
      }
      const room = (pixels, words) => pixels / 2 - Math.min(words, 0.14 * pixels);
      const wanted = Math.min(room(width, 75) / Math.max(reach[0], 1e-3), room(height, 45) / Math.max(reach[1], 1e-3));
      camera.scale = Math.min(Math.max(wanted, FURTHEST), 1e4);
    },

    turn(dx, dy, up) {
      const about = camera.rows.map((row) => turned(row, up, -dx * 0.008));
      const tilted = about.map((row) => turned(row, about[0], -dy * 0.008));
      camera.rows = [unit(tilted[0]), unit(cross(tilted[2], tilted[0])), unit(tilted[2])];
    },

    shift(dx, dy) {
      camera.target = camera.target.map((v, i) => v - (camera.rows[0][i] * dx - camera.rows[1][i] * dy) / camera.scale);
    },

    /** The point at a place of the canvas stays there. */
    zoom(factor, x, y) {
      const [width, height] = size(), before = camera.scale;
      camera.scale = Math.min(Math.max(before * factor, FURTHEST), CLOSEST);
      const k = 1 / before - 1 / camera.scale, [right, up] = [(x - width / 2) * k, (height / 2 - y) * k];
      camera.target = camera.target.map((v, i) => v + camera.rows[0][i] * right + camera.rows[1][i] * up);
    },
  };
  return camera;
}
