/** The ribbon of limits and the curves over time, angle or path length. */
import { append, fill, h } from "../base/dom";
import { limitColours } from "../base/limit_colours";
import { fixed, number, percent } from "../base/numbers";
import { onKey } from "../base/page";
import type { Limit, PlannedJob } from "../base/planned_job";
import { countSegments } from "../base/segments";
import { nameOf, texts } from "../base/texts";
import { keepInAddress, readAddress } from "../base/view";
import { Delay, NextFrame } from "../base/work";
import de from "../texts/de/charts.json";
import en from "../texts/en/charts.json";
import { pathLength, proportional, type Abscissa } from "./abscissa";
import { ChartData, RowWindow } from "./chart_data";
import { chartColumns, defaultColumns, quantities, type ChartColumn } from "./columns";
import { drawCurve, type Frame } from "./curve";
import { followGestures } from "./gestures";
import { Palette } from "../base/canvas";
import { begin } from "./picture";
import { drawOverview, drawRibbon, type Shares } from "./ribbon";
import { around, longestStretch } from "./stretches";
import { angleTicks, ticks, type Ticks } from "./ticks";
import { timeTicks } from "./time_ticks";
import { fillTable } from "./value_table";

const t = texts(en, de);
const right = 6; // px beside the pictures
const otherNames: Record<string, () => string> = { deviation: () => t("name_deviation"), brake: () => t("name_brake"), tension: () => t("name_tension") };
const addressAfter = 250; // ms
const statesName = ["ahead", "stop", "dwell"];

/** Returns the name of a column as the page shows it. */
export function columnName(column: ChartColumn, kind: string): string {
  if (column.quantity === "other") return otherNames[column.name]?.() ?? column.name;
  if (column.quantity === "use") return t("path_use");
  if (column.axis === "" && kind !== "motion_law") return column.quantity === "position" ? t("path_position") : column.quantity === "velocity" ? t("path_velocity") : t(column.quantity);
  return column.axis === "" ? t(column.quantity) : `${t(column.quantity)} ${column.axis}`;
}

interface Chart {
  column: ChartColumn;
  canvas: HTMLCanvasElement;
  value: HTMLElement;
  box: HTMLElement;
}

class Curves {
  private readonly all: ChartColumn[];
  private shown: string[];
  private overLength: boolean;
  private readonly view;
  private readonly data: ChartData;
  private readonly rows: RowWindow;
  private readonly palette = new Palette();
  private charts: Chart[] = [];
  private limits: readonly Limit[] = [];
  private colours = new Map<number, string>();
  private only: number | null = null; // the limit that is looked at in the ribbon
  private readonly frame = new NextFrame(() => this.drawNow());
  private readonly address = new Delay(addressAfter);
  private legendSays = "";

  private readonly heading = h("h2", {}, t("title"));
  private readonly stack = h("div", { class: "charts", role: "group", "aria-label": t("title") });
  private readonly ribbon = h("canvas", { class: "ribbon", role: "img", "aria-label": t("ribbon") });
  private readonly axis = h("canvas", { class: "axis", "aria-hidden": "true" });
  private readonly list = h("div", { class: "chart-list" });
  private readonly line = h("div", { class: "cursor-line", hidden: true });
  private readonly selection = h("div", { class: "selection", hidden: true });
  private readonly overview = h("canvas", { class: "overview", role: "img", "aria-label": t("overview") });
  private readonly readout = h("output", { class: "readout" });
  private readonly legend = h("div", { class: "legend" });
  private readonly lock = h("button", { type: "button", "aria-pressed": "false", click: () => this.toggleLock() }, t("lock"));
  private readonly trouble = h("p", { class: "error", hidden: true });
  private readonly table = h("details", { toggle: () => this.drawTable() }, h("summary", {}, t("table")));
  private readonly tableBody = h("div", { class: "scroll", tabindex: "0" });

