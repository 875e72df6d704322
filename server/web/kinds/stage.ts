/** A canvas that fits the width of its parent and is drawn anew when its size or the system's colours change, with a second one above it for what moves. */
import { Palette, sharp } from "../base/canvas";
import { h } from "../base/dom";
import { countSegments } from "../base/segments";
import { NextFrame } from "../base/work";

/** What a drawing draws with. Lengths are CSS pixels. */
export interface Pen {
  context: CanvasRenderingContext2D;
  width: number;
  height: number;
  /** Returns the colour of a variable of the style, e.g. "--c0"; another text is a colour itself. */
  colour(variable: string): string;
  /** Adds to the number of segments that are drawn. */
  drew(segments: number): void;
}

export interface StageOptions {
  label: string; // what the picture shows, for those who do not see it
  height: number | ((width: number) => number);
  draw(pen: Pen): void; // draws everything that stays
  over?(pen: Pen): void; // draws what moves, such as a cursor
  focusable?: boolean;
}

const schemes = typeof matchMedia === "undefined" ? null : matchMedia("(prefers-color-scheme: dark)");
const stages = new Set<WeakRef<Stage>>();
schemes?.addEventListener("change", () => {
  for (const each of stages) each.deref()?.redraw();
});
const palette = new Palette();
let named = 0;

export class Stage {
  readonly element: HTMLElement;
  readonly canvas: HTMLCanvasElement;
  private above: HTMLCanvasElement | null;
  private readonly frame = new NextFrame(() => this.paint());
  private whole = true; // the next frame draws everything
  private panel = "stage-" + String(++named);
  constructor(private options: StageOptions) {
    this.canvas = h("canvas", { role: "img", "aria-label": options.label, ...(options.focusable ? { tabindex: 0 } : {}) });
    this.above = options.over ? h("canvas", { class: "above", "aria-hidden": "true" }) : null;
    this.element = h("div", { class: "drawing" }, this.canvas, this.above);
    if (typeof ResizeObserver !== "undefined") new ResizeObserver(() => this.redraw()).observe(this.element);
    stages.add(new WeakRef(this));
  }
  set label(text: string) {
    this.canvas.setAttribute("aria-label", text);
  }
  /** Draws everything at the next frame. */
  redraw(): void {
    this.whole = true;
    this.frame.ask();
  }
  /** Draws what moves at the next frame. */
  move(): void {
    this.frame.ask();
  }
  /** Returns a pointer's place in the picture. */
  place(event: MouseEvent): { x: number; y: number } {
    const box = this.canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }
  get width(): number {
    return this.element.clientWidth;
  }
  get height(): number {
    return typeof this.options.height === "number" ? this.options.height : this.options.height(this.width);
  }
  private paint(): void {
    const { width, height } = this;
    if (width < 2) return;
    if (this.whole) {
      this.whole = false;
      let segments = 0;
      const pen = this.pen(this.canvas, width, height, (n) => (segments += n));
      this.options.draw(pen);
      countSegments(this.panel, segments);
    }
    if (this.above) this.options.over!(this.pen(this.above, width, height, () => {}));
  }
  private pen(canvas: HTMLCanvasElement, width: number, height: number, drew: (segments: number) => void): Pen {
    canvas.style.width = `${width}px`;
    canvas.style.height = `${height}px`;
    this.element.style.height = `${height}px`;
    const context = sharp(canvas, width, height)!;
    context.font = "12px system-ui, sans-serif";
    const colour = (name: string): string => (name.startsWith("--") ? palette.of(name) : name);
    return { context, width, height, colour, drew };
  }
}
