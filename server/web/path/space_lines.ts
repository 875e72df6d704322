/** Lines in space: thin ones while the view turns, thick ones at rest. Both are the same chords. */
import { BufferAttribute, BufferGeometry, Color, Group, LineBasicMaterial, LineSegments, VertexColors } from "three";
import { LineMaterial } from "three-lines/LineMaterial.js";
import { LineSegments2 } from "three-lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three-lines/LineSegmentsGeometry.js";
import { countAtMost } from "../base/search";
import type { Size } from "./projection";

export interface Chords {
  ends: Float32Array; // x, y, z of both ends, mm
  colours: Float32Array; // red, green, blue of both ends, 0 … 1
  last: ArrayLike<number>; // ascending: row or time at which a chord ends
}

export class SpaceLines {
  readonly group = new Group();
  private thin: LineSegments;
  private thick: LineSegments2;
  private readonly thinMaterial = new LineBasicMaterial({ vertexColors: VertexColors });
  private readonly thickMaterial: LineMaterial;
  readonly count: number;
  constructor(private readonly chords: Chords, size: Size, width: number) {
    this.count = chords.last.length;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(chords.ends, 3));
    geometry.setAttribute("color", new BufferAttribute(chords.colours, 3));
    this.thin = new LineSegments(geometry, this.thinMaterial);
    const broad = new LineSegmentsGeometry();
    broad.setPositions(chords.ends);
    broad.setColors(chords.colours);
    this.thickMaterial = new LineMaterial({ vertexColors: VertexColors, linewidth: width });
    this.thick = new LineSegments2(broad, this.thickMaterial);
    this.thin.frustumCulled = this.thick.frustumCulled = false;
    this.group.add(this.thin, this.thick);
    this.resize(size);
    this.setMoving(false);
  }
  resize({ width, height }: Size): void {
    this.thickMaterial.resolution.set(Math.max(width, 1), Math.max(height, 1));
  }
  setWidth(width: number): void {
    this.thickMaterial.linewidth = width;
  }
  setMoving(moving: boolean): void {
    this.thin.visible = moving;
    this.thick.visible = !moving;
  }
  /** Shows the chords that end at a row or time, or before it; all for Infinity. */
  showUntil(value: number): number {
    const count = value === Infinity ? this.count : countAtMost(this.chords.last, value);
    this.thin.geometry.setDrawRange(0, 2 * count);
    this.thick.geometry.maxInstancedCount = count;
    return count;
  }
  dispose(): void {
    this.thin.geometry.dispose();
    this.thick.geometry.dispose();
    this.thinMaterial.dispose();
    this.thickMaterial.dispose();
  }
}

/** Writes a colour into both ends of chord k. */
export function paint(colours: Float32Array, k: number, colour: Color): void {
  for (let end = 0; end < 2; ++end) {
    colours[6 * k + 3 * end] = colour.r;
    colours[6 * k + 3 * end + 1] = colour.g;
    colours[6 * k + 3 * end + 2] = colour.b;
  }
}
