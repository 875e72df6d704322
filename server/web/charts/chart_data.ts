/** The numbers that charts draw: an overview of all rows, and finer ones of the rows that are shown. A zoom step costs two requests; those of an earlier
 *  step that have not been answered are given up. */
import { getColumns } from "../base/api";
import { askLimits, type LimitsAnswer, type PlannedJob } from "../base/planned_job";
import { Delay } from "../base/work";
import { sourceOf } from "./columns";
import { Envelope } from "./intervals";

const mostPoints = 384; // 32 rows each are read at most: four chunks of 4096
const mostNumbers = 22_000; // of 4 bytes
const patience = 90; // ms; a step that follows another one sooner waits for the last of them before finer data are asked for
const restAfter = 150; // ms that a cursor stays before exact rows are asked for
const ribbonPoints = 300;

/** Returns how many intervals to ask for in a picture of so many pixels, with so many columns. */
export function pointsFor(pixels: number, columns: number): number {
  return Math.max(50, Math.min(mostPoints, Math.round(pixels), Math.floor(mostNumbers / (1 + 2 * columns))));
}

export class ChartData {
  whole: Envelope | null = null;
  detail: Envelope | null = null;
  wholeLimits: LimitsAnswer | null = null;
  detailLimits: (LimitsAnswer & { first: number; end: number }) | null = null;
  failed = false;
  private columns: string[] = [];
  private abort: AbortController | null = null;
  private readonly delay = new Delay(patience);
  private wanted = -Infinity; // time of the last step, ms
  /** `changed` is called after new numbers have come; `pixels` returns the width of the pictures. */
  constructor(private readonly job: PlannedJob, private readonly pixels: () => number, private readonly changed: () => void) {
    void job.limits().then((answer) => {
      this.wholeLimits = answer;
      changed();
    });
  }

  /** Asks for what the shown rows and columns need and is not there: at once for a single step, and after the last one of a row of steps. */
  want(columns: string[], atOnce = false): void {
    const now = performance.now(), single = now - this.wanted > patience;
    this.wanted = now;
    this.columns = [...new Set(columns.map(sourceOf))];
    this.delay.cancel();
    if (atOnce || single) void this.load();
    else this.delay.start(() => void this.load());
  }

  /** Returns the finest envelope of a column with rows of [from, to), and the rows of it that are to be drawn; coarser ones fill what is left. */
  parts(column: string, from: number, to: number): { envelope: Envelope; from: number; to: number }[] {
    const { whole, detail } = this;
    if (!detail?.has(column) || detail.end <= from || detail.first >= to) return whole?.has(column) ? [{ envelope: whole, from, to }] : [];
    const list = [{ envelope: detail, from: Math.max(from, detail.first), to: Math.min(to, detail.end) }];
    if (!whole?.has(column)) return list;
    if (detail.first > from) list.unshift({ envelope: whole, from, to: detail.first });
    if (detail.end < to) list.push({ envelope: whole, from: detail.end, to });
    return list;
  }

  private async load(): Promise<void> {
    this.abort?.abort();
    this.abort = null;
    const { first, count } = this.job.view.get(), all = count === this.job.rows;
    const has = (envelope: Envelope | null): boolean => envelope !== null && this.columns.every((column) => envelope.has(column));
    if (all && has(this.whole)) {
      this.detail = this.detailLimits = null;
      return this.changed();
    }
    const numbers = !(this.detail && this.detail.first === first && this.detail.end === first + count && has(this.detail));
    const limits = !all && !(this.detailLimits?.first === first && this.detailLimits.end === first + count);
    if (!numbers && !limits) return;
    const abort = (this.abort = new AbortController());
    try {
      const [columns, shares] = await Promise.all([
        numbers ? getColumns(this.query(first, count), abort.signal) : null,
        limits ? askLimits(this.job.id, `points=${ribbonPoints}&first=${first}&count=${count}`, abort.signal) : null,
      ]);
      if (abort.signal.aborted) return;
      this.failed = false;
      if (columns) this.detail = new Envelope(columns, first, first + count, this.job.seconds);
      if (columns && all) [this.whole, this.detail] = [this.detail, null];
      if (all) this.detailLimits = null;
      if (shares) this.detailLimits = { ...shares, first, end: first + count };
    } catch {
      if (abort.signal.aborted) return;
      this.failed = true;
    }
    this.changed();
  }

  private query(first: number, count: number): string {
    const points = pointsFor(this.pixels(), this.columns.length);
    return `/v1/jobs/${this.job.id}/setpoints?format=f32&points=${points}&first=${first}&count=${count}&columns=${this.columns.map(encodeURIComponent).join(",")}`;
  }
}

/** Exact rows around the cursor, so that it can be moved row by row without a request each. */
export class RowWindow {
  private first = 0;
  private rows = 0;
  private width = 1;
  private names: string[] = [];
  private data: Float32Array = new Float32Array();
  private asked = "";
  private readonly delay = new Delay(restAfter);
  constructor(private readonly job: PlannedJob, private readonly changed: () => void) {}
  /** Returns the value of a column in a row; null where it is not there. */
  value(row: number, column: string): number | null {
    const source = sourceOf(column);
    if (source !== column) {
      const from = Math.max(0, Math.min(row, this.job.rows - 2)), a = this.value(from, source), b = this.value(from + 1, source);
      return a === null || b === null ? null : (b - a) / this.job.seconds;
    }
    const place = this.names.indexOf(column);
    return place < 0 || row < this.first || row >= this.first + this.rows ? null : this.data[(row - this.first) * this.width + place]!;
  }
  /** Asks for rows around `row` after a moment, unless they are there. */
  want(row: number, columns: string[]): void {
    columns = [...new Set(columns.map(sourceOf))];
    if (columns.every((column) => this.value(row, column) !== null && this.value(Math.min(row + 1, this.job.rows - 1), column) !== null)) return;
    this.delay.start(() => void this.load(row, columns));
  }
  private async load(row: number, columns: string[]): Promise<void> {
    const first = Math.max(0, row - 64), count = Math.min(this.job.rows - first, 129);
    const query = `/v1/jobs/${this.job.id}/setpoints?format=f32&first=${first}&count=${count}&columns=${columns.map(encodeURIComponent).join(",")}`;
    this.asked = query;
    try {
      const answer = await getColumns(query);
      if (this.asked !== query) return;
      [this.names, this.data, this.width, this.first] = [answer.names, answer.data, answer.names.length, first];
      this.rows = Math.floor(answer.data.length / answer.names.length);
      this.changed();
    } catch {
      // The values of intervals stay.
    }
  }
}