  constructor(private readonly section: HTMLElement, private readonly job: PlannedJob) {
    this.view = job.view;
    this.all = chartColumns(job.columns, job.units, job.kind);
    const state = readAddress(), known = new Set(this.all.map((column) => column.name));
    const chosen = (state.cols ?? "").split(",").filter((name) => known.has(name));
    this.shown = chosen.length > 0 ? chosen : defaultColumns(this.all, job.kind).filter((name) => known.has(name));
    this.overLength = state.x === "s" && this.hasLength();
    this.data = new ChartData(job, () => this.stack.clientWidth - this.left() - right, () => this.loaded());
    this.rows = new RowWindow(job, () => this.showCursor());
    this.build();
    this.view.follow((_view, changed) => {
      if (changed.has("first") || changed.has("count")) {
        this.data.want(this.wanted());
        this.draw();
      }
      if (changed.has("row") || changed.has("locked")) this.showCursor();
      this.keep();
    });
    new ResizeObserver(() => this.draw()).observe(this.stack);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
    window.addEventListener("hashchange", () => this.readAgain());
    void job.limits().then((answer) => {
      this.limits = answer.limits;
      this.colours = limitColours(answer.limits);
      const limited = answer.limits.some((limit) => limit.unit !== null && limit.share > 0);
      this.ribbon.hidden = this.legend.hidden = !limited;
      if (!limited) this.heading.textContent = t("curves");
      this.markTable();
      this.draw();
    });
    this.data.want(this.wanted(), true);
  }

  private hasLength(): boolean {
    return this.job.independent === "time" && this.job.kind !== "motion_law" && this.job.columns.includes("s");
  }
  private left(): number {
    return this.stack.clientWidth < 480 ? 46 : 58;
  }
  private wanted(): string[] {
    const list = this.shown.includes("use") ? [...this.shown] : [...this.shown, "use"];
    if (this.overLength && !list.includes("s")) list.push("s");
    list.push("limit");
    return list;
  }

  private build(): void {
    const button = (text: string, label: string, act: () => void): HTMLElement => h("button", { type: "button", "aria-label": label, title: label, click: act }, text);
    const over = this.hasLength()
      ? h("label", {}, t("over") + " ", h("select", { change: (event: Event) => this.changeAxis((event.target as HTMLSelectElement).value === "s") },
          h("option", { value: "t", selected: !this.overLength }, t("over_time")), h("option", { value: "s", selected: this.overLength }, t("over_length"))))
      : null;
    this.stack.append(this.ribbon, this.axis, this.list, this.line, this.selection);
    this.table.append(this.tableBody);
    append(this.section, this.heading,
           h("div", { class: "tools no-print" }, button("−", t("farther"), () => this.zoomBy(2)), button("+", t("closer"), () => this.zoomBy(0.5)),
             h("button", { type: "button", click: () => this.showWhole() }, t("whole")), over, this.lock, this.readout),
           this.legend, this.stack, this.overview, this.trouble, h("p", { class: "soft hint no-print" }, t("hint")), this.chooser(), this.table);
    this.buildCharts();
    const rowAt = (x: number): number => this.rowAt(x);
    followGestures(this.stack, {
      point: (x) => this.view.point(x === null ? null : rowAt(x)),
      click: (x) => this.clickAt(rowAt(x)),
      zoom: (x, factor) => this.view.zoom(rowAt(x), factor),
      pan: (pixels) => this.pan(pixels),
      select: (from, to, done) => this.select(from, to, done),
    });
    followGestures(this.overview, {
      point: () => {},
      click: (x) => this.centre(this.overviewRow(x)),
      zoom: (_x, factor) => this.zoomBy(factor),
      pan: (pixels) => this.view.set({ first: this.view.get().first - (pixels / Math.max(1, this.plotWidth())) * this.job.rows }),
      select: null,
    });
    onKey("+", t("key_closer"), () => this.zoomBy(0.5));
    onKey("-", t("key_farther"), () => this.zoomBy(2));
    onKey("ArrowLeft", t("key_left"), (event) => this.step(event.shiftKey ? -10 : -1));
    onKey("ArrowRight", t("key_right"), (event) => this.step(event.shiftKey ? 10 : 1));
    onKey("PageUp", t("key_page_left"), () => this.view.set({ first: this.view.get().first - this.view.get().count * 0.8 }));
    onKey("PageDown", t("key_page_right"), () => this.view.set({ first: this.view.get().first + this.view.get().count * 0.8 }));
    onKey("Home", t("key_home"), () => this.showWhole());
    onKey("l", t("key_lock"), () => this.toggleLock());
    onKey("Escape", t("unlock"), () => this.view.set({ row: null, locked: false }));
  }

