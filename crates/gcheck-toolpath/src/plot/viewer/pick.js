// Which piece of the path is at a place of the screen.
//
// Knows: points, a camera, what is hidden. Must not know: how the path is drawn, what a pick is for.
//
// A pass over all points in plain numbers: a million takes some ten milliseconds, where a picture of as many takes seconds
// without a graphics card.

/** Pixels from which a piece is found. */
const REACH_OF_PICK = 6;

/** The piece nearest to a place, of equally near ones the one in front; 0 for none. `isHidden(i)` leaves a piece out. */
export function pieceNear(d, camera, [width, height], section, isHidden, x, y) {
  const { rows: [right, up, toward], target, scale } = camera, { points, count } = d;
  const [left, top] = [(x - width / 2) / scale, (height / 2 - y) / scale], reach = REACH_OF_PICK / scale;
  const place = (row, i) => row[0] * (points[i] - target[0]) + row[1] * (points[i + 1] - target[1]) + row[2] * (points[i + 2] - target[2]);
  let best = 0, nearest = Infinity, front = -Infinity;
  let [ax, ay] = [0, 0];
  for (let i = 0; i < count; i++) {
    const bx = place(right, 3 * i) - left, by = place(up, 3 * i) - top;
    // Both ends on the same far side.
    const isFar = (ax > reach && bx > reach) || (ax < -reach && bx < -reach) || (ay > reach && by > reach) || (ay < -reach && by < -reach);
    if (i && !isFar && !isHidden(i)) {
      const [dx, dy] = [bx - ax, by - ay], square = dx * dx + dy * dy;
      const part = square > 0 ? Math.min(Math.max(-(ax * dx + ay * dy) / square, 0), 1) : 0;
      // Whole pixels: lines that cross are equally near.
      const away = Math.round(Math.hypot(ax + dx * part, ay + dy * part) * scale);
      if (away <= REACH_OF_PICK && away <= nearest) {
        const z = points[3 * i - 1] + (points[3 * i + 2] - points[3 * i - 1]) * part;
        const near = place(toward, 3 * i - 3) * (1 - part) + place(toward, 3 * i) * part;
        if (z >= section[0] - 1e-3 && z <= section[1] + 1e-3 && (away < nearest || near > front + 1e-6)) {
          best = i;
          nearest = away;
          front = near;
        }
      }
    }
    [ax, ay] = [bx, by];
  }
  return best;
}
