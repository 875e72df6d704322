/** The path as a table: places at even times. */
import { h } from "../base/dom";
import { fixed, number } from "../base/numbers";
import { placeAt, vertexBefore, type PathData } from "./path_data";
import { t } from "./words";

const lines = 40;

/** Returns the table; its rows are whole rows of the series that are vertices or lie on chords. */
export function pathTable(path: PathData, rows: number, cycle: number): HTMLElement {
  const names = ["x", "y", "z"].slice(0, path.dimension), { v, line } = path.columns;
  const head = h("tr", {}, h("th", { class: "n", scope: "col" }, t("row")), h("th", { class: "n", scope: "col" }, t("time")));
  for (const name of names) head.append(h("th", { class: "n", scope: "col" }, `${name}, mm`));
  if (v) head.append(h("th", { class: "n", scope: "col" }, "v, mm/s"));
  if (line) head.append(h("th", { class: "n", scope: "col" }, t("line", { n: "" }).trim()));
  const body = h("tbody");
  const count = Math.min(lines, rows - 1);
  for (let k = 0; k <= count; ++k) {
    const row = count === 0 ? 0 : Math.round((k * (rows - 1)) / count), place = placeAt(path, row);
    if (!place) continue;
    const i = vertexBefore(path, row), entry = h("tr", {}, h("td", { class: "n" }, row), h("td", { class: "n" }, fixed(row * cycle, 4)));
    names.forEach((_, axis) => entry.append(h("td", { class: "n" }, fixed(place[axis]!, 3))));
    if (v) entry.append(h("td", { class: "n" }, number(v[i]!, 4)));
    if (line) entry.append(h("td", { class: "n" }, line[i]!));
    body.append(entry);
  }
  return h("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": t("table") }, h("table", {}, h("thead", {}, head), body), h("p", { class: "soft" }, t("tolerance", { tolerance: number(path.tolerance, 2) })));
}