  private chooser(): HTMLElement {
    const axes = [...new Set(this.all.filter((column) => column.quantity !== "other").map((column) => column.axis))].sort((a, b) => Number(b === "") - Number(a === ""));
    const present = quantities.filter((quantity) => quantity !== "other" && this.all.some((column) => column.quantity === quantity));
    const box = (column: ChartColumn | undefined, text = ""): HTMLElement =>
      column ? h("label", {}, h("input", { type: "checkbox", name: "cols", value: column.name, checked: this.shown.includes(column.name), "aria-label": columnName(column, this.job.kind),
                                           change: (event: Event) => this.choose(column.name, (event.target as HTMLInputElement).checked) }), text)
             : h("span", {});
    const head = h("tr", {}, h("th", { scope: "col" }, t("axis")));
    for (const quantity of present) head.append(h("th", { scope: "col" }, t(quantity)));
    const body = h("tbody");
    for (const axis of axes) {
      const row = h("tr", {}, h("th", { scope: "row" }, axis === "" ? t(this.job.kind === "motion_law" ? "law_axis" : "whole_axis") : axis));
      for (const quantity of present) row.append(h("td", {}, box(this.all.find((column) => column.axis === axis && column.quantity === quantity))));
      body.append(row);
    }
    const others = h("p");
    for (const column of this.all) if (column.quantity === "other") append(others, box(column, " " + columnName(column, this.job.kind)), " ");
    return h("details", { class: "no-print" }, h("summary", {}, t("columns")), h("div", { class: "scroll", tabindex: "0" }, h("table", { class: "chooser" }, h("thead", {}, head), body)), others);
  }

  private buildCharts(): void {
    this.list.replaceChildren();
    this.charts = this.shown.flatMap((name) => {
      const column = this.all.find((each) => each.name === name);
      if (!column) return [];
      const canvas = h("canvas", { role: "img" }), value = h("span", { class: "value" });
      const unit = column.quantity === "use" ? "%" : column.unit;
      const box = h("div", { class: "chart" }, h("div", { class: "chart-head" }, h("span", {}, columnName(column, this.job.kind)), h("span", { class: "soft" }, unit ? " " + unit : ""), value), canvas);
      this.list.append(box);
      return [{ column, canvas, value, box }];
    });
    this.list.classList.toggle("many", this.charts.length > 6);
  }

  // What is shown

  private abscissa(): Abscissa {
    const { first, count } = this.view.get();
    return (this.overLength && pathLength(this.data, first, first + count)) || proportional(this.job.cycle);
  }
  private plotWidth(): number {
    return this.stack.clientWidth - this.left() - right;
  }
  private rowAt(x: number): number {
    const { first, count } = this.view.get(), over = this.abscissa(), from = over.value(first), to = over.value(first + count - 1);
    const share = Math.max(0, Math.min(1, (x - this.left()) / Math.max(1, this.plotWidth())));
    return Math.max(first, Math.min(first + count - 1, over.row(from + share * (to - from))));
  }
  private xOf(row: number): number {
    const { first, count } = this.view.get(), over = this.abscissa(), from = over.value(first), to = over.value(first + count - 1);
    return this.left() + ((over.value(row) - from) / (to - from || 1)) * this.plotWidth();
  }
  private overviewRow(x: number): number {
    return ((x - this.left()) / Math.max(1, this.plotWidth())) * this.job.rows;
  }

  private axisTicks(from: number, to: number): Ticks {
    const most = Math.max(2, this.plotWidth() / (to - from < 1e-3 * Math.abs(to) ? 110 : 80));
    if (this.overLength) return ticks(from, to, most);
    if (this.job.independent === "time") return timeTicks(from, to, most);
    return this.job.unit === "deg" ? angleTicks(from, to, most) : ticks(from, to, most);
  }

