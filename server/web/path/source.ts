/** Where the picture of a path has its vertices from: the whole path once, and a part of it finer, when a part is looked at closely. */
import { getColumns } from "../base/api";
import type { ColourBy } from "./colours";
import { countAtMost } from "../base/search";
import { chordSpeeds, readPath, type PathData } from "./path_data";

export type Box = readonly [number, number, number, number]; // x0, y0, x1, y1, mm

/** Vertices of the whole path; of a part of it, as many as 75 kB hold; of a part that needs single rows, of which the server reads up to 16 for a vertex. */
const wholePoints = 10000, partPoints = 6000, rowPoints = 1200;
/** mm; finer vertices than these are read from single rows. */
const finestLevel = 0.05;
/** Intervals of the series whose limit and use the whole path is coloured by. */
const intervals = 4000;

export interface Part {
  path: PathData;
  box: Box;
  scale: number; // CSS pixels per mm for which it was asked for
}

export const contains = (outer: Box, inner: Box): boolean => outer[0] <= inner[0] && outer[1] <= inner[1] && outer[2] >= inner[2] && outer[3] >= inner[3];

/** Returns a box grown on each side by a share of its size. */
export const grown = (box: Box, share: number): Box => {
  const dx = (box[2] - box[0]) * share, dy = (box[3] - box[1]) * share;
  return [box[0] - dx, box[1] - dy, box[2] + dx, box[3] + dy];
};

/** Returns whether what is shown needs finer vertices than the whole path and the part at hand have: half a pixel is fine enough. */
export function needsPart(whole: PathData, part: Part | null, visible: Box, scale: number): boolean {
  if (whole.tolerance * scale <= 0.5) return false;
  if (!part || !contains(part.box, visible)) return true;
  return part.path.tolerance * scale > 0.5 && scale > part.scale * 1.4;
}

/** Returns the query for a part of the path: within half a pixel, or coarser where that would be more than `partPoints` vertices. Of a curve the number of
 *  vertices grows with the inverse root of the tolerance; how many the whole path has in the box is known. */
export function partQuery(whole: PathData, box: Box, scale: number): string {
  const within = 0.5 / scale;
  if (within < finestLevel) return `points=${rowPoints}`;
  let count = 0;
  for (let i = 0; i < whole.count; ++i)
    if (whole.x[i]! >= box[0] && whole.x[i]! <= box[2] && whole.y[i]! >= box[1] && whole.y[i]! <= box[3]) ++count;
  const coarse = Math.max(whole.tolerance, 1e-6) * (count / partPoints) ** 2;
  return `tolerance=${Math.max(finestLevel, within, coarse).toPrecision(4)}`;
}

/** Writes the columns limit and use of an envelope into those of the vertices: a chord has those of the interval that its middle row lies in. `index`: first
 *  row of each interval. */
export function addIntervals(path: PathData, index: ArrayLike<number>, columns: Record<string, ArrayLike<number>>): void {
  for (const [name, values] of Object.entries(columns)) {
    const out = (path.columns[name] = new Float32Array(path.count));
    for (let i = 0; i < path.count; ++i) {
      const middle = i > 0 && !path.begin[i] ? (path.rows[i - 1]! + path.rows[i]!) / 2 : path.rows[i]!;
      out[i] = values[Math.max(0, countAtMost(index, middle) - 1)]!;
    }
  }
}

export class PathSource {
  private running: AbortController | null = null;
  private all: Promise<PathData> | null = null;
  private colours: Promise<void> | null = null;
  /** `of`: tool or coarse; of a winding the tool's path is that in the frame of its part; `hasLines`: whether the job has blocks of a program or document. */
  constructor(private readonly id: string, readonly of: string, private readonly hasLines: boolean, private readonly cycle: number) {}

  private columns(by: ColourBy): string {
    return ["v", "mode", ...(this.hasLines ? ["block", "line"] : []), ...(by === "limit" || by === "use" ? [by] : [])].join(",");
  }
  private async fetch(query: string, by: ColourBy, signal?: AbortSignal): Promise<PathData> {
    const address = `/v1/jobs/${this.id}/path?format=f32&of=${this.of}&columns=${this.columns(by)}&${query}`;
    const { names, data, headers } = await getColumns(address, signal);
    const path = readPath(names, data.buffer, Number(headers.get("X-Tolerance") ?? 0));
    path.columns.speed = chordSpeeds(path, this.cycle);
    return path;
  }
  /** Returns the whole path. Its limits and uses are asked for where it is coloured by them, and are those of intervals. */
  async whole(by: ColourBy): Promise<PathData> {
    this.all ??= this.fetch(`points=${wholePoints}`, "speed");
    const asked = this.all;
    try {
      const path = await asked;
      if (by === "limit" || by === "use") await (this.colours ??= this.addColours(path));
      return path;
    } catch (error) {
      // The next question asks the service again.
      if (this.all === asked) this.all = this.colours = null;
      throw error;
    }
  }
  private async addColours(path: PathData): Promise<void> {
    const { names, data } = await getColumns(`/v1/jobs/${this.id}/setpoints?format=f32&points=${intervals}&columns=use,limit`);
    const column = (name: string): Float32Array => data.filter((_, i) => i % names.length === names.indexOf(name));
    addIntervals(path, column("index"), { use: column("use_max"), limit: column("limit_max") });
  }
  /** Returns the part of the path in a box; null if a newer question has taken its place. */
  async part(whole: PathData, box: Box, scale: number, by: ColourBy): Promise<Part | null> {
    this.running?.abort();
    const mine = (this.running = new AbortController());
    try {
      const path = await this.fetch(`${partQuery(whole, box, scale)}&box=${box.map((v) => v.toFixed(4)).join(",")}`, by, mine.signal);
      return this.running === mine ? { path, box, scale } : null;
    } catch (error) {
      if (mine.signal.aborted) return null;
      throw error;
    }
  }
  stop(): void {
    this.running?.abort();
    this.running = null;
  }
}
