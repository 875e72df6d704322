/** A row of the list; on a narrow screen the style makes it a card. */
import de from "../texts/de/jobs.json";
import en from "../texts/en/jobs.json";
import { at } from "../base/api";
import { fill, h } from "../base/dom";
import { duration } from "../base/numbers";
import { showTimes } from "../base/page";
import { texts } from "../base/texts";
import { possible, type Action } from "./bulk";
import type { ListedJob } from "./list";

const t = texts(en, de);

/** Returns the name of a kind in the language of the page. */
export function kindName(kind: string): string {
  const key = `kind_${kind}`;
  return key in en ? t(key as "kind_contour") : kind;
}

/** Returns a time element as the service writes it: UTC, until showTimes() makes it relative. */
export function timeOf(iso: string): HTMLTimeElement {
  return h("time", { datetime: iso }, `${iso.slice(0, 10)} ${iso.slice(11, 19)} UTC`);
}

/** Returns state, bar and place in the queue. */
export function stateOf(job: ListedJob): (Node | string)[] {
  const parts: (Node | string)[] = [h("span", { class: `state ${job.state}` }, t(`state_${job.state}`))];
  if (job.state === "running") {
    const share = Math.floor(job.progress.fraction * 100 + 1e-9);
    parts.push(" ", h("progress", { max: 100, value: share, "aria-label": t("progress") }), ` ${share} %`);
    if (job.progress.remaining !== null) parts.push(" ", h("span", { class: "soft" }, t("remaining", { time: rounded(job.progress.remaining) })));
  }
  if (job.queue) parts.push(" ", h("span", { class: "soft" }, job.queue.ahead === 0 ? t("is_next") : t("ahead", { n: job.queue.ahead })));
  return parts;
}

const rounded = (seconds: number): string => (seconds < 90 ? `${Math.max(1, Math.round(seconds))} s` : `${Math.round(seconds / 60)} min`);

export interface RowHooks {
  act: (action: Action, job: ListedJob) => void;
  ticked: (id: string, on: boolean) => void;
}

export class JobRow {
  readonly element: HTMLTableRowElement;
  readonly tick: HTMLInputElement;
  private readonly status = h("td", { class: "status" });
  private readonly motion = h("td", { class: "n duration" });
  private readonly actions = h("td", { class: "actions" });
  private shown = "";
  private state = "";
  constructor(private job: ListedJob, private readonly hooks: RowHooks) {
    const name = job.name || job.id;
    this.tick = h("input", { type: "checkbox", "aria-label": t("tick", { name }), change: () => hooks.ticked(job.id, this.tick.checked) });
    const label = job.name ? h("bdi", {}, job.name) : h("code", {}, job.id);
    this.element = h("tr", { "data-id": job.id },
      h("td", { class: "tick" }, this.tick),
      h("th", { scope: "row" }, h("a", { href: at(`/jobs/${job.id}`) }, label)),
      h("td", { class: "kind" }, kindName(job.kind)),
      h("td", { class: "reference" }, h("bdi", {}, job.reference)),
      this.status, this.motion, h("td", { class: "age" }, timeOf(job.created_at)), this.actions);
    showTimes(this.element);
    this.update(job);
  }
  /** Shows what has changed of the job. */
  update(job: ListedJob): void {
    this.job = job;
    const { fraction, remaining } = job.progress;
    const shown = JSON.stringify([job.state, fraction, remaining, job.queue, job.duration]);
    if (shown === this.shown) return;
    this.shown = shown;
    fill(this.status, ...stateOf(job));
    fill(this.motion, job.duration == null ? "" : duration(job.duration));
    if (job.state === this.state) return;
    this.state = job.state;
    const button = (action: Action): HTMLElement | false =>
      possible(action, job.state) && h("button", { type: "button", "aria-label": `${t(action)}: ${job.name || job.id}`, click: () => this.hooks.act(action, this.job) }, t(action));
    fill(this.actions, button("cancel"), button("retry"), job.state !== "queued" && button("delete"));
  }
}
