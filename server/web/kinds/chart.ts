/** A chart: curves over one axis, with boxes for ranges, lines for limits and a cursor that others may move. */
import { lastAtMost } from "../base/search";
import { number } from "../base/numbers";
import { angleTicks, ticks } from "../charts/ticks";
import { type Pen, Stage } from "./stage";

/** A curve. With `high` it has the least and the largest value of each interval, which begins at x[k] and ends where the next one begins. */
export interface Curve {
  name: string;
  colour: string; // variable of the style
  x: ArrayLike<number>;
  low: ArrayLike<number>;
  high?: ArrayLike<number>;
  dashed?: boolean;
  width?: number; // px
}

/** A range of values over a range of the axis; ends may be infinite, and both ends of x the same. */
export interface Box {
  x0: number;
  x1: number;
  y0: number;
  y1: number;
  colour: string;
}

export interface ChartOptions {
  label: string;
  height: number;
  x: () => { from: number; to: number }; // what is shown
  xName: string; // name of the axis, unit included
  yName: string; // name of the axis, unit included
  unit?: string; // unit of the values at the cursor
  angle?: boolean; // ticks at multiples of 30, 45, 90 …
  curves: Curve[];
  boxes?: Box[];
  rules?: { value: number; colour: string }[]; // limits
  dots?: { x: number; y: number; colour: string }[];
  bands?: { x0: number; x1: number; colour: string }[]; // coloured stretches along the axis
  zero?: boolean; // the axis of values contains 0
  include?: number; // the axis of values reaches the limits where the curves come within this share of them
  cursor?: () => number | null;
  point?: (x: number | null) => void; // the pointer moves
  pick?: (x: number) => void; // a click
}

const margin = { left: 58, right: 12, top: 22, bottom: 24 };

/** Returns the least and the largest value that a curve has between two places, null where it has none. */
export function rangeOf(curve: Curve, from: number, to: number): { low: number; high: number } | null {
  let low = Infinity, high = -Infinity;
  const high_of = curve.high ?? curve.low;
  for (let k = Math.max(0, lastAtMost(curve.x, from)); k < curve.x.length && curve.x[k]! <= to; ++k) {
    if (curve.low[k]! < low) low = curve.low[k]!;
    if (high_of[k]! > high) high = high_of[k]!;
  }
  return low <= high ? { low, high } : null;
}

/** Returns a curve's values at a place: interpolated between values, those of the interval between intervals. */
export function valuesAt(curve: Curve, x: number): { low: number; high: number } | null {
  const k = lastAtMost(curve.x, x), count = curve.x.length;
  if (k < 0 || count === 0 || (k === count - 1 && x > curve.x[k]! * (1 + 1e-9) + 1e-12)) return null;
  if (curve.high && curve.high[k]! !== curve.low[k]!) return { low: curve.low[k]!, high: curve.high[k]! };
  if (k + 1 >= count || (curve.high && curve.high[k + 1]! !== curve.low[k + 1]!)) return { low: curve.low[k]!, high: curve.low[k]! };
  const width = curve.x[k + 1]! - curve.x[k]!, share = width > 0 ? (x - curve.x[k]!) / width : 0;
  const value = curve.low[k]! + share * (curve.low[k + 1]! - curve.low[k]!);
  return { low: value, high: value };
}

/** Returns the range of an axis of values: all that is shown, and some room. */
export function axisRange(options: Pick<ChartOptions, "curves" | "boxes" | "rules" | "dots" | "zero" | "include">, from: number, to: number): { from: number; to: number } {
  let low = Infinity, high = -Infinity;
  const take = (value: number): void => {
    if (!Number.isFinite(value)) return;
    low = Math.min(low, value);
    high = Math.max(high, value);
  };
  for (const curve of options.curves) {
    const range = rangeOf(curve, from, to);
    if (range) take(range.low), take(range.high);
  }
  for (const box of options.boxes ?? []) if (box.x1 >= from && box.x0 <= to) take(box.y0), take(box.y1);
  for (const dot of options.dots ?? []) if (dot.x >= from && dot.x <= to) take(dot.y);
  if (options.zero) take(0);
  const near = options.include ?? 0.5, reach = Math.max(Math.abs(low), Math.abs(high));
  for (const rule of options.rules ?? []) if (reach >= near * Math.abs(rule.value)) take(rule.value);
  if (!(low <= high)) return { from: 0, to: 1 };
  // A change that only rounding makes is none.
  if (high - low <= 1e-9 * Math.max(Math.abs(low), Math.abs(high))) {
    const half = low === 0 ? 1 : Math.abs(low) * 0.05;
    return { from: low - half, to: high + half };
  }
  const room = 0.06 * (high - low);
  return { from: low === 0 && options.zero ? 0 : low - room, to: high === 0 && options.zero ? 0 : high + room };
}

