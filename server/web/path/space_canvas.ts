/** What a picture in space offers; space.js makes one. */
import type { Colouring } from "./colours";
import type { Shown } from "./drawing";
import type { PathData } from "./path_data";
import type { Scheme } from "./palette";
import type { Size, SpaceView } from "./projection";
import type { Scene } from "../base/scene";

export interface SpaceCanvas {
  readonly element: HTMLCanvasElement;
  resize(size: Size, density: number): void;
  setPath(path: PathData, colours: Colouring, shown: Shown, scheme: Scheme): void;
  setScene(scene: Scene): void;
  setBodiesShown(shown: boolean): void;
  /** Places what moves with the tool and with the coarse axes, null where these are not known: mm, deg; NaN where the direction is not known. The path after the row is left out if `laid` is true, laid wires after
   *  the time always are. Returns whether the picture changes by it. */
  setTool(values: { place: [number, number, number]; coarse: [number, number, number] | null; phi: number; psi: number; row: number; time: number } | null, laid: boolean): boolean;
  /** Draws; lines are thin while it moves. Returns the number of segments. */
  show(view: SpaceView, moving: boolean): number;
  dispose(): void;
}
