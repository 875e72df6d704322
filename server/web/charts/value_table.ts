/** The values of charts as a table: what is drawn, for those who cannot see it. */
import { h } from "../base/dom";
import { number } from "../base/numbers";
import type { ChartData } from "./chart_data";

const lines = 25;

export interface TableColumn {
  name: string;
  title: string;
  unit: string;
  scale: number; // shown value / value
}
export interface TableRange {
  first: number; // rows
  end: number;
  cycle: number;
  abscissa: string; // heads of the columns
  row: string;
  limit: string;
  limitName: (id: number) => string;
}

export function fillTable(data: ChartData, columns: readonly TableColumn[], range: TableRange): HTMLTableElement {
  const head = h("tr", {}, h("th", { scope: "col", class: "n" }, range.row), h("th", { scope: "col", class: "n" }, range.abscissa));
  for (const column of columns) head.append(h("th", { scope: "col", class: "n" }, column.title + (column.unit ? ", " + column.unit : "")));
  head.append(h("th", { scope: "col" }, range.limit));
  const body = h("tbody"), count = Math.min(lines, range.end - range.first);
  for (let k = 0; k < count; ++k) {
    const from = range.first + Math.floor((k * (range.end - range.first)) / count), to = range.first + Math.floor(((k + 1) * (range.end - range.first)) / count);
    const row = h("tr", {}, h("th", { scope: "row", class: "n k" }, to - from > 1 ? `${from} – ${to - 1}` : String(from)), h("td", { class: "n" }, number(from * range.cycle)));
    for (const column of columns) {
      let low = Infinity, high = -Infinity;
      for (const part of data.parts(column.name, from, to)) {
        const values = part.envelope.range(column.name, part.from, part.to);
        if (values) [low, high] = [Math.min(low, values[0]), Math.max(high, values[1])];
      }
      const least = number(low * column.scale, 4), most = number(high * column.scale, 4);
      row.append(h("td", { class: "n k" }, low > high ? "–" : least === most ? least : `${least} … ${most}`));
    }
    const part = data.parts("limit", from, to)[0];
    row.append(h("td", {}, part ? range.limitName(part.envelope.most(part.envelope.find(from), "limit")) : "–"));
    body.append(row);
  }
  return h("table", {}, h("thead", {}, head), body);
}
