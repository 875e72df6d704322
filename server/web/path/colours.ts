/** Colours of a path: a sequential scale for speeds and use, and eight that differ for limits, blocks and tools. */
import type { PathData } from "./path_data";

/** What a path is coloured by. */
export type ColourBy = "speed" | "limit" | "use" | "block" | "tool";

type Rgb = [number, number, number];

// Anchors of viridis (Smith & van der Walt 2015), whose lightness grows evenly and which the colour-blind can read. On white its light end is left out, on
// black its dark end, so that every colour stands out from the ground.
const viridis: Rgb[] = [
  [68, 1, 84], [72, 40, 120], [62, 73, 137], [49, 104, 142], [38, 130, 142], [31, 158, 137], [53, 183, 121], [110, 206, 88], [181, 222, 43], [253, 231, 37],
];

/** Returns the colour of a share 0 … 1 as red, green, blue 0 … 255: dark is slow on white, light is fast; the same order on black. */
export function sequential(share: number, dark: boolean): Rgb {
  const [from, to] = dark ? [0.26, 1] : [0, 0.84];
  const place = (from + (to - from) * Math.max(0, Math.min(1, share))) * (viridis.length - 1);
  const k = Math.min(viridis.length - 2, Math.floor(place)), u = place - k;
  const a = viridis[k]!, b = viridis[k + 1]!;
  return [0, 1, 2].map((c) => Math.round(a[c]! + u * (b[c]! - a[c]!))) as Rgb;
}

export const css = ([r, g, b]: Rgb): string => `rgb(${r},${g},${b})`;

/** Number of colours of a sequential scale: chords of one colour are drawn in one stroke. */
export const steps = 24;

/** Range of the speeds of cuts, mm/s, which the scale spans: rapids would drown it. Without cuts it is that of all. */
export function speedRange(path: PathData): [number, number] {
  const { speed, mode } = path.columns;
  let low = Infinity, high = 0;
  const take = (all: boolean): void => {
    for (let i = 0; i < path.count; ++i)
      if (i > 0 && !path.begin[i] && (all || !mode || mode[i]! > 0.5)) {
        low = Math.min(low, speed?.[i] ?? 0);
        high = Math.max(high, speed?.[i] ?? 0);
      }
  };
  take(false);
  if (!(high > 0)) take(true);
  return low <= high ? [Math.min(low, high), high] : [0, 1];
}

/** Colours of chords: `kind[i]` is the number of the colour of the chord to vertex i in `colours`. */
export interface Colouring {
  kind: Uint16Array;
  colours: string[];
}

/** Returns whether the chord to vertex i is a rapid move: mode belongs to the row at its end. */
export const isRapid = (path: PathData, i: number): boolean => (path.columns.mode ? path.columns.mode[i]! < 0.5 : false);

export interface Palette {
  dark: boolean;
  rapid: string;
  other: string; // what has no colour of its own
  distinct: string[]; // eight colours
}

/** Returns the colour of every chord. Rapids have the palette's grey, except among limits. `speeds`: range of the scale, mm/s; `limits`: colours by the
 *  number of a limit; `tools`: number of the tool by vertex. */
export function colouring(
  path: PathData, by: ColourBy, palette: Palette, speeds: readonly [number, number], limits: ReadonlyMap<number, string>, tools?: (line: number) => number,
): Colouring {
  const kind = new Uint16Array(path.count);
  const colours: string[] = [palette.rapid, palette.other];
  const { speed, use, limit, block, line } = path.columns;
  if (by === "speed" || by === "use") {
    for (let k = 0; k < steps; ++k) colours.push(css(sequential(k / (steps - 1), palette.dark)));
    const [low, high] = by === "use" ? [0, 1] : speeds;
    for (let i = 0; i < path.count; ++i) {
      const value = (by === "use" ? use?.[i] : speed?.[i]) ?? 0;
      const share = high > low ? (value - low) / (high - low) : 1;
      kind[i] = by === "speed" && isRapid(path, i) ? 0 : 2 + Math.max(0, Math.min(steps - 1, Math.round(share * (steps - 1))));
    }
    return { kind, colours };
  }
  const numbers = new Map<number, number>(); // from the number of a limit, a block, a tool to that of its colour
  if (by === "limit") {
    for (const [id, colour] of limits) {
      numbers.set(id, colours.length);
      colours.push(colour);
    }
    for (let i = 0; i < path.count; ++i) kind[i] = numbers.get(Math.round(limit?.[i] ?? -1)) ?? 1;
    return { kind, colours };
  }
  colours.push(...palette.distinct);
  for (let i = 0; i < path.count; ++i) {
    const number = by === "block" ? Math.round(block?.[i] ?? 0) : tools ? tools(Math.round(line?.[i] ?? 0)) : 0;
    kind[i] = isRapid(path, i) ? 0 : 2 + (number % palette.distinct.length);
  }
  return { kind, colours };
}
