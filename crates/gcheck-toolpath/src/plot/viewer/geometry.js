// Vectors of three numbers, corners of boxes, circles through points.
//
// Knows: numbers. Must not know: what they are coordinates of.

export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const between = (a, b, part) => a.map((v, i) => v + (b[i] - v) * part);
export const unit = (a) => { const size = Math.hypot(...a) || 1; return a.map((v) => v / size); };

/** `v` turned about the unit vector `axis`. */
export function turned(v, axis, angle) {
  const c = Math.cos(angle), s = Math.sin(angle), w = cross(axis, v), k = dot(axis, v) * (1 - c);
  return v.map((x, i) => x * c + w[i] * s + axis[i] * k);
}

/** One of the eight corners of a box: the bits of `i` choose the end on X, Y and Z. */
export const cornerOf = (box, i) => [box[i & 1][0], box[i >> 1 & 1][1], box[i >> 2 & 1][2]];

/** The centre of the circle through three points of a plane; null where they are on a line. */
function flatCentre([ax, ay], [bx, by], [cx, cy]) {
  const [ux, uy, vx, vy] = [bx - ax, by - ay, cx - ax, cy - ay], area = 2 * (ux * vy - uy * vx);
  const [u, v] = [ux * ux + uy * uy, vx * vx + vy * vy];
  if (Math.abs(area) < 1e-9 * Math.max(u, v)) return null;
  return [ax + (vy * u - uy * v) / area, ay + (ux * v - vx * u) / area];
}

/** The centre and radius of the circle or helix about X, Y or Z that all points are on, at the height of the first; or null. */
export function circleThrough(points) {
  if (points.length < 3) return null;
  for (const axis of [2, 1, 0]) {
    const [i, j] = [0, 1, 2].filter((k) => k !== axis), flat = points.map((p) => [p[i], p[j]]);
    const centre = flatCentre(flat[0], flat[Math.floor(flat.length / 3)], flat[Math.floor(flat.length * 2 / 3)]);
    if (!centre) continue;
    const radii = flat.map((p) => Math.hypot(p[0] - centre[0], p[1] - centre[1])), radius = radii[0];
    // Points are told in steps of a ten-thousandth; a spiral is not a circle.
    if (!radii.every((r) => Math.abs(r - radius) < Math.max(2e-3, radius * 1e-4))) continue;
    const point = [...points[0]];
    [point[i], point[j]] = centre;
    return { point, radius, axis };
  }
  return null;
}
