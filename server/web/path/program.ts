/** The lines of a program in the order in which they are driven, as far as they are known: a window of GET …/blocks?by=segment. A line that is driven twice
 *  is in it twice; segments of a line that follow one another are one visit. Without a program its entries are segments of the document. */

export interface Entry {
  segment: number;
  line?: number; // line of a program
  source?: number; // segment of a document without one
  text?: string | null;
  mode: "cut" | "position";
  start_time: number;
  end_time: number;
  length: number;
  feed: number | null;
  time: number;
}

export interface Page {
  first: number;
  total: number;
  blocks: Entry[];
}

/** One passage of a line: rows [first, end) begin in it. */
export interface Visit {
  number: number; // line of the program, or segment of the document
  text: string | null;
  mode: "cut" | "position";
  first: number;
  end: number;
  length: number;
  time: number;
}

/** Number of segments of a window. */
export const windowSegments = 120;

export class Program {
  private anchors: { index: number; start: number }[] = []; // ascending; starts of segments that have been seen
  private first = 0; // segments of the window
  private count = 0;
  private total = Infinity;
  private asking: AbortController | null = null;
  private wanted: number | null = null;
  visits: Visit[] = [];
  /** Called when there is another window. */
  changed: () => void = () => {};
  /** `rows`: of the series; `cycle`: s; `fetch` answers a page of segments by start. */
  constructor(readonly rows: number, readonly cycle: number, private readonly fetch: (first: number, count: number, signal: AbortSignal) => Promise<Page>) {}

  /** Returns the number of the visit in the window to which a row belongs; -1 if it is not in the window. */
  find(row: number): number {
    const { visits } = this;
    if (visits.length === 0 || row < visits[0]!.first || row >= visits[visits.length - 1]!.end) return -1;
    let low = 0, high = visits.length;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (visits[middle]!.first <= row) low = middle;
      else high = middle;
    }
    return low;
  }
  /** Returns the visit of a row; asks for a window around it where it is not known, or near its end. */
  at(row: number): Visit | null {
    const found = this.find(row), margin = Math.min(20, this.visits.length >> 2);
    const inside = found >= 0 && (found >= margin || this.first === 0) && (found < this.visits.length - margin || this.first + this.count >= this.total);
    if (!inside) this.want(row);
    return found < 0 ? null : this.visits[found]!;
  }
  private want(row: number): void {
    this.wanted = row;
    if (!this.asking) void this.search();
  }
  /** Asks for windows where the row is expected until one has it: between segments whose start is known, starts are taken as evenly spaced. */
  private async search(): Promise<void> {
    const abort = (this.asking = new AbortController());
    try {
      for (let steps = 0; this.wanted !== null && steps < 24; ++steps) {
        const row = this.wanted, time = row * this.cycle;
        const before = [...this.anchors].reverse().find((a) => a.start <= time + 1e-9) ?? { index: 0, start: 0 };
        const after = this.anchors.find((a) => a.start > time + 1e-9) ?? { index: this.total, start: this.rows * this.cycle };
        const share = after.start > before.start ? (time - before.start) / (after.start - before.start) : 0;
        // Where even spacing is a bad guess, halves find it.
        const guess = steps < 6 ? share : 0.5;
        const index = Number.isFinite(after.index) ? Math.floor(before.index + guess * (after.index - before.index)) : 0;
        const first = Math.max(0, Math.min(index - windowSegments / 2, this.total - windowSegments));
        this.take(await this.fetch(Math.max(0, first), windowSegments, abort.signal));
        if (this.wanted === row && this.find(row) >= 0) this.wanted = null;
      }
      this.wanted = null;
    } catch {
      // The list stays as it is; the next move of the cursor asks again.
      this.wanted = null;
    }
    this.asking = null;
    this.changed();
  }
  private take(page: Page): void {
    this.first = page.first;
    this.count = page.blocks.length;
    this.total = page.total;
    const row = (time: number): number => Math.max(0, Math.min(this.rows, Math.ceil(time / this.cycle - 1e-6)));
    this.visits = [];
    for (const entry of page.blocks) {
      const number = entry.line ?? entry.source ?? entry.segment, last = this.visits[this.visits.length - 1];
      if (last && last.number === number && last.mode === entry.mode) {
        last.end = row(entry.end_time);
        last.length += entry.length;
        last.time += entry.time;
      } else {
        this.visits.push({ number, text: entry.text ?? null, mode: entry.mode, first: row(entry.start_time), end: row(entry.end_time), length: entry.length, time: entry.time });
      }
    }
    const last = this.visits[this.visits.length - 1];
    if (last && page.first + page.blocks.length >= page.total) last.end = this.rows;
    const seen = page.blocks.map((entry, i) => ({ index: page.first + i, start: entry.start_time }));
    const ends = seen.length > 1 ? [seen[0]!, seen[seen.length - 1]!] : seen;
    for (const anchor of ends)
      if (!this.anchors.some((a) => a.index === anchor.index)) this.anchors.push(anchor);
    this.anchors.sort((a, b) => a.index - b.index);
    this.changed();
  }
}

/** Returns the tool of every line of a program: the last T word up to it. Comments count for nothing. */
export function toolsOf(program: string): (line: number) => number {
  const changes: { line: number; tool: number }[] = [];
  program.split(/\r\n|\n|\r/).forEach((text, i) => {
    const found = /(?:^|[^A-Za-z])T\s*(\d{1,6})/i.exec(text.replace(/\([^)]*\)|;.*$/g, " "));
    if (found) changes.push({ line: i + 1, tool: Number(found[1]) });
  });
  return (line) => {
    let low = 0, high = changes.length; // changes[low - 1].line ≤ line
    while (low < high) {
      const middle = (low + high) >> 1;
      if (changes[middle]!.line <= line) low = middle + 1;
      else high = middle;
    }
    return low === 0 ? 0 : changes[low - 1]!.tool;
  };
}