  draw(): void {
    this.frame.ask();
  }
  private drawNow(): void {
    const { first, count } = this.view.get(), over = this.abscissa(), end = first + count;
    const from = over.value(first), to = over.value(end - 1), left = this.left(), width = this.plotWidth();
    if (width <= 0) return;
    const x = (row: number): number => left + ((over.value(row) - from) / (to - from || 1)) * width;
    const marks = this.axisTicks(from, to), place = (value: number): number => left + ((value - from) / (to - from || 1)) * width;
    const frame: Frame = { left, right, first, end, x, grid: marks.values.map(place) };
    let segments = 0;
    for (const chart of this.charts) {
      const drawn = drawCurve(chart.canvas, chart.column, this.data, this.currentLimits(), this.colours, this.palette, frame, this.job.rows, t("zoom_in"));
      segments += drawn?.segments ?? 0;
      const name = columnName(chart.column, this.job.kind), scale = chart.column.quantity === "use" ? 100 : 1;
      chart.canvas.setAttribute("aria-label", drawn && drawn.low <= drawn.high
        ? t("chart", { name, low: number(drawn.low * scale, 4), high: number(drawn.high * scale, 4), unit: scale === 100 ? "%" : chart.column.unit, first, last: end - 1 }) : t("chart_empty", { name }));
    }
    this.drawAxis(marks, place);
    const parts: Shares[] = [];
    const whole = this.wholeShares(), detail = this.data.detailLimits;
    if (whole && !(detail && detail.first <= first && detail.end >= end)) parts.push(whole);
    if (detail?.index && detail.shares) parts.push({ limits: detail.limits, index: detail.index, shares: detail.shares, end: detail.end });
    segments += drawRibbon(this.ribbon, parts, x, left, right, this.colours, this.palette, this.only);
    segments += drawOverview(this.overview, whole, this.job.rows, first, count, left, right, this.colours, this.palette);
    countSegments("curves", segments);
    this.showLegend();
    this.showCursor();
  }
  private wholeShares(): Shares | null {
    const whole = this.data.wholeLimits;
    return whole?.index && whole.shares ? { limits: whole.limits, index: whole.index, shares: whole.shares, end: this.job.rows } : null;
  }
  private currentLimits(): readonly Limit[] {
    return this.data.detailLimits?.limits ?? this.limits;
  }
  private drawAxis(marks: Ticks, place: (value: number) => number): void {
    const picture = begin(this.axis);
    if (!picture) return;
    const { context, width } = picture;
    context.font = "11px system-ui, sans-serif";
    context.fillStyle = this.palette.of("--soft");
    context.textBaseline = "top";
    const unit = this.overLength ? "mm" : this.job.independent === "time" && marks.step >= 60 ? "" : this.job.unit === "deg" ? "°" : this.job.unit;
    context.textAlign = "right";
    context.fillText(unit, this.left() - 5, 4);
    for (const value of marks.values) {
      const text = marks.text(value), half = context.measureText(text).width / 2, at = place(value);
      context.fillRect(Math.round(at), 0, 1, 3);
      context.textAlign = at + half > width ? "right" : "center";
      context.fillText(text, at + half > width ? width : Math.max(at, half), 4);
    }
  }

  private showLegend(): void {
    const limits = [...this.currentLimits()].filter((limit) => limit.share > 0).sort((a, b) => b.share - a.share);
    if (!this.limits.some((limit) => limit.unit !== null && limit.share > 0)) return;
    const said = limits.map((limit) => `${limit.id} ${percent(limit.share)}`).join();
    if (said === this.legendSays) return;
    this.legendSays = said;
    const old = document.activeElement instanceof HTMLElement && this.legend.contains(document.activeElement) ? document.activeElement.dataset.limit : undefined;
    fill(this.legend);
    for (const limit of limits.slice(0, 9)) {
      const swatch = h("span", { class: "swatch", "aria-hidden": "true" }), name = statesName[limit.id] === "ahead" ? t("ahead") : nameOf(limit.name);
      swatch.style.background = `var(${this.colours.get(limit.id) ?? "--rapid"})`;
      const chip = h("button", { type: "button", class: "chip", "data-limit": String(limit.id), click: () => this.showLimit(limit.id),
                                 pointerenter: () => this.lookAt(limit.id), pointerleave: () => this.lookAt(null) }, swatch, `${name} ${percent(limit.share)}`);
      this.legend.append(chip);
      if (old === String(limit.id)) chip.focus({ preventScroll: true });
    }
  }
  private lookAt(limit: number | null): void {
    if (this.only === limit) return;
    this.only = limit;
    // The legend stays as it is: the pointer is on one of its buttons.
    const { first, count } = this.view.get(), left = this.left(), parts: Shares[] = [], whole = this.wholeShares(), detail = this.data.detailLimits;
    if (whole && !(detail && detail.first <= first && detail.end >= first + count)) parts.push(whole);
    if (detail?.index && detail.shares) parts.push({ limits: detail.limits, index: detail.index, shares: detail.shares, end: detail.end });
    drawRibbon(this.ribbon, parts, (row) => this.xOf(row), left, right, this.colours, this.palette, limit);
  }

