/** The picture of a path: a canvas with the path, one above it with what moves, in the plane or in space. */
import { styleColour } from "../base/canvas";
import { countSegments } from "../base/segments";
import { h } from "../base/dom";
import { number } from "../base/numbers";
import { Delay, NextFrame } from "../base/work";
import { colouring, speedRange, type ColourBy, type Colouring } from "./colours";
import { drawPath, isEmphasised, isShown, type Shown } from "./drawing";
import { onGestures } from "./gestures";
import { drawAxes, drawMarks, drawScaleBar, type Mark } from "./layer";
import { readScheme, type Scheme } from "./palette";
import { extentsOf, type PathData } from "./path_data";
import { pick } from "./picking";
import { at, joined, PlaneView, SpaceView, type Extents, type Size } from "./projection";
import type { SpaceCanvas } from "./space_canvas";
import { grown, needsPart, type Box, type Part, type PathSource } from "./source";
import { t } from "./words";

// Thousands of thin chords are a matter for the processor: where a browser emulates graphics hardware, that takes seconds.
const drawnByProcessor: CanvasRenderingContext2DSettings = { willReadFrequently: true };
const settleAfter = 70, fetchAfter = 120; // ms after the last move

export interface PictureEvents {
  hover(row: number | null): void;
  pick(row: number | null): void;
  /** The part that is looked at has changed. */
  moved(): void;
  /** The scheme of colours has changed. */
  recoloured(): void;
  failed(error: unknown): void;
}

export class Picture {
  readonly element: HTMLElement;
  readonly plane: PlaneView;
  readonly space: SpaceView;
  private readonly base = h("canvas", { role: "img" });
  private readonly layer = h("canvas", { class: "layer", "aria-hidden": "true" });
  private size: Size = { width: 0, height: 0 };
  private density = 1;
  private drawnPlane: { x: number; y: number; scale: number } | null = null;
  private readonly settle = new Delay(settleAfter);
  private readonly fetching = new Delay(fetchAfter);
  private readonly frame = new NextFrame(() => this.draw());
  private extents: Extents = { low: [0, 0, 0], high: [0, 0, 0] };
  private bodies: Extents | null = null;
  private whole: PathData | null = null;
  private part: Part | null = null;
  private coarse: PathData | null = null;
  private colours = new Map<PathData, Colouring>();
  private scheme: Scheme = readScheme();
  private marks: Mark[] = [];
  private locked = false;
  private fitted = true; // all of the path is shown, whatever the size of the picture
  private three: SpaceCanvas | null = null;
  private expecting = false; // a picture in space is about to come, so that one in the plane is of no use
  private turning = false; // the view in space changes
  private moving = false; // what moves in space is drawn above the rest
  private playing = false;
  by: ColourBy = "speed";
  shown: Shown;
  stroke: [number, number] | null = null; // stroke of the fine axes, mm to each side
  limitVariables: ReadonlyMap<number, string> = new Map();
  tools: ((line: number) => number) | undefined;
  speeds: [number, number] = [0, 1];

