/** What all charts draw into. */
import { sharp } from "../base/canvas";

export interface Picture {
  canvas: HTMLCanvasElement;
  context: CanvasRenderingContext2D;
  width: number; // CSS pixels
  height: number;
  snap: (x: number) => number; // the nearest edge of the screen's pixels: neighbouring rectangles leave no seam
}

/** Returns the canvas with the size that it has on the page, cleared. Null where it is not shown. */
export function begin(canvas: HTMLCanvasElement): Picture | null {
  const width = canvas.clientWidth, height = canvas.clientHeight, context = sharp(canvas, width, height);
  if (!context) return null;
  const across = canvas.width / width;
  return { canvas, context, width, height, snap: (x) => Math.round(x * across) / across };
}
