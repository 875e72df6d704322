/** What every canvas of the pages needs: as many pixels as the screen has, and the colours of the style. */

/** Gives a canvas the pixels of so many CSS pixels, cleared, with CSS pixels as the unit of what is drawn. Null where it cannot be drawn on. */
export function sharp(canvas: HTMLCanvasElement, width: number, height: number): CanvasRenderingContext2D | null {
  const ratio = Math.min(3, window.devicePixelRatio || 1), context = canvas.getContext("2d");
  if (!context || width === 0 || height === 0) return null;
  const across = Math.round(width * ratio), down = Math.round(height * ratio);
  if (canvas.width !== across || canvas.height !== down) {
    canvas.width = across;
    canvas.height = down;
  }
  context.setTransform(across / width, 0, 0, down / height, 0, 0);
  context.clearRect(0, 0, width, height);
  return context;
}

/** Returns the colour of a variable of the style, e.g. "--c0", as it is now, in the light or the dark scheme. */
export const styleColour = (variable: string): string => getComputedStyle(document.documentElement).getPropertyValue(variable).trim();

const dark = typeof matchMedia === "undefined" ? null : matchMedia("(prefers-color-scheme: dark)");

/** Colours that are read once for each scheme. */
export class Palette {
  private known = new Map<string, string>();
  constructor() {
    dark?.addEventListener("change", () => this.known.clear());
  }
  /** Returns the colour of a variable, e.g. "--c0". */
  of(name: string): string {
    let colour = this.known.get(name);
    if (colour === undefined) this.known.set(name, (colour = styleColour(name)));
    return colour;
  }
}
