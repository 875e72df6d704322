/** Envelopes: the least and the largest value of each column in intervals of rows, and what is drawn of them. */
import type { Columns } from "../base/api";
import { sourceOf } from "./columns";

/** A rectangle in the pixels of a picture; `top` is the larger value's. */
export type FillRect = (x: number, top: number, width: number, height: number) => void;

export class Envelope {
  readonly intervals: number;
  private readonly width: number;
  private readonly places: Map<string, number>;
  /** `columns` is the answer with points=; rows [first, end) is what was asked for; `seconds` is the time between two rows, for columns that are differences:
   *  those are known where every interval is one row. */
  constructor(private readonly columns: Columns, readonly first: number, readonly end: number, private readonly seconds = 1) {
    this.width = columns.names.length;
    this.intervals = this.width > 0 ? Math.floor(columns.data.length / this.width) : 0;
    this.places = new Map(columns.names.map((name, place) => [name, place]));
  }
  has(column: string): boolean {
    const source = sourceOf(column);
    return this.places.has(source + "_min") && (source === column || (this.exact && this.intervals > 1));
  }
  /** Returns the first row of an interval; that of the one behind the last is the end. */
  row(interval: number): number {
    return interval >= this.intervals ? this.end : this.columns.data[interval * this.width]!;
  }
  least(interval: number, column: string): number {
    const source = sourceOf(column);
    if (source !== column) return this.difference(interval, source);
    return this.columns.data[interval * this.width + this.places.get(column + "_min")!]!;
  }
  most(interval: number, column: string): number {
    const source = sourceOf(column);
    if (source !== column) return this.difference(interval, source);
    return this.columns.data[interval * this.width + this.places.get(column + "_max")!]!;
  }
  /** Returns the difference to the next row per second; that of the last row is the one before it. */
  private difference(row: number, column: string): number {
    const from = Math.min(row, this.intervals - 2);
    return (this.least(from + 1, column) - this.least(from, column)) / this.seconds;
  }
  /** Returns the interval with a row, the first or last one for rows outside. */
  find(row: number): number {
    let low = 0, high = this.intervals - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.row(middle) <= row) low = middle;
      else high = middle - 1;
    }
    return low;
  }
  /** Returns whether every interval is one row. */
  get exact(): boolean {
    return this.intervals === this.end - this.first;
  }
  /** Returns the least and largest value of the intervals that overlap rows [from, to); null where there are none. */
  range(column: string, from: number, to: number): [number, number] | null {
    if (!this.has(column) || this.intervals === 0 || to <= this.first || from >= this.end) return null;
    let low = Infinity, high = -Infinity;
    for (let i = this.find(from), last = this.find(to - 1); i <= last; ++i) {
      low = Math.min(low, this.least(i, column));
      high = Math.max(high, this.most(i, column));
    }
    return low <= high ? [low, high] : null;
  }
}

export interface Scale {
  x: (row: number) => number; // px
  y: (value: number) => number; // px
}

/** Fills one rectangle per interval of rows [from, to): it reaches from the least to the largest value, is at least `thin` px high and touches the one
 *  before it. `paint(interval)` is called before each. Intervals narrower than a pixel share one rectangle, in the colour of the first. Returns the
 *  number of rectangles. */
export function fillIntervals(envelope: Envelope, column: string, from: number, to: number, scale: Scale, thin: number, fill: FillRect,
                              paint: (interval: number) => void = () => {}): number {
  if (!envelope.has(column) || envelope.intervals === 0 || to <= envelope.first || from >= envelope.end) return 0;
  let drawn = 0, before: [number, number] | null = null;
  const last = envelope.find(to - 1);
  for (let i = envelope.find(from); i <= last; ++drawn) {
    const begin = i, left = scale.x(envelope.row(i));
    let low = Infinity, high = -Infinity, right = left;
    do {
      low = Math.min(low, envelope.least(i, column));
      high = Math.max(high, envelope.most(i, column));
      right = scale.x(envelope.row(++i));
    } while (i <= last && right - left < 1);
    const own: [number, number] = [low, high];
    if (before) {
      low = Math.min(low, before[1]);
      high = Math.max(high, before[0]);
    }
    const top = scale.y(high), height = Math.max(thin, scale.y(low) - top);
    paint(begin);
    fill(left, Math.min(top, top + (scale.y(low) - top - height) / 2), Math.max(1, right - left), height);
    before = own;
  }
  return drawn;
}

/** Calls point() for each row of [from, to) and for its neighbours outside: a line of a picture with few rows. Returns the number of segments. */
export function lineOfRows(envelope: Envelope, column: string, from: number, to: number, scale: Scale, point: (x: number, y: number, interval: number) => void): number {
  if (!envelope.has(column) || envelope.intervals === 0 || to <= envelope.first || from >= envelope.end) return 0;
  const first = Math.max(0, envelope.find(from) - 1), last = Math.min(envelope.intervals - 1, envelope.find(to - 1) + 1);
  for (let i = first; i <= last; ++i) point(scale.x(envelope.row(i)), scale.y(envelope.most(i, column)), i);
  return Math.max(0, last - first);
}

/** Returns [low, high] widened to a readable axis: never empty, with a margin, and 0 kept where it is near. */
export function axisRange(low: number, high: number): [number, number] {
  if (!(high >= low)) return [0, 1];
  const size = Math.max(Math.abs(low), Math.abs(high));
  let span = high - low;
  if (span <= size * 1e-9) span = size > 0 ? size * 0.2 : 1;
  const margin = 0.06 * span;
  const from = low >= 0 && low < 0.4 * span ? 0 : low - margin, to = high <= 0 && -high < 0.4 * span ? 0 : high + margin;
  return to > from ? [from, to] : [from - span / 2, from + span / 2];
}
