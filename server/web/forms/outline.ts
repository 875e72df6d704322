/** The outline of a checked document on a canvas: cuts as lines, positioning moves dashed. */
import { sharp, styleColour } from "../base/canvas";
import { h } from "../base/dom";

export interface Outline {
  vertices: number[][];
  cut?: number[];
}

/** Where a point of the document lies in the picture: x to the right, y up, z, if there is one, obliquely. */
export function project(vertex: number[]): [number, number] {
  const [x = 0, y = 0, z = 0] = vertex;
  return vertex.length < 3 ? [x, y] : [x + y * 0.4, z + y * 0.35];
}

/** Returns scale and offsets that fit all points into width × height with a margin. */
export function fitting(points: readonly [number, number][], width: number, height: number, margin: number): { scale: number; left: number; bottom: number } {
  let [minX, maxX, minY, maxY] = [Infinity, -Infinity, Infinity, -Infinity];
  for (const [x, y] of points) {
    minX = Math.min(minX, x), maxX = Math.max(maxX, x);
    minY = Math.min(minY, y), maxY = Math.max(maxY, y);
  }
  const scale = Math.min((width - 2 * margin) / Math.max(maxX - minX, 1e-9), (height - 2 * margin) / Math.max(maxY - minY, 1e-9));
  return { scale, left: (width - scale * (minX + maxX)) / 2, bottom: (height + scale * (minY + maxY)) / 2 };
}

export class OutlineView {
  readonly canvas = h("canvas", { role: "img", class: "outline" });
  private outline: Outline | null = null;
  constructor(private readonly label: (segments: number) => string) {
    new ResizeObserver(() => this.draw()).observe(this.canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
  }
  show(outline: Outline | null): void {
    this.outline = outline;
    this.canvas.hidden = outline === null;
    this.canvas.setAttribute("aria-label", this.label(outline ? Math.max(0, outline.vertices.length - 1) : 0));
    this.draw();
  }
  private draw(): void {
    const { canvas, outline } = this, width = canvas.clientWidth, height = canvas.clientHeight;
    if (!outline || outline.vertices.length === 0) return;
    const context = sharp(canvas, width, height);
    if (!context) return;
    const points = outline.vertices.map(project), { scale, left, bottom } = fitting(points, width, height, 12);
    const line = (on: boolean): void => {
      context.beginPath();
      points.forEach(([x, y], i) => {
        const [px, py] = [left + scale * x, bottom - scale * y];
        if (i > 0 && (outline.cut?.[i] ?? 1) === (on ? 1 : 0)) context.lineTo(px, py);
        else context.moveTo(px, py);
      });
      context.strokeStyle = styleColour(on ? "--c0" : "--rapid");
      context.setLineDash(on ? [] : [4, 4]);
      context.lineWidth = on ? 1.6 : 1;
      context.stroke();
    };
    line(false);
    line(true);
    const [x, y] = points[0]!;
    context.beginPath();
    context.arc(left + scale * x, bottom - scale * y, 3.5, 0, 7);
    context.fillStyle = styleColour("--c1");
    context.fill();
  }
}
