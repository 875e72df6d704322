/** Views in space, loaded by pages that need them alone. */
import { AmbientLight, Color, DirectionalLight, Group, OrthographicCamera, Scene, WebGLRenderer } from "three";
import type { Colouring } from "./path/colours";
import { isEmphasised, isShown, type Shown } from "./path/drawing";
import type { Scheme } from "./path/palette";
import type { PathData } from "./path/path_data";
import type { Size, SpaceView } from "./path/projection";
import type { Scene as Bodies } from "./base/scene";
import { bodyObject } from "./path/space_bodies";
import type { SpaceCanvas } from "./path/space_canvas";
import { paint, SpaceLines } from "./path/space_lines";

const cutWidth = 2, rapidWidth = 1, leastWireWidth = 1.5; // CSS pixels

type ToolPlace = Parameters<SpaceCanvas["setTool"]>[0];

class ThreeCanvas implements SpaceCanvas {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new OrthographicCamera(-1, 1, 1, -1, 0, 1);
  private readonly light = new DirectionalLight(0xffffff, 0.7);
  private readonly still = new Group();
  private readonly tool = new Group();
  private readonly coarse = new Group();
  private size: Size = { width: 1, height: 1 };
  private path: SpaceLines[] = []; // rapids, then cuts
  private wires: { lines: SpaceLines; radius: number }[] = [];
  private bodies: Bodies | null = null;
  private drawn: ({ path: PathData; colours: Colouring } & Shown) | null = null;
  private drawnFor: Scheme | null = null;
  private bodiesShown = true;
  private place: ToolPlace = null;
  private laid = false;

  constructor(readonly element: HTMLCanvasElement, context: WebGLRenderingContext) {
    this.renderer = new WebGLRenderer({ canvas: element, context, antialias: true, alpha: true });
    this.renderer.setClearColor(0, 0);
    this.scene.add(new AmbientLight(0xffffff, 0.55), this.light, this.still, this.tool, this.coarse);
  }
  resize(size: Size, density: number): void {
    this.size = size;
    this.renderer.setPixelRatio(density);
    this.renderer.setSize(size.width, size.height, false);
    for (const lines of this.path) lines.resize(size);
    for (const { lines } of this.wires) lines.resize(size);
  }
  setPath(path: PathData, colours: Colouring, shown: Shown, scheme: Scheme): void {
    const drawn = { path, colours, ...shown }, before = this.drawn;
    if (before && (Object.keys(drawn) as (keyof typeof drawn)[]).every((key) => before[key] === drawn[key])) return;
    this.drawn = drawn;
    const paints = colours.colours.map((colour) => new Color(colour)), faint = new Color(scheme.faint);
    for (const lines of this.path) {
      this.scene.remove(lines.group);
      lines.dispose();
    }
    this.path = [true, false].map((rapid) => {
      const chords: number[] = [];
      for (let i = 1; i < path.count; ++i) if (isShown(path, i, shown) && (colours.kind[i] === 0) === rapid) chords.push(i);
      const ends = new Float32Array(6 * chords.length), painted = new Float32Array(6 * chords.length);
      chords.forEach((i, k) => {
        ends.set([path.x[i - 1]!, path.y[i - 1]!, path.z[i - 1]!, path.x[i]!, path.y[i]!, path.z[i]!], 6 * k);
        paint(painted, k, isEmphasised(path, i, shown) ? paints[colours.kind[i]!]! : faint);
      });
      const lines = new SpaceLines({ ends, colours: painted, last: chords.map((i) => path.rows[i]!) }, this.size, rapid ? rapidWidth : cutWidth);
      this.scene.add(lines.group);
      return lines;
    });
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
    const changes = laid || this.laid || this.wires.length > 0 || this.tool.children.length > 0 || this.coarse.children.length > 0;
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
  show(view: SpaceView, moving: boolean): number {
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
    this.tool.visible = this.bodiesShown && this.place !== null && (Number.isFinite(this.place.phi) || !this.turns());
    this.coarse.visible = this.bodiesShown && !!this.place?.coarse;
    let count = 0;
    for (const lines of this.path) {
      lines.setMoving(moving);
      count += lines.showUntil(this.laid && this.place ? this.place.row : Infinity);
    }
    for (const { lines, radius } of this.wires) {
      lines.setMoving(moving);
      lines.setWidth(Math.max(leastWireWidth, 2 * radius * view.scale));
      const laid = lines.showUntil(this.place ? this.place.time : Infinity);
      if (this.bodiesShown) count += laid;
    }
    this.renderer.render(this.scene, camera);
    return count;
  }
  dispose(): void {
    this.renderer.dispose();
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
    const colours = { solid: scheme.other, edge: scheme.other, moving: scheme.distinct[0]! }, copper = new Color(scheme.distinct[1]!);
    for (const body of this.bodies.bodies) {
      const points = body.points ?? [];
      if (body.kind === "polyline" && body.times && points.length > 1) {
        const count = points.length - 1, ends = new Float32Array(6 * count), painted = new Float32Array(6 * count);
        for (let k = 0; k < count; ++k) {
          ends.set([...points[k]!, ...points[k + 1]!], 6 * k);
          paint(painted, k, copper);
        }
        const lines = new SpaceLines({ ends, colours: painted, last: body.times.slice(1) }, this.size, leastWireWidth);
        this.wires.push({ lines, radius: body.radius ?? 0 });
        this.still.add(lines.group);
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

/** Returns a canvas in space; null where the browser has no WebGL. */
export function makeSpace(): SpaceCanvas | null {
  const canvas = document.createElement("canvas");
  canvas.setAttribute("role", "img");
  const context = canvas.getContext("webgl", { antialias: true, alpha: true });
  return context ? new ThreeCanvas(canvas, context as WebGLRenderingContext) : null;
}