  /** Shows the place where a limit holds longest, and the curve that it limits. */
  showLimit(id: number): void {
    const whole = this.wholeShares(), stretch = whole && longestStretch(whole.index, whole.shares[id] ?? [], this.job.rows);
    if (!stretch) return;
    const limit = this.limits.find((each) => each.id === id);
    if (limit?.column && !this.shown.includes(limit.column) && this.all.some((column) => column.name === limit.column)) this.choose(limit.column, true);
    this.view.set({ ...around(stretch), row: stretch.first + Math.floor(stretch.count / 2), locked: true });
    this.section.scrollIntoView({ block: "nearest", behavior: matchMedia("(prefers-reduced-motion: reduce)").matches ? "auto" : "smooth" });
  }
  /** Gives the rows of the page's table of limits their colours and a way to the curve. */
  private markTable(): void {
    for (const row of document.querySelectorAll<HTMLTableRowElement>("#why tr[data-limit]")) {
      const id = Number(row.dataset.limit), cell = row.cells[0];
      if (!cell || cell.querySelector("button")) continue;
      const swatch = h("span", { class: "swatch", "aria-hidden": "true" });
      swatch.style.background = `var(${this.colours.get(id) ?? "--rapid"})`;
      row.style.setProperty("--meter", `var(${this.colours.get(id) ?? "--rapid"})`);
      fill(cell, swatch, h("button", { type: "button", class: "link", click: () => this.showLimit(id) }, cell.textContent ?? ""));
    }
  }

  private showCursor(): void {
    const { row, locked, first, count } = this.view.get(), inside = row !== null && row >= first && row < first + count;
    this.lock.setAttribute("aria-pressed", String(locked));
    this.lock.textContent = t(locked ? "unlock" : "lock");
    this.line.hidden = !inside;
    this.line.classList.toggle("locked", locked);
    if (inside) this.line.style.transform = `translateX(${this.xOf(row)}px)`;
    if (row === null) {
      this.readout.textContent = "";
      for (const chart of this.charts) chart.value.textContent = "";
      return;
    }
    if (locked) this.rows.want(row, [...this.shown, ...(this.job.columns.includes("s") ? ["s"] : []), "limit"]);
    this.readout.textContent = this.place(row);
    for (const chart of this.charts) chart.value.textContent = this.valueText(chart.column, row);
  }
  private place(row: number): string {
    const value = row * this.job.cycle, digits = Math.min(7, Math.max(3, Math.ceil(-Math.log10(this.job.cycle) - 1e-9)));
    const parts = [`${fixed(value, digits)} ${this.job.unit === "deg" ? "°" : this.job.unit}`, `${t("row")} ${row}`];
    const s = this.hasLength() ? this.rows.value(row, "s") : null, limit = this.rows.value(row, "limit") ?? this.envelopeValue("limit", row)?.[1] ?? null;
    if (s !== null) parts.push(`${number(s)} mm`);
    if (limit !== null) parts.push(nameOf(this.limits.find((each) => each.id === limit)?.name ?? ""));
    return parts.filter((part) => part !== "").join(" · ");
  }
  private envelopeValue(column: string, row: number): [number, number] | null {
    const part = this.data.parts(column, row, row + 1)[0];
    if (!part) return null;
    const interval = part.envelope.find(row);
    return [part.envelope.least(interval, column), part.envelope.most(interval, column)];
  }
  private valueText(column: ChartColumn, row: number): string {
    const scale = column.quantity === "use" ? 100 : 1, exact = this.rows.value(row, column.name);
    if (exact !== null) return number(exact * scale, 5);
    const range = this.envelopeValue(column.name, row);
    if (!range) return "";
    const low = number(range[0] * scale, 4), high = number(range[1] * scale, 4);
    return low === high ? low : `${low} … ${high}`;
  }

