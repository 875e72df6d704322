/** Colours of limits, the same in every panel: the eight that matter most in the order of their time, greys for what is no limit. */
import type { Limit } from "./planned_job";

const noLimits = ["ahead", "stop", "dwell"];

/** Returns the name of a colour variable of the style for every limit, by its number: --c0 … --c7 for the limits with most time, --strong for further ones
 *  and for stops and dwells, --rapid for what prepares for something later. */
export function limitColours(limits: readonly Limit[]): Map<number, string> {
  const colours = new Map<number, string>();
  [...limits]
    .filter((limit) => !noLimits.includes(limit.name))
    .sort((a, b) => b.time - a.time || a.id - b.id)
    .forEach((limit, k) => colours.set(limit.id, k < 8 ? `--c${k}` : "--strong"));
  for (const limit of limits) if (noLimits.includes(limit.name)) colours.set(limit.id, limit.name === "ahead" ? "--rapid" : "--strong");
  return colours;
}
