/** The ribbon of limits: the share of time of each limit in each interval, one above the other. */
import type { Limit } from "../base/planned_job";
import type { Palette } from "../base/canvas";
import { begin } from "./picture";

export interface Shares {
  limits: readonly Limit[];
  index: readonly number[]; // first row of each interval
  shares: readonly (readonly number[])[]; // per limit, per interval
  end: number; // row behind the last
}

/** Draws shares from `top` with `height` px; `x` is the place of a row. `faded` limits are drawn pale: all but the one that is looked at. Returns the number of
 *  rectangles. */
export function fillShares(context: CanvasRenderingContext2D, { limits, index, shares, end }: Shares, x: (row: number) => number, top: number, height: number,
                           colours: Map<number, string>, palette: Palette, only: number | null): number {
  let drawn = 0;
  // States without a limit lie above, so that limits stand on the ground.
  const order = [...limits].sort((a, b) => Number(a.id < 3) - Number(b.id < 3) || a.id - b.id);
  const filled = index.map(() => 0);
  for (const limit of order) {
    const own = shares[limit.id];
    if (!own || !own.some((share) => share > 0)) continue;
    context.fillStyle = palette.of(colours.get(limit.id) ?? "--rapid");
    context.globalAlpha = only === null || only === limit.id ? 1 : 0.2;
    for (let i = 0; i < index.length; ) {
      const share = own[i]!, base = filled[i]!;
      if (share <= 0) {
        ++i;
        continue;
      }
      // Neighbours that look the same are one rectangle.
      let last = i;
      while (last + 1 < index.length && own[last + 1] === share && filled[last + 1] === base) filled[last++]! += share;
      filled[last]! += share;
      const left = x(index[i]!), right = x(index[last + 1] ?? end);
      context.fillRect(left, top + height * (1 - base - share), Math.max(0.6, right - left), height * share);
      ++drawn;
      i = last + 1;
    }
  }
  context.globalAlpha = 1;
  return drawn;
}

export function drawRibbon(canvas: HTMLCanvasElement, parts: readonly Shares[], x: (row: number) => number, left: number, right: number, colours: Map<number, string>,
                           palette: Palette, only: number | null): number {
  const picture = begin(canvas);
  if (!picture) return 0;
  const { context, width, height, snap } = picture, place = (row: number): number => snap(x(row));
  context.save();
  context.beginPath();
  context.rect(left, 0, width - left - right, height);
  context.clip();
  let drawn = 0;
  for (const part of parts) {
    // Finer data replace what lies below.
    context.clearRect(place(part.index[0] ?? 0), 0, place(part.end) - place(part.index[0] ?? 0), height);
    drawn += fillShares(context, part, place, 0, height, colours, palette, only);
  }
  context.restore();
  return drawn;
}

/** Draws the whole job with a window on the rows that are shown. */
export function drawOverview(canvas: HTMLCanvasElement, whole: Shares | null, total: number, first: number, count: number, left: number, right: number,
                             colours: Map<number, string>, palette: Palette): number {
  const picture = begin(canvas);
  if (!picture) return 0;
  const { context, width, height, snap } = picture, span = width - left - right;
  const x = (row: number): number => snap(left + (row / total) * span);
  const drawn = whole ? fillShares(context, whole, x, 3, height - 6, colours, palette, null) : 0;
  const from = x(first), to = Math.max(from + 3, x(first + count));
  context.fillStyle = palette.of("--back");
  context.globalAlpha = 0.72;
  context.fillRect(left, 0, from - left, height);
  context.fillRect(to, 0, width - right - to, height);
  context.globalAlpha = 1;
  context.strokeStyle = palette.of("--text");
  context.lineWidth = 1.5;
  context.strokeRect(from + 0.75, 0.75, Math.max(1, to - from - 1.5), height - 1.5);
  return drawn;
}
