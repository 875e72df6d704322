/** The legend of a path's colours. */
import { styleColour } from "../base/canvas";
import { fill, h } from "../base/dom";
import { number, percent } from "../base/numbers";
import type { Limit } from "../base/planned_job";
import { nameOf } from "../base/texts";
import { css, sequential, type ColourBy } from "./colours";
import type { Scheme } from "./palette";
import { t } from "./words";

function swatch(colour: string, text: string): HTMLElement {
  const mark = h("i", { class: "path-swatch" });
  mark.style.backgroundColor = colour;
  return h("span", { class: "entry" }, mark, text);
}

function scaleOf(dark: boolean, low: string, high: string, title: string): HTMLElement {
  const bar = h("i", { class: "scale" });
  bar.style.backgroundImage = `linear-gradient(to right, ${Array.from({ length: 13 }, (_, k) => css(sequential(k / 12, dark))).join(",")})`;
  return h("span", { class: "entry" }, low, bar, high, " ", title);
}

export interface LegendFacts {
  by: ColourBy;
  scheme: Scheme;
  speeds: readonly [number, number];
  hasModes: boolean;
  rapids: boolean;
  limits: readonly Limit[];
  limitVariables: ReadonlyMap<number, string>;
  tools: readonly number[];
}

/** Writes the legend into an element. */
export function fillLegend(element: HTMLElement, facts: LegendFacts): void {
  const { by, scheme, speeds } = facts, entries: HTMLElement[] = [];
  if (by === "speed") entries.push(scaleOf(scheme.dark, number(speeds[0], 3), number(speeds[1], 4), t(facts.hasModes ? "legend_speed" : "legend_speed_all")));
  if (by === "use") entries.push(scaleOf(scheme.dark, "0", "100", t("legend_use")));
  if (by === "block") entries.push(...scheme.distinct.map((colour) => swatch(colour, "")), h("span", { class: "soft" }, t("legend_blocks", { n: scheme.distinct.length })));
  if (by === "tool") entries.push(...facts.tools.map((tool) => swatch(scheme.distinct[tool % scheme.distinct.length]!, t("legend_tools", { n: tool }))));
  if (by === "limit") {
    for (const limit of [...facts.limits].sort((a, b) => b.time - a.time))
      if (limit.share > 0) entries.push(swatch(styleColour(facts.limitVariables.get(limit.id) ?? "--strong"), `${nameOf(limit.name)} ${percent(limit.share)}`));
  } else if (facts.hasModes && facts.rapids) {
    entries.push(swatch(scheme.rapid, t("legend_rapid")));
  }
  fill(element, ...entries);
}
