/** Rows of the series around the playback, fetched ahead: what moves is drawn where the setpoints are, not on chords of the picture. */

export interface Slice {
  first: number;
  every: number; // rows from one to the next
  count: number;
  values: Float32Array; // row-major
  names: readonly string[];
}

/** Most rows from the first to the last one of a slice. */
export const sliceRows = 16384;

/** Returns the values at a row, linear between two rows of the slice; null outside it. Writes into `out`. */
export function valuesAt(slice: Slice, row: number, out: Float64Array): Float64Array | null {
  const place = (row - slice.first) / slice.every;
  if (!(place >= 0) || place > slice.count - 1) return null;
  const width = slice.names.length, i = Math.min(Math.floor(place), Math.max(slice.count - 2, 0)), u = place - i;
  for (let k = 0; k < width; ++k) {
    const a = slice.values[i * width + k]!;
    out[k] = u === 0 ? a : a + u * (slice.values[(i + 1) * width + k]! - a);
  }
  return out;
}

/** Returns the step from row to row of a slice for a playback of so many rows a second: four of them in a frame of 1/60 s are enough. */
export const stepFor = (rate: number): number => Math.max(1, Math.floor(rate / 240));

/** Keeps the slice that is played and the one after it. `fetch` answers rows first, first + every, …; at most one request runs at a time. */
export class Slices {
  private held: Slice[] = [];
  private rest = 0; // frames without a request after one that failed
  private running: { first: number; every: number; abort: AbortController } | null = null;
  constructor(
    private readonly total: number,
    private readonly fetch: (first: number, every: number, count: number, signal: AbortSignal) => Promise<Slice>,
  ) {}
  /** Returns the slice that has a row, and asks for what is needed next at this rate, rows a second. A slice that would be played in less than a second is
   *  not worth a request: the chords of the picture do then. */
  at(row: number, rate: number): Slice | null {
    const found = this.held.find((s) => row >= s.first && row <= s.first + (s.count - 1) * s.every) ?? null;
    if (this.rest > 0) --this.rest;
    else if (rate <= sliceRows) {
      const every = stepFor(rate);
      if (!found) this.ask(Math.max(0, Math.floor(row) - 64 * every), every);
      else {
        const end = found.first + (found.count - 1) * found.every;
        if (row > end - (sliceRows * 2) / 3 && end < this.total - 1 && !this.held.some((s) => s.first <= end && s.first + (s.count - 1) * s.every > end))
          this.ask(end, every);
      }
    }
    return found;
  }
  /** Returns the newest slice that has a row, without asking for any. */
  peek(row: number): Slice | null {
    return this.held.find((s) => row >= s.first && row <= s.first + (s.count - 1) * s.every) ?? null;
  }
  /** Asks for the rows around one, all of them. */
  async around(row: number): Promise<void> {
    const first = Math.max(0, row - 128), abort = new AbortController();
    try {
      const slice = await this.fetch(first, 1, Math.min(257, this.total - first), abort.signal);
      this.held = [slice, ...this.held].slice(0, 3);
    } catch {
      // Places between vertices of the picture do.
    }
  }
  private ask(first: number, every: number): void {
    if (this.running) {
      const end = this.running.first + sliceRows;
      if (first >= this.running.first && first < end) return;
      this.running.abort.abort();
    }
    const count = Math.max(1, Math.min(Math.floor(sliceRows / every), Math.floor((this.total - 1 - first) / every) + 1));
    const mine = { first, every, abort: new AbortController() };
    this.running = mine;
    this.fetch(first, every, count, mine.abort.signal).then(
      (slice) => {
        this.held = [slice, ...this.held].slice(0, 3);
        if (this.running === mine) this.running = null;
      },
      () => {
        // The chords of the picture are shown meanwhile.
        if (this.running !== mine) return;
        this.running = null;
        this.rest = 120;
      },
    );
  }
}
