/** Vertices of a path, as GET /v1/jobs/{id}/path answers them in f32: a row is a vertex, and every row left out lies within the tolerance of its chord. */
import type { Extents } from "./projection";

export interface PathData {
  count: number;
  rows: Uint32Array; // ascending
  begin: Uint8Array; // 1 where a polyline begins: no chord leads to this vertex
  x: Float32Array;
  y: Float32Array;
  z: Float32Array; // zeros in the plane
  columns: Record<string, Float32Array>; // v, mode, block, line, limit, use: those asked for
  dimension: 2 | 3;
  tolerance: number; // mm
}

/** Returns the vertices of an answer. `names`: its columns, row and begin first. */
export function readPath(names: readonly string[], bytes: ArrayBuffer, tolerance: number): PathData {
  const width = names.length, count = Math.floor(bytes.byteLength / 4 / width);
  const floats = new Float32Array(bytes), whole = new Uint32Array(bytes);
  const column = (k: number): Float32Array => {
    const out = new Float32Array(count);
    for (let i = 0; i < count; ++i) out[i] = floats[i * width + k]!;
    return out;
  };
  const rows = new Uint32Array(count), begin = new Uint8Array(count);
  for (let i = 0; i < count; ++i) {
    rows[i] = whole[i * width]!;
    begin[i] = floats[i * width + 1]! === 0 ? 0 : 1;
  }
  const of = (name: string): Float32Array => (names.includes(name) ? column(names.indexOf(name)) : new Float32Array(count));
  const columns: Record<string, Float32Array> = {};
  names.forEach((name, k) => k >= 2 && !["x", "y", "z"].includes(name) && (columns[name] = column(k)));
  return { count, rows, begin, x: of("x"), y: of("y"), z: of("z"), columns, dimension: names.includes("z") ? 3 : 2, tolerance };
}

/** Returns the extents of all vertices. */
export function extentsOf(path: PathData): Extents {
  const range = (values: Float32Array): [number, number] => {
    let low = Infinity, high = -Infinity;
    for (const v of values) {
      if (v < low) low = v;
      if (v > high) high = v;
    }
    return low <= high ? [low, high] : [0, 0];
  };
  const [x0, x1] = range(path.x), [y0, y1] = range(path.y), [z0, z1] = range(path.z);
  return { low: [x0, y0, z0], high: [x1, y1, z1] };
}

/** Returns the last vertex whose row is at most `row`; 0 before the first one. */
export function vertexBefore(path: PathData, row: number): number {
  let low = 0, high = path.count; // rows[low] ≤ row < rows[high]
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (path.rows[middle]! <= row) low = middle;
    else high = middle;
  }
  return low;
}

/** Returns the place at a row between two vertices, evenly spaced over the rows of their chord. A row between two polylines is not in the picture: null. */
export function placeAt(path: PathData, row: number): [number, number, number] | null {
  if (path.count === 0) return null;
  const i = vertexBefore(path, row), j = i + 1;
  if (row < path.rows[i]!) return null;
  if (j >= path.count || path.rows[i] === row) return row - path.rows[i]! < 1 ? [path.x[i]!, path.y[i]!, path.z[i]!] : null;
  if (path.begin[j]) return row - path.rows[i]! < 1 ? [path.x[i]!, path.y[i]!, path.z[i]!] : null;
  const u = (row - path.rows[i]!) / (path.rows[j]! - path.rows[i]!);
  return [path.x[i]! + u * (path.x[j]! - path.x[i]!), path.y[i]! + u * (path.y[j]! - path.y[i]!), path.z[i]! + u * (path.z[j]! - path.z[i]!)];
}

/** Returns the mean speed on the chord to each vertex, mm/s: the speed at vertices would be that of corners. `cycle`: time from row to row, s. */
export function chordSpeeds(path: PathData, cycle: number): Float32Array {
  const out = new Float32Array(path.count);
  for (let i = 1; i < path.count; ++i)
    if (!path.begin[i])
      out[i] = Math.hypot(path.x[i]! - path.x[i - 1]!, path.y[i]! - path.y[i - 1]!, path.z[i]! - path.z[i - 1]!) / ((path.rows[i]! - path.rows[i - 1]!) * cycle);
  return out;
}
