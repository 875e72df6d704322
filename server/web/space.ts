/** Views in space, loaded by pages that need them alone. */
import { AmbientLight, Color, DirectionalLight, Group, OrthographicCamera, Scene, WebGLRenderer } from "three";
import type { Colouring } from "./path/colours";
import { isEmphasised, isShown, type Shown } from "./path/drawing";
import type { Scheme } from "./path/palette";
import type { PathData } from "./path/path_data";
import type { Size, SpaceView } from "./path/projection";
import type { Point, Scene as Bodies } from "./base/scene";
import { bodyObject } from "./path/space_bodies";
import type { SpaceCanvas, ToolPlace } from "./path/space_canvas";
import { SpaceLines } from "./path/space_lines";
import { drawMoving, TrailCanvas, type Trail } from "./path/space_moving";

const cutWidth = 2, rapidWidth = 1, leastWireWidth = 1.5; // CSS pixels

/** Lines as they are drawn in space, and as a trail. */
interface Drawn {
  lines: SpaceLines;
  ends: Float32Array;
  colour: (chord: number) => string;
}

/** Returns the lines between points i - 1 and i for each i of `chords`; `last`: what each of them ends at. */
function linesBetween(chords: readonly number[], point: (i: number) => Point, last: ArrayLike<number>, size: Size, width: number): { lines: SpaceLines; ends: Float32Array } {
  const ends = new Float32Array(6 * chords.length);
  chords.forEach((i, k) => {
    ends.set(point(i - 1), 6 * k);
    ends.set(point(i), 6 * k + 3);
  });
  return { lines: new SpaceLines({ ends, last }, size, width), ends };
}

class ThreeCanvas implements SpaceCanvas {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new OrthographicCamera(-1, 1, 1, -1, 0, 1);
  private readonly light = new DirectionalLight(0xffffff, 0.7);
  private readonly still = new Group();
  private readonly tool = new Group();
  private readonly coarse = new Group();
  private size: Size = { width: 1, height: 1 };
  private readonly trail = new TrailCanvas();
  private path: (Drawn & { width: number; chords: number[] })[] = []; // rapids, then cuts
  private wires: (Drawn & { radius: number })[] = [];
  private bodies: Bodies | null = null;
  private drawn: ({ path: PathData; colours: Colouring } & Shown) | null = null;
  private drawnFor: Scheme | null = null;
  private bodiesShown = true;
  private place: ToolPlace = null;
  private laid = false;

  readonly elements: readonly HTMLCanvasElement[];

  constructor(element: HTMLCanvasElement, context: WebGLRenderingContext, antialias: boolean) {
    this.elements = [element, this.trail.element];
    this.renderer = new WebGLRenderer({ canvas: element, context, antialias, alpha: true });
    this.renderer.setClearColor(0, 0);
    this.scene.add(new AmbientLight(0xffffff, 0.55), this.light, this.still, this.tool, this.coarse);
  }
  resize(size: Size, density: number): void {
    this.size = size;
    this.renderer.setPixelRatio(density);
    this.renderer.setSize(size.width, size.height, false);
    for (const { lines } of [...this.path, ...this.wires]) lines.resize(size);
    this.trail.resize(size, density);
  }
  setPath(path: PathData, colours: Colouring, shown: Shown, scheme: Scheme): void {
    const drawn = { path, colours, ...shown }, before = this.drawn;
    if (before && (Object.keys(drawn) as (keyof typeof drawn)[]).every((key) => before[key] === drawn[key])) return;
    this.drawn = drawn;
    if (before?.path !== path || before.colours !== colours || before.rapids !== shown.rapids) this.layPath(path, colours, shown);
    const paints = colours.colours.map((colour) => new Color(colour)), faint = new Color(scheme.faint);
    for (const each of this.path) {
      const emphasised = (k: number): boolean => isEmphasised(path, each.chords[k]!, shown), kind = (k: number): number => colours.kind[each.chords[k]!]!;
      each.lines.paint((k) => (emphasised(k) ? paints[kind(k)]! : faint));
      each.colour = (k) => (emphasised(k) ? colours.colours[kind(k)]! : scheme.faint);
    }
    this.trail.clear();
    if (this.drawnFor !== scheme) {
      this.drawnFor = scheme;
      this.build();
    }
  }
  setScene(bodies: Bodies): void {
    this.bodies = bodies;
    this.build();
  }
  setBodiesShown(shown: boolean): void {
    this.bodiesShown = shown;
  }
  setTool(place: ToolPlace, laid: boolean): boolean {
    const known = place !== null || this.place !== null;
    const changes = laid !== this.laid || (known && (laid || this.wires.length > 0 || this.tool.children.length > 0 || this.coarse.children.length > 0));
    this.place = place;
    this.laid = laid;
    if (place) {
      this.tool.position.set(...place.place);
      if (place.coarse) this.coarse.position.set(...place.coarse);
      const rad = Math.PI / 180;
      if (Number.isFinite(place.phi)) this.tool.rotation.set(0, place.psi * rad, place.phi * rad, "ZYX");
    }
    return changes;
  }
  show(view: SpaceView, turning: boolean, moving: boolean): number {
    const { width, height } = this.size, { up, eye } = view.axes(), far = 1e5, [x, y, z] = view.target, { camera } = this;
    camera.left = -width / 2 / view.scale;
    camera.right = -camera.left;
    camera.top = height / 2 / view.scale;
    camera.bottom = -camera.top;
    const distance = Math.min(far, 4 * (this.reach() + width / view.scale));
    camera.near = 0;
    camera.far = 2 * distance;
    camera.position.set(x + distance * eye[0], y + distance * eye[1], z + distance * eye[2]);
    camera.up.set(...up);
    camera.lookAt(x, y, z);
    camera.updateProjectionMatrix();
    this.light.position.set(eye[0] + 0.6 * up[0], eye[1] + 0.6 * up[1], eye[2] + 0.6 * up[2] + 0.2);
    this.still.visible = this.bodiesShown;
    // A needle whose direction is not known yet is not drawn.
    this.tool.visible = this.bodiesShown && !moving && this.place !== null && (Number.isFinite(this.place.phi) || !this.turns());
    this.coarse.visible = this.bodiesShown && !moving && !!this.place?.coarse;
    this.trail.element.hidden = !moving;
    let count = 0;
    for (const { lines } of this.path) {
      lines.setMoving(turning);
      lines.group.visible = !moving || !this.laid;
      count += lines.showUntil(this.rowShown());
    }
    for (const { lines, radius } of this.wires) {
      lines.setMoving(turning);
      lines.group.visible = !moving;
      lines.setWidth(this.wireWidth(radius, view));
      const laid = lines.showUntil(this.timeShown());
      if (this.bodiesShown) count += laid;
    }
    this.renderer.render(this.scene, camera);
    return count;
  }
  showMoving(view: SpaceView, pen: CanvasRenderingContext2D): void {
    const { drawnFor: scheme, bodies } = this, trails: Trail[] = [];
    if (this.laid) for (const { lines, ends, colour, width } of this.path) trails.push({ ends, colour, width, count: lines.countUntil(this.rowShown()) });
    if (this.bodiesShown) for (const { lines, ends, colour, radius } of this.wires) trails.push({ ends, colour, width: this.wireWidth(radius, view), count: lines.countUntil(this.timeShown()) });
    this.trail.draw(view, trails);
    if (scheme && bodies && this.bodiesShown) drawMoving(pen, view, bodies.bodies, this.place, this.turns(), { solid: scheme.other, moving: scheme.distinct[0]! });
  }
  dispose(): void {
    this.renderer.dispose();
  }

