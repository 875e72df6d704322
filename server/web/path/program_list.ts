/** The list of the lines near the cursor. */
import { h } from "../base/dom";
import { number } from "../base/numbers";
import type { Program } from "./program";
import { t } from "./words";

export class ProgramList {
  readonly element: HTMLElement;
  private readonly list = h("ol", { class: "path-lines", tabindex: 0 });
  private readonly title = h("h3");
  private rows: HTMLElement[] = [];
  private shownVisits: unknown = null;
  private current = -1;
  private inView: [number, number] = [0, -1]; // lines that are in view without scrolling
  private scrolled = 0; // px to which the list was scrolled for them
  constructor(private readonly program: Program, private readonly seek: (row: number) => void, step: (lines: 1 | -1) => void) {
    this.element = h("aside", { class: "path-program" }, this.title, this.list);
    this.name(t("program"));
    // One listener for all lines.
    this.list.addEventListener("click", (event) => {
      const index = this.rows.indexOf((event.target as Element).closest("li") as HTMLElement);
      const visit = this.program.visits[index];
      if (visit) this.seek(visit.first);
    });
    this.list.addEventListener("scroll", () => {
      if (Math.abs(this.list.scrollTop - this.scrolled) > 1) this.inView = [0, -1]; // somebody has scrolled it
    }, { passive: true });
    this.list.addEventListener("keydown", (event) => {
      if (event.key !== "ArrowUp" && event.key !== "ArrowDown") return;
      event.preventDefault();
      event.stopPropagation();
      step(event.key === "ArrowUp" ? -1 : 1);
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
    if (scroll && (index < this.inView[0] || index > this.inView[1])) this.reveal(line, index);
  }
  /** Scrolls a line into the middle. That takes longer than the rest of a frame of the playback, and is not done for each line. */
  private reveal(line: HTMLElement, index: number): void {
    const height = this.list.clientHeight, each = Math.max(1, line.offsetHeight), around = Math.max(0, Math.floor(height / 2 / each) - 2);
    // scrollIntoView would move the page, too.
    this.list.scrollTop = line.offsetTop - height / 2 + each / 2;
    this.scrolled = this.list.scrollTop;
    this.inView = [index - around, index + around];
  }
  private name(title: string): void {
    this.title.textContent = title;
    this.list.setAttribute("aria-label", title);
    this.element.setAttribute("aria-label", title);
  }
  private build(): void {
    // Without a program its entries are segments of the document.
    const first = this.program.visits[0];
    if (first) this.name(t(first.text === null ? "segments" : "program"));
    this.shownVisits = this.program.visits;
    this.current = -1;
    this.inView = [0, -1];
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
