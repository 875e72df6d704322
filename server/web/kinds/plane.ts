/** A drawing to scale in a plane: one millimetre is as long across as up. */
import { number } from "../base/numbers";
import { type Pen, Stage } from "./stage";
import { line } from "./chart";

export interface Extent {
  x0: number;
  y0: number;
  x1: number;
  y1: number;
}

export const nothing = (): Extent => ({ x0: Infinity, y0: Infinity, x1: -Infinity, y1: -Infinity });

/** Widens an extent so that it holds a point. */
export function hold(extent: Extent, x: number, y: number, radius = 0): void {
  extent.x0 = Math.min(extent.x0, x - radius);
  extent.y0 = Math.min(extent.y0, y - radius);
  extent.x1 = Math.max(extent.x1, x + radius);
  extent.y1 = Math.max(extent.y1, y + radius);
}

/** Where a point lies in the picture, and how many pixels a millimetre has. */
export interface Placing {
  scale: number;
  x(value: number): number;
  y(value: number): number;
}

/** Returns the placing that shows an extent as large as it fits, in the middle, with y up. */
export function placing(extent: Extent, width: number, height: number, margin = 14): Placing {
  const across = Math.max(extent.x1 - extent.x0, 1e-9), up = Math.max(extent.y1 - extent.y0, 1e-9);
  const scale = Math.min((width - 2 * margin) / across, (height - 2 * margin) / up);
  const left = (width - scale * across) / 2, bottom = (height + scale * up) / 2;
  return { scale, x: (value) => left + scale * (value - extent.x0), y: (value) => bottom - scale * (value - extent.y0) };
}

/** Returns the round length, mm, whose bar has at most so many pixels. */
export function barLength(scale: number, most: number): number {
  const power = Math.pow(10, Math.floor(Math.log10(most / scale)));
  return ([5, 2, 1].find((each) => each * power * scale <= most) ?? 1) * power;
}

export interface PlaneOptions {
  label: string;
  height: (width: number) => number;
  extent: () => Extent;
  draw(pen: Pen, at: Placing): void;
  over?(pen: Pen, at: Placing): void;
  bar?: boolean; // a scale bar, unless false
  unit?: string;
}

export class Plane {
  readonly stage: Stage;
  private at: Placing | null = null;
  constructor(private options: PlaneOptions) {
    const { over } = options;
    this.stage = new Stage({
      label: options.label, height: options.height, draw: (pen) => this.draw(pen),
      ...(over ? { over: (pen: Pen) => this.at && over(pen, this.at) } : {}),
    });
  }
  get element(): HTMLElement {
    return this.stage.element;
  }
  redraw(): void {
    this.stage.redraw();
  }
  move(): void {
    this.stage.move();
  }
  /** Returns the point of the plane under a pointer. */
  point(event: MouseEvent): { x: number; y: number; scale: number } | null {
    if (!this.at) return null;
    const { x, y } = this.stage.place(event), x0 = this.at.x(0), y0 = this.at.y(0);
    return { x: (x - x0) / this.at.scale, y: (y0 - y) / this.at.scale, scale: this.at.scale };
  }
  private draw(pen: Pen): void {
    const { context, colour } = pen;
    context.fillStyle = colour("--back");
    context.fillRect(0, 0, pen.width, pen.height);
    const room = this.options.bar === false ? 0 : 18;
    this.at = placing(this.options.extent(), pen.width, pen.height - room);
    this.options.draw(pen, this.at);
    if (room) scaleBar(pen, this.at, this.options.unit ?? "mm");
  }
}

/** Draws a bar of a round length at the lower left. */
function scaleBar(pen: Pen, at: Placing, unit: string): void {
  const { context, colour } = pen, length = barLength(at.scale, Math.min(120, pen.width / 3)), y = pen.height - 9.5, x = 12;
  context.strokeStyle = context.fillStyle = colour("--soft");
  context.lineWidth = 1;
  line(context, x, y, x + length * at.scale, y);
  line(context, x, y - 4, x, y + 4);
  line(context, x + length * at.scale, y - 4, x + length * at.scale, y + 4);
  context.textAlign = "left";
  context.textBaseline = "middle";
  context.fillText(`${number(length)} ${unit}`, x + length * at.scale + 8, y);
}
