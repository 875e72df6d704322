/** A canvas as sharp as the screen, and what all charts draw into one. */

export interface Picture {
  canvas: HTMLCanvasElement;
  context: CanvasRenderingContext2D;
  width: number; // CSS pixels
  height: number;
  snap: (x: number) => number; // the nearest edge of the screen's pixels: neighbouring rectangles leave no seam
}

/** Returns the canvas with the size that it has on the page, cleared. Null where it is not shown. */
export function begin(canvas: HTMLCanvasElement): Picture | null {
  const width = canvas.clientWidth, height = canvas.clientHeight, ratio = Math.min(3, window.devicePixelRatio || 1);
  const context = canvas.getContext("2d");
  if (!context || width === 0 || height === 0) return null;
  const w = Math.round(width * ratio), h = Math.round(height * ratio);
  if (canvas.width !== w || canvas.height !== h) {
    canvas.width = w;
    canvas.height = h;
  }
  context.setTransform(w / width, 0, 0, h / height, 0, 0);
  context.clearRect(0, 0, width, height);
  const across = w / width;
  return { canvas, context, width, height, snap: (x) => Math.round(x * across) / across };
}

/** Colours of the style as they are now, in the light or the dark scheme. */
export class Palette {
  private known = new Map<string, string>();
  constructor(private readonly element: Element = document.documentElement) {
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.known.clear());
  }
  /** Returns the colour of a variable, e.g. "--c0". */
  of(name: string): string {
    let colour = this.known.get(name);
    if (colour === undefined) this.known.set(name, (colour = getComputedStyle(this.element).getPropertyValue(name).trim()));
    return colour;
  }
}
