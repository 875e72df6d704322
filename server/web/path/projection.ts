/** Projections of a path onto the picture: of the plane, and of space as an orthographic view that turns about a point. Places in the picture are CSS
 *  pixels from its upper left corner, x to the right and y down. */
export interface Size {
  width: number;
  height: number;
}

/** Lowest and highest coordinates, mm. */
export interface Extents {
  low: [number, number, number];
  high: [number, number, number];
}

/** Returns the extents of two bodies together. */
export const joined = (a: Extents, b: Extents): Extents => ({
  low: a.low.map((v, k) => Math.min(v, b.low[k]!)) as Extents["low"],
  high: a.high.map((v, k) => Math.max(v, b.high[k]!)) as Extents["high"],
});

export interface Projection {
  /** CSS pixels per mm. */
  readonly scale: number;
  /** Place in the picture: sx = m[0]·x + m[1]·y + m[2]·z + m[3], sy = m[4]·x + m[5]·y + m[6]·z + m[7]. */
  matrix(): readonly number[];
}

export const at = (m: readonly number[], x: number, y: number, z: number): [number, number] => [
  m[0]! * x + m[1]! * y + m[2]! * z + m[3]!,
  m[4]! * x + m[5]! * y + m[6]! * z + m[7]!,
];

const smallest = 1e-3, largest = 1e5; // CSS pixels per mm
const bounded = (scale: number): number => Math.min(largest, Math.max(smallest, scale));

/** A plane seen from above: the point (x, y), mm, lies in the middle of the picture. */
export class PlaneView implements Projection {
  constructor(public size: Size, public x = 0, public y = 0, public scale = 1) {}
  /** Shows all of the extents, with a margin in CSS pixels. */
  fit({ low, high }: Extents, margin = 28): void {
    this.x = (low[0] + high[0]) / 2;
    this.y = (low[1] + high[1]) / 2;
    const wide = Math.max(high[0] - low[0], 1e-9), tall = Math.max(high[1] - low[1], 1e-9);
    this.scale = bounded(Math.min((this.size.width - 2 * margin) / wide, (this.size.height - 2 * margin) / tall));
  }
  matrix(): readonly number[] {
    const { scale: k, size } = this;
    return [k, 0, 0, size.width / 2 - k * this.x, 0, -k, 0, size.height / 2 + k * this.y];
  }
  toWorld(sx: number, sy: number): [number, number] {
    return [this.x + (sx - this.size.width / 2) / this.scale, this.y - (sy - this.size.height / 2) / this.scale];
  }
  /** Moves the picture by CSS pixels. */
  pan(dx: number, dy: number): void {
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
  }
  /** Changes the scale by a factor; the point below (sx, sy) keeps its place. */
  zoom(sx: number, sy: number, factor: number): void {
    const [x, y] = this.toWorld(sx, sy);
    this.scale = bounded(this.scale * factor);
    const [now_x, now_y] = this.toWorld(sx, sy);
    this.x += x - now_x;
    this.y += y - now_y;
  }
  /** Returns x0, y0, x1, y1 of what the picture shows, mm. */
  box(): [number, number, number, number] {
    const [x0, y1] = this.toWorld(0, 0), [x1, y0] = this.toWorld(this.size.width, this.size.height);
    return [x0, y0, x1, y1];
  }
}

/** Space seen along a direction: `turn` about z and `tilt` above the plane, rad; a tilt of π/2 looks down on the plane. The target lies in the middle. */
export class SpaceView implements Projection {
  constructor(public size: Size, public target: [number, number, number] = [0, 0, 0], public scale = 1, public turn = -0.6, public tilt = 0.62) {}
  /** Directions in space of the picture's right, its up, and towards the eye. */
  axes(): { right: [number, number, number]; up: [number, number, number]; eye: [number, number, number] } {
    const ct = Math.cos(this.turn), st = Math.sin(this.turn), cs = Math.cos(this.tilt), ss = Math.sin(this.tilt);
    return { right: [ct, st, 0], up: [-st * ss, ct * ss, cs], eye: [st * cs, -ct * cs, ss] };
  }
  fit({ low, high }: Extents, margin = 28): void {
    this.target = [0, 1, 2].map((k) => (low[k]! + high[k]!) / 2) as [number, number, number];
    const { right, up } = this.axes();
    const span = (axis: number[]): number => axis.reduce((sum, a, k) => sum + Math.abs(a) * (high[k]! - low[k]!), 0);
    this.scale = bounded(
      Math.min((this.size.width - 2 * margin) / Math.max(span(right), 1e-9), (this.size.height - 2 * margin) / Math.max(span(up), 1e-9)),
    );
  }
  matrix(): readonly number[] {
    const { right: r, up: u } = this.axes(), k = this.scale, [x, y, z] = this.target;
    const sx = this.size.width / 2 - k * (r[0] * x + r[1] * y + r[2] * z), sy = this.size.height / 2 + k * (u[0] * x + u[1] * y + u[2] * z);
    return [k * r[0], k * r[1], k * r[2], sx, -k * u[0], -k * u[1], -k * u[2], sy];
  }
  private move(along: number[], by: number): void {
    for (let k = 0; k < 3; ++k) this.target[k]! += along[k]! * by;
  }
  pan(dx: number, dy: number): void {
    const { right, up } = this.axes();
    this.move(right, -dx / this.scale);
    this.move(up, dy / this.scale);
  }
  zoom(sx: number, sy: number, factor: number): void {
    const before = this.scale;
    this.scale = bounded(before * factor);
    const { right, up } = this.axes(), change = 1 / before - 1 / this.scale;
    this.move(right, (sx - this.size.width / 2) * change);
    this.move(up, -(sy - this.size.height / 2) * change);
  }
  /** Turns by CSS pixels of a drag: half a turn over 500 pixels. */
  orbit(dx: number, dy: number): void {
    this.turn -= (dx * Math.PI) / 500;
    this.tilt = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, this.tilt + (dy * Math.PI) / 500));
  }
  /** Returns x0, y0, x1, y1 of what the picture may show between the lowest and the highest z, mm, within the extents. */
  box({ low, high }: Extents): [number, number, number, number] {
    const m = this.matrix(), { width, height } = this.size, out: [number, number, number, number] = [low[0], low[1], high[0], high[1]];
    const det = m[0]! * m[5]! - m[1]! * m[4]!;
    if (Math.abs(det) < 1e-6 * this.scale * this.scale) return out;
    const xs: number[] = [], ys: number[] = [];
    for (const z of [low[2], high[2]])
      for (const sx of [0, width])
        for (const sy of [0, height]) {
          const a = sx - m[3]! - m[2]! * z, b = sy - m[7]! - m[6]! * z;
          xs.push((a * m[5]! - b * m[1]!) / det);
          ys.push((b * m[0]! - a * m[4]!) / det);
        }
    const within = (v: number, k: number): number => Math.max(low[k]!, Math.min(high[k]!, v));
    return [within(Math.min(...xs), 0), within(Math.min(...ys), 1), within(Math.max(...xs), 0), within(Math.max(...ys), 1)];
  }
}

/** Returns the longest of 1, 2, 5 · 10^k that is at most `most`. Used for scale bars. */
export function niceLength(most: number): number {
  const power = 10 ** Math.floor(Math.log10(most) + 1e-12), lead = most / power;
  return (lead >= 5 ? 5 : lead >= 2 ? 2 : 1) * power;
}
