/** What moves in a view in space, while it moves: needle, head and fine range, and the wires and the path laid so far, drawn in the plane of the picture above
 *  a picture of what stays. A picture of everything takes a tenth of a second where a processor emulates graphics hardware; at rest there is one, in which
 *  all hides what is behind it. */
import type { Body, Point } from "../base/scene";
import { at, type Size, type SpaceView } from "./projection";
import type { ToolPlace } from "./space_canvas";

/** Chords that appear one after another. */
export interface Trail {
  ends: Float32Array; // x, y, z of both ends, mm
  colour: (chord: number) => string;
  width: number; // CSS pixels
  count: number; // chords that have appeared
}

/** Chords that have been drawn stay; only new ones are added, unless the view has changed or some are to disappear. */
export class TrailCanvas {
  readonly element = document.createElement("canvas");
  private drawn: number[] = [];
  private drawnFor = "";
  private size: Size = { width: 1, height: 1 };
  private density = 1;
  constructor() {
    this.element.hidden = true;
    this.element.setAttribute("aria-hidden", "true");
  }
  resize(size: Size, density: number): void {
    this.size = size;
    this.density = density;
    this.element.width = size.width * density;
    this.element.height = size.height * density;
    this.clear();
  }
  /** The next drawing begins anew. */
  clear(): void {
    this.drawn = [];
  }
  draw(view: SpaceView, trails: readonly Trail[]): void {
    const pen = this.element.getContext("2d", { willReadFrequently: true })!, matrix = view.matrix(), drawnFor = matrix.join();
    if (this.drawnFor !== drawnFor || trails.length !== this.drawn.length || trails.some(({ count }, k) => count < this.drawn[k]!)) {
      pen.setTransform(this.density, 0, 0, this.density, 0, 0);
      pen.clearRect(0, 0, this.size.width, this.size.height);
      pen.lineCap = pen.lineJoin = "round";
      this.drawn = trails.map(() => 0);
      this.drawnFor = drawnFor;
    }
    trails.forEach((trail, k) => {
      drawChords(pen, matrix, trail, this.drawn[k]!);
      this.drawn[k] = trail.count;
    });
  }
}

function drawChords(pen: CanvasRenderingContext2D, matrix: readonly number[], { ends, colour, width, count }: Trail, first: number): void {
  let now = "", x = NaN, y = NaN;
  pen.lineWidth = width;
  for (let k = first; k < count; ++k) {
    const next = colour(k), [x0, y0] = at(matrix, ends[6 * k]!, ends[6 * k + 1]!, ends[6 * k + 2]!);
    if (next !== now) {
      if (now !== "") pen.stroke();
      pen.strokeStyle = now = next;
      pen.beginPath();
      x = NaN;
    }
    if (x0 !== x || y0 !== y) pen.moveTo(x0, y0);
    [x, y] = at(matrix, ends[6 * k + 3]!, ends[6 * k + 4]!, ends[6 * k + 5]!);
    pen.lineTo(x, y);
  }
  if (now !== "") pen.stroke();
}

/** Returns the place in the scene of a point of a body that moves with the tool or with the coarse axes; null where that is not known. */
function placing(body: Body, place: NonNullable<ToolPlace>, turns: boolean): ((p: Point) => Point) | null {
  if (body.moves === "coarse") {
    const { coarse } = place;
    return coarse && (([x, y, z]) => [x + coarse[0], y + coarse[1], z + coarse[2]]);
  }
  const [ox, oy, oz] = place.place, rad = Math.PI / 180;
  if (!turns) return ([x, y, z]) => [x + ox, y + oy, z + oz];
  if (!Number.isFinite(place.phi)) return null;
  const cp = Math.cos(place.phi * rad), sp = Math.sin(place.phi * rad), cs = Math.cos(place.psi * rad), ss = Math.sin(place.psi * rad);
  return ([x, y, z]) => {
    const across = cs * x + ss * z; // turned by psi about y
    return [ox + cp * across - sp * y, oy + sp * across + cp * y, oz - ss * x + cs * z]; // and by phi about z
  };
}

/** Draws the bodies that move; lengths of the pen are CSS pixels. `turns`: the tool has a direction. */
export function drawMoving(pen: CanvasRenderingContext2D, view: SpaceView, bodies: readonly Body[], place: ToolPlace, turns: boolean, colours: { solid: string; moving: string }): void {
  if (!place) return;
  const matrix = view.matrix();
  pen.save();
  for (const body of bodies) {
    const move = body.moves === "none" ? null : placing(body, place, turns);
    if (!move) continue;
    const shown = (p: Point): [number, number] => at(matrix, ...move(p)), points = (body.points ?? []).map(shown);
    pen.strokeStyle = pen.fillStyle = body.moves === "tool" ? colours.moving : colours.solid;
    if (body.kind === "points") {
      for (const [x, y] of points) pen.fillRect(x - 3.5, y - 3.5, 7, 7);
    } else if (body.kind === "extrusion") {
      const outline = body.outline ?? [], from = body.from ?? 0, to = body.to ?? from;
      const [low, high] = [from, to].map((z) => outline.map(([x, y]) => shown([x, y, z])));
      pen.lineWidth = 1;
      pen.beginPath();
      for (const ring of [low!, high!]) {
        ring.forEach(([x, y], k) => (k === 0 ? pen.moveTo(x, y) : pen.lineTo(x, y)));
        pen.closePath();
      }
      pen.globalAlpha = 0.16;
      pen.fill();
      low!.forEach(([x, y], k) => {
        pen.moveTo(x, y);
        pen.lineTo(...high![k]!);
      });
      pen.globalAlpha = 0.45;
      pen.stroke();
      pen.globalAlpha = 1;
    } else if (points.length > 1) {
      pen.lineWidth = Math.max(2, 2 * (body.radius ?? 0) * view.scale);
      pen.lineCap = body.round_end || body.kind === "tube" ? "round" : "butt";
      pen.lineJoin = "round";
      pen.beginPath();
      points.forEach(([x, y], k) => (k === 0 ? pen.moveTo(x, y) : pen.lineTo(x, y)));
      pen.stroke();
    }
  }
  pen.restore();
}