  private drawTable(): void {
    if (!this.table.open) return;
    const { first, count } = this.view.get(), names = this.limits.map((limit) => nameOf(limit.name));
    const label = this.job.independent === "time" ? t("time") : t("angle", { name: this.job.independent, unit: this.job.unit });
    fill(this.tableBody, fillTable(this.data, this.charts.map((chart) => ({ name: chart.column.name, title: columnName(chart.column, this.job.kind), unit: chart.column.quantity === "use" ? "%" : chart.column.unit,
                                                                            scale: chart.column.quantity === "use" ? 100 : 1 })),
                                   { first, end: first + count, cycle: this.job.cycle, abscissa: label, row: t("row"), limit: t("limit"), limitName: (id) => names[id] ?? "" }));
  }

  private loaded(): void {
    this.trouble.hidden = !this.data.failed;
    if (this.data.failed) fill(this.trouble, t("failed") + " ", h("button", { type: "button", click: () => this.data.want(this.wanted(), true) }, t("again")));
    this.draw();
    this.drawTable();
  }

  // What users do

  private changeAxis(overLength: boolean): void {
    this.overLength = overLength;
    keepInAddress({ x: overLength ? "s" : null });
    this.data.want(this.wanted(), true);
    this.draw();
  }
  private choose(name: string, on: boolean): void {
    const set = new Set(this.shown);
    on ? set.add(name) : set.delete(name);
    const rank = (column: ChartColumn): number => (column.quantity === "use" ? 2 : column.axis === "" ? 0 : 1); // the path first, use last
    this.shown = [...this.all].sort((a, b) => rank(a) - rank(b)).map((column) => column.name).filter((each) => set.has(each));
    keepInAddress({ cols: this.shown.join(",") });
    for (const box of this.section.querySelectorAll<HTMLInputElement>("input[name=cols]")) box.checked = set.has(box.value);
    this.buildCharts();
    this.data.want(this.wanted(), true);
    this.draw();
  }
  private zoomBy(factor: number): void {
    const { first, count, row } = this.view.get();
    this.view.zoom(row !== null && row >= first && row < first + count ? row : first + count / 2, factor);
  }
  private showWhole(): void {
    this.view.set({ first: 0, count: this.job.rows });
  }
  private centre(row: number): void {
    this.view.set({ first: row - this.view.get().count / 2 });
  }
  private pan(pixels: number): void {
    const { first, count } = this.view.get(), rows = (pixels / Math.max(1, this.plotWidth())) * count;
    if (Math.abs(rows) >= 0.5) this.view.set({ first: first - rows });
  }
  private select(from: number, to: number, done: boolean): void {
    const [a, b] = [Math.max(this.left(), Math.min(from, to)), Math.min(this.stack.clientWidth - right, Math.max(from, to))];
    this.selection.hidden = done;
    this.selection.style.left = `${a}px`;
    this.selection.style.width = `${Math.max(0, b - a)}px`;
    if (!done || b - a < 4) return;
    const first = Math.round(this.rowAt(a)), end = Math.round(this.rowAt(b));
    this.view.set({ first, count: Math.max(2, end - first + 1) });
  }
  private clickAt(row: number): void {
    const { locked } = this.view.get();
    if (locked) this.view.set({ locked: false });
    this.view.set({ row, locked: !locked });
  }
  private toggleLock(): void {
    const { row, locked, first, count } = this.view.get();
    this.view.set({ row: row ?? first + Math.floor(count / 2), locked: !locked });
  }
  private step(rows: number): void {
    const { row, first, count } = this.view.get(), start = row ?? first + Math.floor(count / 2);
    const next = Math.max(0, Math.min(this.job.rows - 1, start + rows));
    const moved = next < first ? { first: next } : next >= first + count ? { first: next - count + 1 } : {};
    // A cursor that is moved by keys stays there.
    this.view.set({ ...moved, row: next, locked: true });
  }

  // The address

  private keep(): void {
    this.address.start(() => {
      const { first, count, row, locked } = this.view.get(), all = count === this.job.rows;
      keepInAddress({ first: all ? null : String(first), count: all ? null : String(count), row: locked && row !== null ? String(row) : null, locked: locked ? "1" : null });
    });
  }
  private readAgain(): void {
    const state = readAddress(), whole = state.count === undefined;
    this.view.set({ first: whole ? 0 : Number(state.first ?? 0), count: whole ? this.job.rows : Number(state.count), row: state.row === undefined ? null : Number(state.row), locked: state.locked === "1" });
  }
}

/** Draws ribbon and curves into the section of the page. */
export function mountCurves(section: HTMLElement, job: PlannedJob): void {
  if (job.rows > 1) new Curves(section, job);
}