export class Chart {
  readonly stage: Stage;
  constructor(readonly options: ChartOptions) {
    this.stage = new Stage({ label: options.label, height: options.height, draw: (pen) => this.draw(pen), over: (pen) => this.over(pen) });
    const { canvas } = this.stage;
    canvas.addEventListener("pointermove", (event) => options.point?.(this.at(event)));
    canvas.addEventListener("pointerleave", () => options.point?.(null));
    canvas.addEventListener("click", (event) => {
      const x = this.at(event);
      if (x !== null) options.pick?.(x);
    });
    if (options.pick) canvas.classList.add("picks");
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
  private at(event: MouseEvent): number | null {
    const { x } = this.stage.place(event), { from, to } = this.options.x(), width = this.stage.width - margin.left - margin.right;
    const share = (x - margin.left) / width;
    return share < -0.01 || share > 1.01 ? null : from + Math.min(1, Math.max(0, share)) * (to - from);
  }
  private frame(pen: Pen) {
    const { from, to } = this.options.x(), y = axisRange(this.options, from, to);
    const left = margin.left, right = pen.width - margin.right, top = margin.top, bottom = pen.height - margin.bottom;
    return {
      left, right, top, bottom, from, to, y,
      across: (value: number) => left + ((value - from) / (to - from || 1)) * (right - left),
      down: (value: number) => bottom - ((value - y.from) / (y.to - y.from || 1)) * (bottom - top),
    };
  }
  private draw(pen: Pen): void {
    const { context, colour } = pen, { options } = this, f = this.frame(pen);
    context.fillStyle = colour("--back");
    context.fillRect(f.left, f.top, f.right - f.left, f.bottom - f.top);
    for (const band of options.bands ?? []) {
      context.globalAlpha = 0.14;
      context.fillStyle = colour(band.colour);
      const x0 = Math.max(f.left, f.across(band.x0)), x1 = Math.min(f.right, f.across(band.x1));
      if (x1 > x0) context.fillRect(x0, f.top, x1 - x0, f.bottom - f.top);
      context.globalAlpha = 1;
    }
    this.axes(pen, f);
    context.save();
    context.beginPath();
    context.rect(f.left, f.top - 1, f.right - f.left, f.bottom - f.top + 2);
    context.clip();
    for (const box of options.boxes ?? []) this.box(pen, f, box);
    for (const rule of options.rules ?? []) {
      context.strokeStyle = colour(rule.colour);
      context.setLineDash([6, 4]);
      line(context, f.left, f.down(rule.value), f.right, f.down(rule.value));
      context.setLineDash([]);
    }
    for (const curve of options.curves) this.curve(pen, f, curve);
    for (const dot of options.dots ?? []) {
      context.fillStyle = colour(dot.colour);
      context.beginPath();
      context.arc(f.across(dot.x), f.down(dot.y), 3.5, 0, 2 * Math.PI);
      context.fill();
    }
    context.restore();
  }
  private axes(pen: Pen, f: ReturnType<Chart["frame"]>): void {
    const { context, colour } = pen, { options } = this;
    context.lineWidth = 1;
    context.fillStyle = colour("--soft");
    const xs = (options.angle ? angleTicks : ticks)(f.from, f.to, Math.max(2, Math.floor((f.right - f.left) / 74)));
    // Two ticks at least: one alone tells no scale.
    let ys = ticks(f.y.from, f.y.to, Math.max(3, Math.floor((f.bottom - f.top) / 24)));
    for (let most = 4; ys.values.length < 2 && most < 9; ++most) ys = ticks(f.y.from, f.y.to, most);
    context.strokeStyle = colour("--line");
    context.textBaseline = "middle";
    context.textAlign = "right";
    for (const value of ys.values) {
      const y = Math.round(f.down(value)) + 0.5;
      line(context, f.left, y, f.right, y);
      context.fillText(ys.text(value), f.left - 6, y);
    }
    context.textBaseline = "top";
    context.textAlign = "center";
    for (const value of xs.values) {
      const x = Math.round(f.across(value)) + 0.5;
      line(context, x, f.top, x, f.bottom + 3);
      const text = xs.text(value), half = context.measureText(text).width / 2;
      context.fillText(text, Math.min(Math.max(x, f.left - 10 + half), f.right + margin.right - half), f.bottom + 6);
    }
    context.strokeStyle = colour("--strong");
    line(context, f.left, f.bottom + 0.5, f.right, f.bottom + 0.5);
    if (f.y.from < 0 && f.y.to > 0) line(context, f.left, Math.round(f.down(0)) + 0.5, f.right, Math.round(f.down(0)) + 0.5);
    context.textBaseline = "alphabetic";
    context.textAlign = "left";
    context.fillStyle = colour("--text");
    context.fillText(options.yName, 4, 14);
    context.textAlign = "right";
    context.fillStyle = colour("--soft");
    context.fillText(options.xName, f.right, 14);
  }
  private box(pen: Pen, f: ReturnType<Chart["frame"]>, box: Box): void {
    const { context, colour } = pen, middle = (f.across(box.x0) + f.across(box.x1)) / 2;
    // A range at one place is as wide as a finger sees it.
    const half = Math.max(5, (f.across(box.x1) - f.across(box.x0)) / 2), x0 = middle - half, x1 = middle + half;
    const y0 = Number.isFinite(box.y0) ? f.down(box.y0) : f.bottom, y1 = Number.isFinite(box.y1) ? f.down(box.y1) : f.top;
    context.fillStyle = colour(box.colour);
    context.globalAlpha = 0.16;
    context.fillRect(x0, y1, x1 - x0, y0 - y1);
    context.globalAlpha = 1;
    context.strokeStyle = colour(box.colour);
    context.lineWidth = 1.5;
    if (Number.isFinite(box.y0)) line(context, x0, y0, x1, y0);
    if (Number.isFinite(box.y1)) line(context, x0, y1, x1, y1);
    context.lineWidth = 1;
    if (half <= 5 || Number.isFinite(box.y0 + box.y1)) {
      line(context, x0, y0, x0, y1);
      line(context, x1, y0, x1, y1);
    }
  }
  private curve(pen: Pen, f: ReturnType<Chart["frame"]>, curve: Curve): void {
    const { context, colour } = pen, { x, low } = curve, high = curve.high ?? low, count = x.length;
    const first = Math.max(0, lastAtMost(x, f.from)), last = Math.min(count - 1, lastAtMost(x, f.to) + 1);
    const intervals = curve.high !== undefined && high !== low;
    context.strokeStyle = context.fillStyle = colour(curve.colour);
    context.lineWidth = curve.width ?? 1.6;
    if (!intervals) {
      context.setLineDash(curve.dashed ? [5, 4] : []);
      context.beginPath();
      for (let k = first; k <= last; ++k) k === first ? context.moveTo(f.across(x[k]!), f.down(low[k]!)) : context.lineTo(f.across(x[k]!), f.down(low[k]!));
      context.stroke();
      context.setLineDash([]);
    } else {
      // One rectangle per interval, which reaches to the one before it, so that steep curves do not break.
      let before: { top: number; bottom: number } | null = null;
      for (let k = first; k <= last; ++k) {
        let top = f.down(high[k]!), bottom = f.down(low[k]!);
        const x0 = f.across(x[k]!), x1 = k + 1 < count ? f.across(x[k + 1]!) : x0 + 1;
        const own = { top, bottom };
        if (before) {
          if (before.bottom < top) top = before.bottom;
          if (before.top > bottom) bottom = before.top;
        }
        const half = (curve.width ?? 1.6) / 2;
        context.fillRect(x0, top - half, Math.max(1, x1 - x0), bottom - top + 2 * half);
        before = own;
      }
    }
    context.lineWidth = 1;
    pen.drew(Math.max(0, last - first + 1));
  }
  private over(pen: Pen): void {
    const at = this.options.cursor?.() ?? null, { context, colour } = pen, f = this.frame(pen);
    if (at === null || at < f.from || at > f.to) return;
    const x = f.across(at);
    context.strokeStyle = colour("--text");
    line(context, x, f.top, x, f.bottom);
    const unit = this.options.unit ? " " + this.options.unit : "";
    const shown: { text: string; colour: string }[] = [];
    for (const curve of this.options.curves) {
      const values = valuesAt(curve, at);
      if (!values) continue;
      context.fillStyle = colour(curve.colour);
      context.beginPath();
      context.arc(x, f.down((values.low + values.high) / 2), 3, 0, 2 * Math.PI);
      context.fill();
      const text = values.high - values.low <= 1e-6 * Math.max(Math.abs(values.low), Math.abs(values.high)) ? number(values.low, 5) : `${number(values.low, 4)} … ${number(values.high, 4)}`;
      shown.push({ text: (this.options.curves.length > 1 ? curve.name + " " : "") + text + unit, colour: curve.colour });
    }
    context.textBaseline = "top";
    const width = Math.max(0, ...shown.map((each) => context.measureText(each.text).width));
    const right = x + 10 + width > f.right;
    context.textAlign = right ? "right" : "left";
    context.fillStyle = colour("--panel");
    context.globalAlpha = 0.88;
    if (shown.length > 0) context.fillRect(right ? x - 12 - width : x + 6, f.top + 2, width + 8, 16 * shown.length + 2);
    context.globalAlpha = 1;
    context.fillStyle = colour("--text");
    shown.forEach((each, k) => context.fillText(each.text, right ? x - 8 : x + 10, f.top + 5 + 16 * k));
  }
}

export function line(context: CanvasRenderingContext2D, x0: number, y0: number, x1: number, y1: number): void {
  context.beginPath();
  context.moveTo(x0, y0);
  context.lineTo(x1, y1);
  context.stroke();
}
