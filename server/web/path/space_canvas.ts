/** What a picture in space offers; space.js makes one. */
import type { Colouring } from "./colours";
import type { Shown } from "./drawing";
import type { PathData } from "./path_data";
import type { Scheme } from "./palette";
import type { Size, SpaceView } from "./projection";
import type { Scene } from "../base/scene";

/** Where the tool and the coarse axes are: mm, deg; NaN where the direction is not known. Null where they are nowhere. */
export type ToolPlace = { place: [number, number, number]; coarse: [number, number, number] | null; phi: number; psi: number; row: number; time: number } | null;

export interface SpaceCanvas {
  readonly elements: readonly HTMLCanvasElement[]; // from back to front
  resize(size: Size, density: number): void;
  setPath(path: PathData, colours: Colouring, shown: Shown, scheme: Scheme): void;
  setScene(scene: Scene): void;
  setBodiesShown(shown: boolean): void;
  /** Places what moves with the tool and with the coarse axes. The path after the row is left out if `laid` is true, laid wires after the time always are.
   *  Returns whether the picture changes by it. */
  setTool(place: ToolPlace, laid: boolean): boolean;
  /** Draws everything that stays, and what moves unless showMoving() draws it. Lines are thin while the view turns. Returns the number of segments. */
  show(view: SpaceView, turning: boolean, moving: boolean): number;
  /** Draws what moves, above the rest: the bodies with that pen. */
  showMoving(view: SpaceView, pen: CanvasRenderingContext2D): void;
  dispose(): void;
}
