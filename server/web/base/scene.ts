/** Bodies among which a motion takes place, as GET /v1/jobs/{id}/scene answers them (docs/charts.md). */
export type Point = [number, number, number];

export interface Body {
  name: string;
  kind: "extrusion" | "polyline" | "tube" | "cylinder" | "points";
  moves: string; // none, or the name of a mover
  outline?: [number, number][];
  holes?: [number, number][][];
  from?: number;
  to?: number;
  frame?: { origin: Point; x: Point; y: Point; z: Point };
  points?: Point[];
  times?: number[];
  radius?: number;
  coil?: number; // from 1
  round_end?: boolean;
}

export interface Scene {
  frame: string;
  place: { x: number; y: number; z: number; angle: number } | null;
  box?: [Point, Point];
  movers: Record<string, { position: string[]; phi?: string; psi?: string }>;
  bodies: Body[];
}
