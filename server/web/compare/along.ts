/** Where time is won or lost along a path: two motions over their way, and the difference of their times. */

/** A motion over its way: at way[k], which never falls, time[k] has passed. */
export interface Along {
  way: Float64Array;
  time: Float64Array;
  length: number;
  duration: number;
}

/** Returns a motion over its way from the way s at the first row of each interval, and at the end of the series. */
export function alongPath(rows: ArrayLike<number>, cycle: number, s: ArrayLike<number>, end: { row: number; s: number }): Along {
  const count = rows.length, way = new Float64Array(count + 1), time = new Float64Array(count + 1);
  let most = -Infinity;
  for (let k = 0; k < count; ++k) {
    // Rounding to four bytes must not make the way fall.
    most = Math.max(most, s[k]!);
    way[k] = most;
    time[k] = rows[k]! * cycle;
  }
  way[count] = Math.max(most, end.s);
  time[count] = end.row * cycle;
  return { way, time, length: way[count]! - way[0]!, duration: time[count]! };
}

/** Returns the way at the first row of each interval by the speeds in the intervals: their mean counts. For motions that come without a column s. */
export function integrated(rows: ArrayLike<number>, cycle: number, low: ArrayLike<number>, high: ArrayLike<number>, lastRow: number): { s: Float64Array; end: number } {
  const s = new Float64Array(rows.length);
  let sum = 0;
  for (let k = 0; k < rows.length; ++k) {
    s[k] = sum;
    const next = k + 1 < rows.length ? rows[k + 1]! : lastRow, here = (low[k]! + high[k]!) / 2;
    // A row's speed goes over to that of the next one.
    const single = low[k] === high[k] && k + 1 < rows.length && low[k + 1] === high[k + 1];
    sum += (single ? (here + low[k + 1]!) / 2 : here) * (next - rows[k]!) * cycle;
  }
  return { s, end: sum };
}

/** Returns the time, s, at which a motion is first so far along its way. */
export function timeAt({ way, time }: Along, at: number): number {
  let low = 0, high = way.length - 1;
  if (at <= way[0]!) return time[0]!;
  if (at > way[high]!) return time[high]!;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (way[middle]! < at) low = middle;
    else high = middle;
  }
  const width = way[high]! - way[low]!;
  return width > 0 ? time[low]! + ((at - way[low]!) / width) * (time[high]! - time[low]!) : time[low]!;
}

/** Δt along the path: at share[k] of the way b has taken delta[k] s more than a. The last one is at the end, rests included. */
export interface Difference {
  share: Float64Array;
  delta: Float64Array;
}

export function difference(a: Along, b: Along, cells: number): Difference {
  const share = new Float64Array(cells + 1), delta = new Float64Array(cells + 1);
  for (let k = 0; k <= cells; ++k) {
    share[k] = k / cells;
    delta[k] = timeAt(b, b.way[0]! + share[k]! * b.length) - timeAt(a, a.way[0]! + share[k]! * a.length);
  }
  delta[cells] = b.duration - a.duration;
  return { share, delta };
}

/** A stretch of the path on which one of both is faster all the time. */
export interface Place {
  from: number; // share of the way
  to: number;
  gain: number; // s that b takes more than a there; negative: b is faster
}

/** Returns the stretches that win or lose most, in the order of their size. Steps of less than a fiftieth of the mean one count to none; a stretch ends where
 *  it wins or loses less than a quarter of what it does at its best. */
export function places({ share, delta }: Difference, most: number): Place[] {
  let all = 0;
  for (let k = 1; k < delta.length; ++k) all += Math.abs(delta[k]! - delta[k - 1]!);
  const noise = (0.02 * all) / Math.max(1, delta.length - 1), list: Place[] = [];
  let current: Place | null = null, peak = 0;
  for (let k = 1; k < delta.length; ++k) {
    const step = delta[k]! - delta[k - 1]!;
    if (Math.abs(step) <= noise) {
      current = null;
    } else if (current && current.gain < 0 === step < 0 && Math.abs(step) >= 0.25 * peak) {
      current.to = share[k]!;
      current.gain += step;
      peak = Math.max(peak, Math.abs(step));
    } else {
      current = { from: share[k - 1]!, to: share[k]!, gain: step };
      peak = Math.abs(step);
      list.push(current);
    }
  }
  return list.sort((a, b) => Math.abs(b.gain) - Math.abs(a.gain)).slice(0, most);
}

/** Returns whether two paths are so equally long that their ways can be laid upon each other in mm: a thousandth is what rounded corners make. */
export const sameLength = (a: Along, b: Along): boolean => Math.abs(a.length - b.length) <= 1e-3 * Math.max(a.length, b.length);
