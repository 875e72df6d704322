/** Places in the text of a job's page that set the cursor: slowest lines, and where a check found its value. */
import { fill, h } from "../base/dom";
import type { PlannedJob } from "../base/planned_job";
import { texts } from "../base/texts";
import { around } from "../charts/stretches";
import de from "../texts/de/job.json";
import en from "../texts/en/job.json";

const t = texts(en, de);

const showCurves = (): void =>
  document.getElementById("curves")?.scrollIntoView({ block: "nearest", behavior: matchMedia("(prefers-reduced-motion: reduce)").matches ? "auto" : "smooth" });

/** Makes a cell's text a button. */
function makeButton(cell: HTMLElement, act: () => void): void {
  const text = cell.textContent ?? "";
  if (text === "" || cell.querySelector("button")) return;
  fill(cell, h("button", { type: "button", class: "link", title: t("show_place"), click: act }, text));
}

export function linkPlaces(job: PlannedJob, root: ParentNode = document): void {
  for (const row of root.querySelectorAll<HTMLTableRowElement>("#why tr[data-first]")) {
    const first = Number(row.dataset.first), count = Number(row.dataset.count);
    makeButton(row.cells[0]!, () => {
      job.view.set({ ...around({ first, count }), row: first + Math.floor(count / 2), locked: true });
      showCurves();
    });
  }
  for (const cell of root.querySelectorAll<HTMLElement>("#verification td[data-at]")) {
    const per = cell.dataset.unit === "s" ? job.seconds : cell.dataset.unit === job.unit ? job.cycle : 0;
    if (per === 0) continue; // a place on the path, say, is no row
    const row = Math.round(Number(cell.dataset.at) / per), width = Math.max(200, Math.round(job.rows / 200));
    makeButton(cell, () => {
      job.view.set({ first: row - Math.floor(width / 2), count: width, row, locked: true });
      showCurves();
    });
  }
}
