/** Outlines of lines and arcs, as slots come, drawn on a canvas. */
import { type Extent, type Placing, hold } from "./plane";

export interface Edge {
  from?: [number, number]; // a loop begins
  line?: [number, number];
  arc?: { to: [number, number]; center: [number, number]; direction: "ccw" | "cw" };
}

/** Returns the angles, rad, between which an arc runs from a point: `to` is above `from` for ccw, below for cw; equal ends are a full turn. */
export function arcAngles(start: [number, number], { to, center, direction }: NonNullable<Edge["arc"]>): { radius: number; from: number; to: number } {
  const from = Math.atan2(start[1] - center[1], start[0] - center[0]), turn = direction === "ccw" ? 1 : -1;
  let sweep = turn * (Math.atan2(to[1] - center[1], to[0] - center[0]) - from);
  while (sweep <= 1e-12) sweep += 2 * Math.PI;
  while (sweep > 2 * Math.PI + 1e-12) sweep -= 2 * Math.PI;
  return { radius: Math.hypot(start[0] - center[0], start[1] - center[1]), from, to: from + turn * sweep };
}

/** Widens an extent so that it holds an outline; of arcs it takes points every 15 deg. */
export function holdOutline(extent: Extent, edges: Edge[]): void {
  let at: [number, number] = [0, 0];
  for (const edge of edges) {
    if (edge.from) at = edge.from;
    hold(extent, at[0], at[1]);
    if (edge.arc) {
      const arc = arcAngles(at, edge.arc), steps = Math.ceil(Math.abs(arc.to - arc.from) / (Math.PI / 12));
      for (let k = 0; k <= steps; ++k) {
        const angle = arc.from + ((arc.to - arc.from) * k) / steps;
        hold(extent, edge.arc.center[0] + arc.radius * Math.cos(angle), edge.arc.center[1] + arc.radius * Math.sin(angle));
      }
    }
    at = edge.line ?? edge.arc?.to ?? at;
  }
  hold(extent, at[0], at[1]);
}

/** Adds an outline to the context's path. Returns its number of edges. */
export function traceOutline(context: CanvasRenderingContext2D, at: Placing, edges: Edge[]): number {
  let point: [number, number] = [0, 0];
  context.beginPath();
  for (const edge of edges) {
    if (edge.from) {
      point = edge.from;
      context.moveTo(at.x(point[0]), at.y(point[1]));
    }
    if (edge.line) context.lineTo(at.x(edge.line[0]), at.y(edge.line[1]));
    if (edge.arc) {
      const { center, direction } = edge.arc, arc = arcAngles(point, edge.arc);
      // The picture's y points down, so angles change their sign.
      context.arc(at.x(center[0]), at.y(center[1]), arc.radius * at.scale, -arc.from, -arc.to, direction === "ccw");
    }
    point = edge.line ?? edge.arc?.to ?? point;
  }
  return edges.length;
}
