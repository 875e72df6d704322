/** Lines in space: thin ones while the view turns, thick ones at rest. Both are the same chords. */
import { BufferAttribute, BufferGeometry, Color, DoubleSide, Group, LineBasicMaterial, LineSegments, Mesh, ShaderMaterial, Vector2, VertexColors } from "three";
import { countAtMost } from "../base/search";
import type { Size } from "./projection";

export interface Chords {
  ends: Float32Array; // x, y, z of both ends, mm
  last: ArrayLike<number>; // ascending: row or time at which a chord ends
}

// A thick chord is a rectangle that reaches half its width beyond both ends, so that chords join without a gap. A corner is moved away from its own end of the
// chord: `side` is to the left or right of the direction to the other end. Chords as instances of one rectangle would be shorter to write; where a processor
// emulates graphics hardware, each instance takes as long as a drawing of its own.
const cornerShader = `
  attribute vec3 other;
  attribute float side;
  uniform vec2 size;
  uniform float width;
  varying vec3 shade;
  void main() {
    shade = color;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
    vec2 along = ((projectionMatrix * modelViewMatrix * vec4(other, 1.0)).xy - gl_Position.xy) * size;
    along = length(along) > 1e-4 ? normalize(along) : vec2(1.0, 0.0);
    gl_Position.xy += (side * vec2(-along.y, along.x) - along) * width / size;
  }
`;
const shadeShader = `
  varying vec3 shade;
  void main() {
    gl_FragColor = vec4(shade, 1.0);
  }
`;

const triangles = [0, 1, 2, 0, 2, 3];

export class SpaceLines {
  readonly group = new Group();
  private thin: LineSegments;
  private thick: Mesh;
  private readonly thinMaterial = new LineBasicMaterial({ vertexColors: VertexColors });
  private readonly thickMaterial: ShaderMaterial;
  private readonly thinColours: BufferAttribute;
  private readonly thickColours: BufferAttribute;
  readonly count: number;
  constructor(private readonly chords: Chords, size: Size, width: number) {
    const { ends } = chords, count = (this.count = chords.last.length);
    this.thinColours = new BufferAttribute(new Float32Array(6 * count), 3);
    this.thickColours = new BufferAttribute(new Float32Array(12 * count), 3);
    this.thin = new LineSegments(new BufferGeometry().setAttribute("position", new BufferAttribute(ends, 3)).setAttribute("color", this.thinColours), this.thinMaterial);
    this.thickMaterial = new ShaderMaterial({
      vertexColors: VertexColors, side: DoubleSide, vertexShader: cornerShader, fragmentShader: shadeShader,
      uniforms: { size: { value: new Vector2(1, 1) }, width: { value: width } },
    });
    const place = new Float32Array(12 * count), other = new Float32Array(12 * count), side = new Float32Array(4 * count), index = new Uint32Array(6 * count);
    for (let k = 0; k < count; ++k) {
      // Two corners of each end. The left of one end is the right of the other.
      for (let corner = 0; corner < 4; ++corner) {
        const at = 3 * (4 * k + corner), own = 6 * k + (corner < 2 ? 0 : 3), far = 6 * k + (corner < 2 ? 3 : 0);
        for (let c = 0; c < 3; ++c) {
          place[at + c] = ends[own + c]!;
          other[at + c] = ends[far + c]!;
        }
        side[4 * k + corner] = corner % 2 === 0 ? 1 : -1;
      }
      for (let i = 0; i < 6; ++i) index[6 * k + i] = 4 * k + triangles[i]!;
    }
    const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(place, 3)).setAttribute("other", new BufferAttribute(other, 3));
    geometry.setAttribute("side", new BufferAttribute(side, 1)).setAttribute("color", this.thickColours).setIndex(new BufferAttribute(index, 1));
    this.thick = new Mesh(geometry, this.thickMaterial);
    this.thin.frustumCulled = this.thick.frustumCulled = false;
    this.group.add(this.thin, this.thick);
    this.resize(size);
    this.setMoving(false);
  }
  /** Gives all chords their colours. */
  paint(colourOf: (chord: number) => Color): void {
    for (let k = 0; k < this.count; ++k) {
      const { r, g, b } = colourOf(k);
      for (const [{ array }, corners] of [[this.thinColours, 2], [this.thickColours, 4]] as const)
        for (let at = 3 * corners * k, end = at + 3 * corners; at < end; at += 3) {
          array[at] = r;
          array[at + 1] = g;
          array[at + 2] = b;
        }
    }
    this.thinColours.needsUpdate = this.thickColours.needsUpdate = true;
  }
  resize({ width, height }: Size): void {
    this.thickMaterial.uniforms.size!.value.set(Math.max(width, 1), Math.max(height, 1));
  }
  setWidth(width: number): void {
    this.thickMaterial.uniforms.width!.value = width;
  }
  setMoving(moving: boolean): void {
    this.thin.visible = moving;
    this.thick.visible = !moving;
  }
  /** Shows the chords that end at a row or time, or before it; all for Infinity. */
  showUntil(value: number): number {
    const count = this.countUntil(value);
    this.thin.geometry.setDrawRange(0, 2 * count);
    this.thick.geometry.setDrawRange(0, 6 * count);
    return count;
  }
  /** Returns how many chords end at a row or time, or before it. */
  countUntil(value: number): number {
    return value === Infinity ? this.count : countAtMost(this.chords.last, value);
  }
  dispose(): void {
    this.thin.geometry.dispose();
    this.thick.geometry.dispose();
    this.thinMaterial.dispose();
    this.thickMaterial.dispose();
  }
}