  private layPath(path: PathData, colours: Colouring, shown: Shown): void {
    for (const { lines } of this.path) {
      this.scene.remove(lines.group);
      lines.dispose();
    }
    this.path = [true, false].map((rapid) => {
      const chords: number[] = [], width = rapid ? rapidWidth : cutWidth;
      for (let i = 1; i < path.count; ++i) if (isShown(path, i, shown) && (colours.kind[i] === 0) === rapid) chords.push(i);
      const laid = linesBetween(chords, (i) => [path.x[i]!, path.y[i]!, path.z[i]!], chords.map((i) => path.rows[i]!), this.size, width);
      this.scene.add(laid.lines.group);
      return { ...laid, chords, width, colour: () => "" };
    });
  }
  private rowShown(): number {
    return this.laid && this.place ? this.place.row : Infinity;
  }
  private timeShown(): number {
    return this.place ? this.place.time : Infinity;
  }
  private wireWidth(radius: number, view: SpaceView): number {
    return Math.max(leastWireWidth, 2 * radius * view.scale);
  }
  private turns(): boolean {
    return this.bodies?.movers.tool?.phi !== undefined;
  }
  private reach(): number {
    const box = this.bodies?.box;
    return box ? Math.hypot(...[0, 1, 2].map((k) => box[1][k]! - box[0][k]!)) + Math.hypot(...box[1]) : 2000;
  }
  private build(): void {
    const scheme = this.drawnFor;
    if (!scheme || !this.bodies) return;
    this.still.remove(...this.still.children.slice());
    this.tool.remove(...this.tool.children.slice());
    this.coarse.remove(...this.coarse.children.slice());
    for (const { lines } of this.wires) lines.dispose();
    this.wires = [];
    this.trail.clear();
    const colours = { solid: scheme.other, edge: scheme.other, moving: scheme.distinct[0]! }, copper = new Color(scheme.distinct[1]!);
    for (const body of this.bodies.bodies) {
      const points = body.points ?? [];
      if (body.kind === "polyline" && body.times && points.length > 1) {
        const laid = linesBetween(points.slice(1).map((_, k) => k + 1), (i) => points[i]!, body.times.slice(1), this.size, leastWireWidth);
        laid.lines.paint(() => copper);
        this.wires.push({ ...laid, colour: () => scheme.distinct[1]!, radius: body.radius ?? 0 });
        this.still.add(laid.lines.group);
      } else if (body.moves === "none") {
        this.still.add(bodyObject(body, colours));
      } else if (body.moves === "tool") {
        this.tool.add(bodyObject(body, colours));
      } else if (body.moves === "coarse") {
        this.coarse.add(bodyObject(body, colours));
      }
    }
  }
}

/** Returns whether a processor emulates graphics hardware. */
function isEmulated(context: WebGLRenderingContext): boolean {
  const names = context.getExtension("WEBGL_debug_renderer_info");
  return names !== null && /swiftshader|llvmpipe|softpipe|software|basic render/i.test(String(context.getParameter(names.UNMASKED_RENDERER_WEBGL)));
}

/** Returns a canvas in space; null where the browser has no WebGL. */
export function makeSpace(): SpaceCanvas | null {
  for (const antialias of [true, false]) {
    const canvas = document.createElement("canvas"), context = canvas.getContext("webgl", { antialias, alpha: true });
    if (!context) return null;
    // Smooth edges take twice as long as all the rest there.
    if (antialias && isEmulated(context)) {
      context.getExtension("WEBGL_lose_context")?.loseContext();
      continue;
    }
    canvas.setAttribute("role", "img");
    return new ThreeCanvas(canvas, context, antialias);
  }
  return null;
}
