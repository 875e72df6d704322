/** Where the picture of a path has its vertices from: the whole path once, and a part of it finer, when a part is looked at closely. */
import { ask } from "../base/api";
import type { ColourBy } from "./colours";
import { readPath, type PathData } from "./path_data";

export type Box = readonly [number, number, number, number]; // x0, y0, x1, y1, mm

/** Vertices of an answer: of the whole path, and of a part of it. Of a part the server may read 16 rows for a vertex. */
const wholePoints = 3000, partPoints = 1200;

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

export class PathSource {
  private running: AbortController | null = null;
  /** `of`: tool or coarse; of a winding the tool's path is that in the frame of its part; `hasLines`: whether the job has blocks of a program or document. */
  constructor(private readonly id: string, readonly of: string, private readonly hasLines: boolean) {}

  private columns(by: ColourBy): string {
    return ["v", "mode", ...(this.hasLines ? ["block", "line"] : []), ...(by === "limit" || by === "use" ? [by] : [])].join(",");
  }
  private async fetch(query: string, by: ColourBy, signal?: AbortSignal): Promise<PathData> {
    const address = `/v1/jobs/${this.id}/path?format=f32&of=${this.of}&columns=${this.columns(by)}&${query}`;
    const response = await ask(address, { headers: { Accept: "application/octet-stream" }, ...(signal ? { signal } : {}) });
    const names = (response.headers.get("X-Columns") ?? "").split(",");
    return readPath(names, await response.arrayBuffer(), Number(response.headers.get("X-Tolerance") ?? 0));
  }
  whole(by: ColourBy): Promise<PathData> {
    return this.fetch(`points=${wholePoints}`, by);
  }
  /** Returns the part of the path in a box; null if a newer question has taken its place. */
  async part(box: Box, scale: number, by: ColourBy): Promise<Part | null> {
    this.running?.abort();
    const mine = (this.running = new AbortController());
    try {
      const path = await this.fetch(`points=${partPoints}&box=${box.map((v) => v.toFixed(4)).join(",")}`, by, mine.signal);
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
