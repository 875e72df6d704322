/** Where a limit holds: stretches of the overview. */
export interface Stretch {
  first: number; // row
  count: number; // rows
}

/** Returns the longest run of neighbouring intervals in which a limit has at least half of the time, or as much as it has anywhere if that is less. `index`
 *  has the first row of each interval, `end` is the row behind the last. Null where it has no time. */
export function longestStretch(index: readonly number[], shares: readonly number[], end: number): Stretch | null {
  const most = shares.reduce((a, b) => Math.max(a, b), 0), least = Math.min(0.5, most);
  if (most === 0) return null;
  let best: Stretch | null = null;
  for (let i = 0; i < shares.length; ) {
    if (shares[i]! < least) {
      ++i;
      continue;
    }
    let last = i;
    while (last + 1 < shares.length && shares[last + 1]! >= least) ++last;
    const first = index[i]!, count = (index[last + 1] ?? end) - first;
    if (!best || count > best.count) best = { first, count };
    i = last + 1;
  }
  return best;
}

/** Returns rows around a stretch: three times as many, so that what comes before and behind is seen, too. */
export function around(stretch: Stretch): Stretch {
  const count = Math.max(20, stretch.count * 3);
  return { first: Math.round(stretch.first - (count - stretch.count) / 2), count };
}
