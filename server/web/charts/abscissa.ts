/** What charts are drawn over: time, a master's angle, or the length of the path. */
import type { ChartData } from "./chart_data";
import type { Envelope } from "./intervals";

/** Maps rows, also between two, to values that never fall, and back. */
export interface Abscissa {
  value(row: number): number;
  row(value: number): number;
}

/** Returns the one that is proportional to the rows. */
export const proportional = (step: number): Abscissa => ({ value: (row) => row * step, row: (value) => value / step });

/** Returns the path length over rows [from, to) from the envelope of its column, which is the value at the first row of each interval. Null where it has not come. */
export function pathLength(data: ChartData, from: number, to: number, column = "s"): Abscissa | null {
  const parts = data.parts(column, from, to);
  const envelope: Envelope | undefined = parts.length === 1 ? parts[0]!.envelope : parts.find((part) => part.envelope === data.whole)?.envelope ?? parts[0]?.envelope;
  if (!envelope || envelope.intervals === 0) return null;
  const n = envelope.intervals, at = (i: number): number => (i < n ? envelope.least(i, column) : envelope.most(n - 1, column));
  return {
    value(row) {
      const i = envelope.find(row), begin = envelope.row(i), end = envelope.row(i + 1);
      const share = end > begin ? Math.max(0, Math.min(1, (row - begin) / (end - begin))) : 0;
      return at(i) + share * (at(i + 1) - at(i));
    },
    row(value) {
      let low = 0, high = n;
      while (low < high) {
        const middle = (low + high) >> 1;
        if (at(middle + 1) >= value) high = middle;
        else low = middle + 1;
      }
      const i = Math.min(low, n - 1), span = at(i + 1) - at(i);
      const share = span > 0 ? Math.max(0, Math.min(1, (value - at(i)) / span)) : 0;
      return envelope.row(i) + share * (envelope.row(i + 1) - envelope.row(i));
    },
  };
}
