/** Finds the row of a path below a place in the picture. */
import { at } from "./projection";
import type { PathData } from "./path_data";

export interface Picked {
  row: number; // the nearest whole row, evenly spaced between two vertices
  distance: number; // CSS pixels
}

/** Returns the row of the chord that is nearest to (sx, sy), if it is at most `reach` CSS pixels away. `shown` says of a vertex whether the chord to it is
 *  in the picture. Among chords on top of each other the last one is taken, which is drawn last. */
export function pick(
  path: PathData, matrix: readonly number[], sx: number, sy: number, reach: number, shown: (vertex: number) => boolean = () => true,
): Picked | null {
  let best: Picked | null = null, nearest = reach;
  let x0 = 0, y0 = 0;
  for (let i = 0; i < path.count; ++i) {
    const [x1, y1] = at(matrix, path.x[i]!, path.y[i]!, path.z[i]!);
    if (!path.begin[i] && i > 0 && shown(i)) {
      const dx = x1 - x0, dy = y1 - y0, square = dx * dx + dy * dy;
      const u = square === 0 ? 0 : Math.max(0, Math.min(1, ((sx - x0) * dx + (sy - y0) * dy) / square));
      const distance = Math.hypot(x0 + u * dx - sx, y0 + u * dy - sy);
      if (distance <= nearest) {
        nearest = distance;
        best = { row: Math.round(path.rows[i - 1]! + u * (path.rows[i]! - path.rows[i - 1]!)), distance };
      }
    }
    x0 = x1;
    y0 = y1;
  }
  return best;
}
