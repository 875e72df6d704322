/** The list of the lines near the cursor. */
import { h } from "../base/dom";
import { number } from "../base/numbers";
import type { Program } from "./program";
import { t } from "./words";

export class ProgramList {
  readonly element: HTMLElement;
  private readonly list = h("ol", { class: "path-lines", tabindex: 0 });
  private rows: HTMLElement[] = [];
  private shownVisits: unknown = null;
  private current = -1;
  constructor(private readonly program: Program, isProgram: boolean, private readonly seek: (row: number) => void) {
    const title = t(isProgram ? "program" : "segments");
    this.list.setAttribute("aria-label", title);
    this.element = h("aside", { class: "path-program", "aria-label": title }, h("h3", {}, title), this.list);
    // One listener for all lines.
    this.list.addEventListener("click", (event) => {
      const index = this.rows.indexOf((event.target as Element).closest("li") as HTMLElement);
      const visit = this.program.visits[index];
      if (visit) this.seek(visit.first);
    });
  }
  /** Shows the lines around a row, and which of them it belongs to. `scroll`: the list follows. */
  show(row: number | null, scroll: boolean): void {
    if (this.shownVisits !== this.program.visits) this.build();
    const index = row === null ? -1 : this.program.find(row);
    if (index === this.current) return;
    this.rows[this.current]?.removeAttribute("aria-current");
    this.current = index;
    const line = this.rows[index];
    if (!line) return;
    line.setAttribute("aria-current", "true");
    // scrollIntoView would move the page, too.
    if (scroll) this.list.scrollTop = line.offsetTop - this.list.offsetTop - this.list.clientHeight / 2 + line.offsetHeight / 2;
  }
  private build(): void {
    this.shownVisits = this.program.visits;
    this.current = -1;
    this.rows = this.program.visits.map((visit) =>
      h(
        "li", { class: visit.mode === "cut" ? null : "rapid" },
        h(
          "button", { type: "button", tabindex: -1 }, h("span", { class: "n" }, visit.number),
          visit.text === null ? h("span", {}, `${t(visit.mode === "cut" ? "cut" : "rapid")} ${number(visit.length, 4)} mm`) : h("code", {}, h("bdi", {}, visit.text.trim() || "·")),
        ),
      ),
    );
    this.list.replaceChildren(...this.rows);
  }
}
