// The part of a path that an edit took away.
//
// Knows: points and kinds of two paths. Must not know: text, how anything is drawn.

import { KIND } from "./data.js";

/**
 * The moves of the path `before` that the path `now` does not have, with their ends: { points, kinds, count }; null where there
 * are none, undefined where both paths are the same. Of a path that is thinned nobody knows which moves are the same: null.
 */
export function formerOf(before, now) {
  if (before.thinned || now.thinned) return null;
  const most = Math.min(before.count, now.count);
  const isSame = (i, j) => before.kinds[i] === now.kinds[j] && before.points[3 * i] === now.points[3 * j]
    && before.points[3 * i + 1] === now.points[3 * j + 1] && before.points[3 * i + 2] === now.points[3 * j + 2];
  let first = 0, after = 0;
  while (first < most && isSame(first, first)) first++;
  if (first === before.count && first === now.count) return undefined;
  while (after < most - first && isSame(before.count - 1 - after, now.count - 1 - after)) after++;
  // With the point that leads there, and the one that leads on.
  const begin = Math.max(first - 1, 0), end = Math.min(before.count - after + 1, before.count);
  if (end - begin < 2) return null;
  const kinds = before.kinds.slice(begin, end);
  kinds[0] = KIND.START;
  return { points: before.points.slice(3 * begin, 3 * end), kinds, count: end - begin };
}