  constructor(private readonly source: PathSource, rows: number, private readonly events: PictureEvents) {
    this.plane = new PlaneView(this.size);
    this.space = new SpaceView(this.size);
    this.shown = { rapids: true, first: 0, end: rows };
    this.element = h("div", { class: "path-picture", tabindex: 0, role: "group", "aria-label": t("picture_keys") }, this.base, this.layer);
    onGestures(this.element, {
      pan: (dx, dy) => this.move(() => this.view.pan(dx, dy)),
      drag: (dx, dy, shift) => this.move(() => (this.three && !shift ? this.space.orbit(dx, dy) : this.view.pan(dx, dy))),
      zoom: (sx, sy, factor) => this.move(() => this.view.zoom(sx, sy, factor)),
      hover: (place) => this.events.hover(place ? this.rowAt(place[0], place[1], 12) : null),
      tap: (sx, sy, touch) => this.events.pick(this.rowAt(sx, sy, touch ? 28 : 14)),
      key: (event) => this.key(event),
    });
    // A canvas of another size is blank until it is drawn.
    new ResizeObserver(() => this.resize() && this.frame.now()).observe(this.element);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
      this.recolour();
      this.events.recoloured();
    });
  }
  private get view(): PlaneView | SpaceView {
    return this.three ? this.space : this.plane;
  }
  get inSpace(): boolean {
    return this.three !== null;
  }
  get path(): PathData | null {
    return this.whole;
  }
  get reach(): Extents {
    return this.extents;
  }
  /** Loads the whole path. */
  async load(): Promise<PathData> {
    const path = await this.source.whole(this.by);
    this.whole = path;
    this.part = null;
    this.extents = extentsOf(path);
    this.speeds = speedRange(path);
    this.base.setAttribute(
      "aria-label",
      t("picture", { n: path.count, x: number(this.extents.high[0] - this.extents.low[0], 4), y: number(this.extents.high[1] - this.extents.low[1], 4) }),
    );
    this.adaptHeight();
    this.resize();
    if (this.fitted && this.size.width > 0) this.fit();
    else this.after();
    this.recolour();
    return path;
  }
  /** Makes the picture lower where the path is wide: on a phone an empty frame would hide what follows. */
  private adaptHeight(): void {
    const { low, high } = this.extents, wide = Math.max(high[0] - low[0], 1e-9), tall = high[1] - low[1];
    this.element.style.aspectRatio = String(Math.max(0.5, Math.min(4, wide / Math.max(tall + (wide * 56) / 600, 1e-9))));
  }
  /** Shows or hides the path of the coarse axes. */
  setCoarse(path: PathData | null): void {
    this.coarse = path;
    this.redraw();
  }
  /** Leaves the picture empty while a view in space is being loaded. */
  expectSpace(expecting: boolean): void {
    this.expecting = expecting;
    if (!expecting) this.redraw();
  }
  /** Shows the path in space on that canvas, or in the plane. */
  setSpace(three: SpaceCanvas | null): void {
    this.expecting = false;
    for (const canvas of this.three?.elements ?? []) canvas.remove();
    this.three = three;
    this.base.hidden = three !== null;
    this.element.setAttribute("aria-label", t(three ? "picture_keys_space" : "picture_keys"));
    if (three) {
      for (const canvas of three.elements) this.element.insertBefore(canvas, this.layer);
      three.resize(this.size, this.density);
      three.elements[0]!.setAttribute("aria-label", this.base.getAttribute("aria-label")!);
    }
    this.scheme = readScheme();
    this.colours.clear();
    this.fit();
  }
  /** Extents of the bodies in space, which are shown with the path. */
  setBodies(bodies: Extents): void {
    this.bodies = bodies;
    if (this.three && this.fitted) this.fit();
  }
  fit(): void {
    this.move(() => this.fitView());
    this.fitted = true;
    this.rest();
  }
  /** Changes the scale about the middle. */
  scaleBy(factor: number): void {
    this.move(() => this.view.zoom(this.size.width / 2, this.size.height / 2, factor));
  }
  /** Shows a part of the plane that an address names. */
  showPlane(x: number, y: number, scale: number): void {
    Object.assign(this.plane, { x, y, scale });
    this.fitted = false;
    this.after();
  }
  setMarks(marks: Mark[], locked: boolean): void {
    this.marks = marks;
    this.locked = locked;
    this.drawLayer();
  }
  /** Moves the picture so that a place is in it. */
  reveal(place: [number, number, number]): void {
    const [sx, sy] = at(this.view.matrix(), ...place), { width, height } = this.size, margin = 24;
    if (sx >= margin && sy >= margin && sx <= width - margin && sy <= height - margin) return;
    this.move(() => this.view.pan(width / 2 - sx, height / 2 - sy));
  }
  /** Draws everything anew: for other colours, and where other rows are emphasised. */
  recolour(): void {
    this.scheme = readScheme();
    this.colours.clear();
    this.redraw();
  }
  legendColours(): Scheme {
    return this.scheme;
  }
  redraw(): void {
    this.frame.ask();
  }

  /** Shows that something in space has moved. `playing`: it goes on to move. */
  showSpace(playing: boolean): void {
    this.playing = playing;
    if (!this.moving) {
      this.moving = true;
      this.redraw();
    }
    if (playing) this.settle.cancel();
    else this.settle.start(() => this.rest());
  }
  /** Returns whether all of the path is shown. */
  isFit(): boolean {
    return this.fitted;
  }

  private fitView(): void {
    if (this.three) this.space.fit(this.bodies ? joined(this.extents, this.bodies) : this.extents);
    else this.plane.fit(this.extents);
  }
  private key(event: KeyboardEvent): boolean {
    const step = 48, arrows: Record<string, [number, number]> = { ArrowLeft: [step, 0], ArrowRight: [-step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] };
    const arrow = arrows[event.key];
    if (arrow) {
      if (this.three && !event.shiftKey) this.move(() => this.space.orbit(-arrow[0], -arrow[1]));
      else this.move(() => this.view.pan(arrow[0], arrow[1]));
    } else if (event.key === "+" || event.key === "=") this.scaleBy(1.5);
    else if (event.key === "-") this.scaleBy(1 / 1.5);
    else if (event.key === "Home" || event.key === "0") this.fit();
    else return false;
    return true;
  }
  /** Draws all as it is at rest. */
  private rest(): void {
    this.settle.cancel();
    this.turning = false;
    this.moving = this.playing;
    this.redraw();
  }
  private move(change: () => void): void {
    this.fitted = false;
    change();
    this.after();
  }
  /** Follows a move: the picture at once, as it is; then drawn anew; then with finer vertices. */
  private after(): void {
    if (this.size.width === 0) return;
    if (this.three) {
      this.turning = true;
      this.redraw();
    } else if (this.drawnPlane) {
      const was = this.drawnPlane, k = this.plane.scale / was.scale, { width, height } = this.size;
      const left = width / 2 + (was.x - this.plane.x) * this.plane.scale - (k * width) / 2;
      const top = height / 2 - (was.y - this.plane.y) * this.plane.scale - (k * height) / 2;
      this.base.style.transform = `translate(${left}px,${top}px) scale(${k})`;
    }
    this.drawLayer();
    this.settle.start(() => this.rest());
    this.fetching.start(() => void this.refine());
    this.touchAction();
    this.events.moved();
  }
  /** The scale at which all of the path is shown. */
  private fitScale(): number {
    const fitting = this.three ? new SpaceView(this.size, [0, 0, 0], 1, this.space.turn, this.space.tilt) : new PlaneView(this.size);
    fitting.fit(this.extents);
    return fitting.scale;
  }
  /** One finger scrolls the page while all of the path is shown, and moves the picture when a part of it is looked at. */
  private touchAction(): void {
    this.element.style.touchAction = this.three || this.plane.scale > this.fitScale() * 1.05 ? "none" : "pan-y";
  }
  private visible(): Box {
    return this.three ? this.space.box(this.extents) : this.plane.box();
  }
  private async refine(): Promise<void> {
    const whole = this.whole, box = this.visible(), scale = this.view.scale;
    if (!whole) return;
    if (scale < 1.3 * this.fitScale() || !needsPart(whole, this.part, box, scale)) return this.source.stop();
    try {
      const part = await this.source.part(whole, grown(box, 0.15), scale, this.by);
      if (!part || this.whole !== whole) return;
      this.part = part;
      this.redraw();
    } catch (error) {
      this.events.failed(error);
    }
  }
  /** The vertices that are drawn: those of the part where it has all that is seen. */
  private current(): PathData | null {
    const { whole, part } = this;
    if (!whole || !part || whole.tolerance * this.view.scale <= 0.5 || part.path.tolerance >= whole.tolerance) return whole;
    const [x0, y0, x1, y1] = this.visible(), box = part.box, slack = 0.02 * Math.max(x1 - x0, y1 - y0);
    const inside = box[0] <= x0 + slack && box[1] <= y0 + slack && box[2] >= x1 - slack && box[3] >= y1 - slack;
    return inside ? part.path : whole;
  }
  private coloursOf(path: PathData): Colouring {
    let found = this.colours.get(path);
    if (!found) {
      const limits = new Map([...this.limitVariables].map(([id, name]) => [id, styleColour(name)]));
      this.colours.set(path, (found = colouring(path, this.by, this.scheme, this.speeds, limits, this.tools)));
      if (this.colours.size > 4) this.colours.delete(this.colours.keys().next().value!);
    }
    return found;
  }
  private draw(): void {
    const path = this.current();
    if (!path || this.size.width === 0 || this.expecting) return;
    const colours = this.coloursOf(path);
    if (this.three) {
      this.three.setPath(path, colours, this.shown, this.scheme);
      const count = this.three.show(this.space, this.turning, this.moving);
      if (!this.turning) countSegments("path", count);
    } else {
      const pen = this.base.getContext("2d", drawnByProcessor)!;
      pen.setTransform(this.density, 0, 0, this.density, 0, 0);
      pen.clearRect(0, 0, this.size.width, this.size.height);
      const matrix = this.plane.matrix();
      let count = 0;
      if (this.coarse) {
        const plain: Colouring = { kind: new Uint16Array(this.coarse.count), colours: [this.scheme.coarse] };
        count += drawPath(pen, this.coarse, matrix, this.size, plain, { ...this.shown, rapids: true }, this.scheme.faint);
      }
      count += drawPath(pen, path, matrix, this.size, colours, this.shown, this.scheme.faint);
      this.base.style.transform = "";
      this.drawnPlane = { x: this.plane.x, y: this.plane.y, scale: this.plane.scale };
      countSegments("path", count);
    }
    this.drawLayer();
  }
  private drawLayer(): void {
    if (this.size.width === 0 || !this.whole) return;
    const pen = this.layer.getContext("2d", drawnByProcessor)!;
    pen.setTransform(this.density, 0, 0, this.density, 0, 0);
    pen.clearRect(0, 0, this.size.width, this.size.height);
    drawScaleBar(pen, this.view.scale, this.size, this.scheme);
    drawAxes(pen, this.view.matrix(), this.view.scale, this.three ? 3 : 2, this.scheme);
    if (this.three && this.moving) this.three.showMoving(this.space, pen);
    drawMarks(pen, this.view, this.marks, this.scheme, this.locked, this.three ? null : this.stroke);
  }
  private rowAt(sx: number, sy: number, reach: number): number | null {
    const path = this.current();
    if (!path) return null;
    const matrix = this.view.matrix();
    const emphasised = pick(path, matrix, sx, sy, reach, (i) => isShown(path, i, this.shown) && isEmphasised(path, i, this.shown));
    return (emphasised ?? pick(path, matrix, sx, sy, reach, (i) => isShown(path, i, this.shown)))?.row ?? null;
  }
  /** Takes the size that the element has; returns whether it is another one. */
  private resize(): boolean {
    const width = Math.floor(this.element.clientWidth), height = Math.floor(this.element.clientHeight), density = Math.min(2, devicePixelRatio || 1);
    if (width === 0 || height === 0 || (width === this.size.width && height === this.size.height && density === this.density)) return false;
    this.size = { width, height };
    this.density = density;
    this.plane.size = this.space.size = this.size;
    for (const canvas of [this.base, this.layer]) {
      canvas.width = width * density;
      canvas.height = height * density;
    }
    this.three?.resize(this.size, density);
    this.drawnPlane = null;
    if (this.whole && this.fitted) this.fit();
    else this.after();
    return true;
  }
}
