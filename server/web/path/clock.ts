/** The clock of a playback: which row is shown at a moment. It is driven by the times of frames, which tests give it. */

/** What a step of the playback is counted in: time of the motion, rows, or lines of the program. */
export type PlayBy = "time" | "row" | "line";

/** Rows and lines that go by in a second at a speed of 1. */
export const rowsPerSecond = 10, linesPerSecond = 1;

export class PlaybackClock {
  private before: number | null = null; // time of the last frame, ms
  playing = false;
  by: PlayBy = "time";
  speed = 1; // 0.1 … 100
  row = 0; // row that is shown, with its fraction
  /** `rows`: number of rows; `cycle`: time from row to row, s. */
  constructor(readonly rows: number, readonly cycle: number) {}

  /** Rows per second of a playback by time or row. */
  get rate(): number {
    return this.by === "row" ? rowsPerSecond * this.speed : this.speed / this.cycle;
  }
  start(): void {
    if (this.row >= this.rows - 1) this.row = 0;
    this.playing = true;
    this.before = null;
  }
  stop(): void {
    this.playing = false;
    this.before = null;
  }
  seek(row: number): void {
    this.row = Math.max(0, Math.min(this.rows - 1, row));
  }
  /** Moves on to the time of a frame, ms. `lineEnd`: row at which the line of the program ends that the row belongs to, and the next one begins; by lines,
   *  each takes the same time, however long it is. Returns the row. A frame that comes late by more than a quarter of a second counts as one of that
   *  length: a page in the background does not jump. */
  tick(now: number, line?: (row: number) => { first: number; end: number } | null): number {
    const seconds = this.before === null ? 0 : Math.min(0.25, Math.max(0, (now - this.before) / 1000));
    this.before = now;
    if (!this.playing) return this.row;
    let left = seconds;
    if (this.by === "line" && line) {
      for (let steps = 0; left > 0 && steps < 64; ++steps) {
        const here = line(this.row);
        if (!here) break;
        const rate = Math.max(here.end - here.first, 1) * linesPerSecond * this.speed;
        const needs = (here.end - this.row) / rate;
        if (needs > left) {
          this.row += left * rate;
          left = 0;
        } else {
          this.row = Math.max(here.end, this.row);
          left -= Math.max(needs, 0);
        }
        if (this.row >= this.rows - 1) break;
      }
    } else {
      this.row += left * this.rate;
    }
    if (this.row >= this.rows - 1) {
      this.row = this.rows - 1;
      this.stop();
    }
    return this.row;
  }
}
