/** Colours of the page's scheme, read from its style. */
import { styleColour } from "../base/canvas";
import type { Palette } from "./colours";
import type { LayerColours } from "./layer";

export interface Scheme extends Palette, LayerColours {
  faint: string; // rows that the curves do not show
}

/** Returns the colours of the scheme that is in force. */
export function readScheme(): Scheme {
  const of = styleColour;
  return {
    dark: matchMedia("(prefers-color-scheme: dark)").matches,
    rapid: of("--rapid"), other: of("--strong"), faint: of("--line"),
    distinct: [0, 1, 2, 3, 4, 5, 6, 7].map((k) => of(`--c${k}`)),
    text: of("--text"), back: of("--back"), cursor: of("--c1"), coarse: of("--c0"),
  };
}
