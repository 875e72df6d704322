/** Places in ascending rows, times or lengths. */

/** Returns how many of ascending values are at most `value`. */
export function countAtMost(ascending: ArrayLike<number>, value: number): number {
  let low = 0, high = ascending.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (ascending[middle]! <= value) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** Returns the last k with ascending[k] <= value, -1 where there is none. */
export const lastAtMost = (ascending: ArrayLike<number>, value: number): number => countAtMost(ascending, value) - 1;
