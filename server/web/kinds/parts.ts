/** Small pieces of which the views of kinds are made: figures, legends, tables, charts with headings. */
import de from "../texts/de/kinds.json";
import en from "../texts/en/kinds.json";
import { type Columns, getColumns, getJson } from "../base/api";
import { append, h } from "../base/dom";
import type { PlannedJob } from "../base/planned_job";
import { texts } from "../base/texts";
import type { Curve } from "./chart";

export const t = texts(en, de);
export type TextKey = keyof typeof en & string;

type Content = Node | string | number | null | undefined | false;

/** Returns key figures: a large value above its name. */
export function figures(...list: ([string, string] | null | false | undefined)[]): HTMLElement {
  const element = h("dl", { class: "key-figures" });
  for (const each of list) if (each) element.append(h("div", {}, h("dt", {}, each[0]), h("dd", {}, each[1])));
  return element;
}

/** Returns a legend: the colour of each curve and its name. */
export function legend(...list: ({ colour: string; name: string; kind?: "line" | "dashed" | "box" | "dot" } | null | false)[]): HTMLElement {
  const element = h("p", { class: "marks" });
  for (const each of list) {
    if (!each) continue;
    const mark = h("i", { class: `mark ${each.kind ?? "line"}`, "aria-hidden": "true" });
    mark.style.setProperty("--mark", `var(${each.colour})`);
    element.append(h("span", {}, mark, each.name));
  }
  return element;
}

/** Returns a table; columns whose heading begins with "#" hold numbers and lose the sign. */
export function table(caption: string | null, headings: string[], rows: Content[][]): HTMLElement {
  const numeric = headings.map((each) => each.startsWith("#"));
  const head = h("tr");
  headings.forEach((each, k) => head.append(h("th", { scope: "col", class: numeric[k] ? "n" : null }, each.replace(/^#/, ""))));
  const body = h("tbody");
  for (const row of rows) {
    const line = h("tr");
    row.forEach((each, k) => line.append(k === 0 ? h("th", { scope: "row", class: numeric[0] ? "n" : null }, each) : h("td", { class: numeric[k] ? "n" : null }, each)));
    body.append(line);
  }
  const element = h("table", { class: "data" }, caption ? h("caption", { class: "visually-hidden" }, caption) : null, h("thead", {}, head), body);
  return h("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": caption ?? t("table") }, element);
}

/** Returns a table that is folded, for those who do not see a picture; it is made when it is unfolded. */
export function folded(summary: string, make: () => Node): HTMLDetailsElement {
  const element = h("details", {}, h("summary", {}, summary));
  element.addEventListener("toggle", () => {
    if (element.open && element.childElementCount === 1) element.append(make());
  });
  return element;
}

/** Returns a panel with a heading. */
export function panel(title: string, ...content: Content[]): HTMLElement {
  const element = h("section", { class: "panel" }, h("h3", {}, title));
  append(element, ...content);
  return element;
}

/** Asks for some parts of a job's result. */
export const resultParts = <T>(id: string, ...parts: string[]): Promise<T> => getJson<T>(`/v1/jobs/${id}/result?parts=${parts.join(",")}`);

/** The least and largest values of some columns in intervals of the series. */
export interface Envelope {
  rows: Float64Array; // first row of each interval
  low: Map<string, Float64Array>;
  high: Map<string, Float64Array>;
}

/** Returns the values of an answer with points= by columns. */
export function envelopeOf({ names, data }: Columns): Envelope {
  const count = Math.floor(data.length / names.length), envelope: Envelope = { rows: new Float64Array(count), low: new Map(), high: new Map() };
  names.forEach((name, column) => {
    const values = new Float64Array(count);
    for (let k = 0; k < count; ++k) values[k] = data[k * names.length + column]!;
    if (name === "index") envelope.rows = values;
    else if (name.endsWith("_min")) envelope.low.set(name.slice(0, -4), values);
    else if (name.endsWith("_max")) envelope.high.set(name.slice(0, -4), values);
  });
  return envelope;
}

/** Asks for the envelope of columns of the whole series in about `points` intervals. */
export const envelope = async (id: string, columns: string[], points: number, rest = ""): Promise<Envelope> =>
  envelopeOf(await getColumns(`/v1/jobs/${id}/setpoints?points=${points}&columns=${columns.join(",")}&format=f32${rest}`));

/** Returns a column of an envelope as a curve over x. */
export function curveOf(envelope: Envelope, column: string, x: ArrayLike<number>, name: string, colour: string): Curve | null {
  const low = envelope.low.get(column), high = envelope.high.get(column);
  if (!low || !high) return null;
  const exact = low.every((value, k) => value === high[k]);
  return exact ? { name, colour, x, low } : { name, colour, x, low, high };
}

/** Returns a button that plays and pauses a slider, which moves by `step` a frame's time. */
export function player(slider: HTMLInputElement, secondsForAll: number): HTMLButtonElement {
  const button = h("button", { type: "button", "aria-pressed": "false" }, t("play"));
  let running = false, last = 0, value = 0;
  const turn = (on: boolean): void => {
    running = on;
    button.textContent = on ? t("pause") : t("play");
    button.setAttribute("aria-pressed", String(on));
  };
  const frame = (now: number): void => {
    if (!running || !button.isConnected) return turn(false);
    const least = Number(slider.min), most = Number(slider.max);
    value += (Math.min(0.1, (now - last) / 1000) / secondsForAll) * (most - least);
    last = now;
    if (value >= most) {
      value = most;
      turn(false);
    }
    if (slider.value !== String(value)) {
      slider.value = String(value);
      slider.dispatchEvent(new Event("input"));
    }
    if (running) requestAnimationFrame(frame);
  };
  button.addEventListener("click", () => {
    turn(!running);
    if (!running) return;
    value = Number(slider.value) >= Number(slider.max) ? Number(slider.min) : Number(slider.value);
    last = performance.now();
    requestAnimationFrame(frame);
  });
  slider.addEventListener("pointerdown", () => turn(false));
  return button;
}

/** Calls once when an element comes near to what is seen. */
export function whenSeen(element: Element, act: () => void): void {
  const observer = new IntersectionObserver((entries) => {
    if (!entries.some((each) => each.isIntersecting)) return;
    observer.disconnect();
    act();
  }, { rootMargin: "400px" });
  observer.observe(element);
}

/** Returns what a chart follows of a job's view: the shown part of x, the cursor and what the pointer does. x of row k: origin + k * step. */
export function followed(job: PlannedJob, origin: number, step: number) {
  const { view } = job;
  return {
    x: () => {
      const { first, count } = view.get();
      return { from: origin + first * step, to: origin + (first + count - 1) * step };
    },
    cursor: () => {
      const { row } = view.get();
      return row === null ? null : origin + row * step;
    },
    point: (x: number | null) => view.point(x === null ? null : Math.round((x - origin) / step)),
    pick: (x: number) => view.set({ row: Math.round((x - origin) / step), locked: true }),
  };
}

/** Draws charts anew when the shown part changes, and their cursors when the cursor moves. */
export function follow(job: PlannedJob, charts: { redraw(): void; move(): void }[]): void {
  job.view.follow((_view, changed) => {
    for (const each of charts) changed.has("first") || changed.has("count") ? each.redraw() : each.move();
  });
}
