/** How many wires a slot takes: all wires and layouts as a map and a sortable table, and the chosen layout in the order of laying. */
import { append, fill, h } from "../base/dom";
import { fixed, number, percent } from "../base/numbers";
import { keepInAddress, readAddress } from "../base/view";
import { type Edge, holdOutline, traceOutline } from "./outline";
import { Plane, hold, nothing } from "./plane";
import { figures, legend, panel, player, resultParts, t, type TextKey } from "./parts";

interface Wire {
  copper: number;
  outer: number;
}
interface Region {
  positions: [number, number][];
  pulls?: [number, number][];
}
export interface Layout extends Region {
  algorithm: string;
  wire: Wire;
  count: number;
  electrical_fill: number;
  mechanical_fill: number;
  producible: boolean;
  windable?: { wires: number; turns: number; ends_by: string };
  bound?: number;
  max_overlap?: number;
  allowed_overlap?: number;
  blocked_by?: { part: string; passage: string; needed: number; clear: number; wire?: number; region?: string }[];
  slips?: { wire: number; laid: number; reason: string; unsupported: number } | null;
  turns?: { serial: number; parallel: number; wires: number; loss: number | null; fits: boolean };
  resistance_per_metre?: number;
  regions?: Record<string, Region>;
}
interface Result {
  summary: { algorithm: string; wire: Wire };
  details: {
    slot: { area: number; room_area: number; outline: Edge[]; room: Edge[]; taken?: Edge[]; clear_opening?: number };
    layouts: Layout[];
  };
}

const algorithms: Record<string, TextKey> = { orthocyclic_base: "algorithm_orthocyclic_base", orthocyclic_flank: "algorithm_orthocyclic_flank", raabe: "algorithm_raabe", potential: "algorithm_potential", needle: "algorithm_needle" };
const nameOf = (algorithm: string): string => (algorithm in algorithms ? t(algorithms[algorithm]!) : algorithm.replace(/_/g, " "));
const millimetres = (value: number): string => fixed(value, 3) + " mm";
const partNames: Record<string, TextKey> = { wire: "part_wire", needle: "part_needle", channel: "part_channel" };
const regionNames: Record<string, TextKey> = { slot: "region_slot", head_bottom: "region_head_bottom", slot_back: "region_slot_back", head_top: "region_head_top" };
const nameOfRegion = (region: string): string => (region in regionNames ? t(regionNames[region]!) : region.replace(/_/g, " "));

/** Why some wires of a layout cannot be laid, and from which one on: numbers count from 1 in the order of laying. */
export function reasons(layout: Layout): { wire: number | null; text: string }[] {
  const list: { wire: number | null; text: string }[] = [];
  for (const each of layout.blocked_by ?? []) {
    const part = each.part in partNames ? t(partNames[each.part]!) : each.part, values = { part, needed: millimetres(each.needed), clear: millimetres(each.clear) };
    list.push({ wire: each.wire ?? null, text: each.wire ? t("blocked_wire", { ...values, wire: each.wire }) : each.passage === "needle" ? t("blocked_needle", values) : t("blocked_opening", values) });
  }
  const { slips, windable } = layout;
  if (slips)
    list.push({ wire: slips.wire, text: slips.reason === "pushed_out" ? t("pushed_out", { wire: slips.wire, laid: slips.laid }) : slips.unsupported > 1 ? t("no_support_more", { wire: slips.wire, n: slips.unsupported }) : t("no_support", { wire: slips.wire }) });
  if (windable && windable.wires < layout.count && !list.some((each) => each.wire !== null)) {
    const ends: Record<string, TextKey> = { pushed_out: "ends_pushed_out", no_support: "ends_no_support", blocked: "ends_blocked", not_reached: "ends_blocked", not_decided: "ends_not_decided" };
    list.push({ wire: windable.wires + 1, text: t(ends[windable.ends_by] ?? "ends_blocked", { wire: windable.wires + 1 }) });
  }
  if (layout.turns && !layout.turns.fits) list.push({ wire: null, text: t("coil_does_not_fit", { serial: layout.turns.serial, parallel: layout.turns.parallel }) });
  return list;
}

interface Column {
  key: TextKey;
  unit?: string;
  value(layout: Layout): number | string | null;
  shown?(layout: Layout): string;
}
const columns: Column[] = [
  { key: "layout", value: (each) => nameOf(each.algorithm) },
  { key: "copper", unit: "mm", value: (each) => each.wire.copper, shown: (each) => number(each.wire.copper, 4) },
  { key: "outer", unit: "mm", value: (each) => each.wire.outer, shown: (each) => number(each.wire.outer, 4) },
  { key: "wires", value: (each) => each.count },
  { key: "wires_bound", value: (each) => each.bound ?? null },
  { key: "windable", value: (each) => each.windable?.wires ?? null },
  { key: "electrical_fill", value: (each) => each.electrical_fill, shown: (each) => fixedPercent(each.electrical_fill) },
  { key: "mechanical_fill", value: (each) => each.mechanical_fill, shown: (each) => fixedPercent(each.mechanical_fill) },
  { key: "reason", value: (each) => (each.producible ? "" : (reasons(each)[0]?.text ?? t("not_producible"))), shown: (each) => (each.producible ? t("can_be_wound") : (reasons(each)[0]?.text ?? t("not_producible"))) },
];
const fixedPercent = (share: number): string => fixed(share * 100, 1) + " %";

/** Returns layouts in the order of a column; what has no value comes last. */
export function sorted(list: Layout[], column: number, descending: boolean): Layout[] {
  const { value } = columns[column]!, sign = descending ? -1 : 1;
  return [...list].sort((a, b) => {
    const left = value(a), right = value(b);
    if (left === null || right === null) return left === right ? 0 : left === null ? 1 : -1;
    return sign * (typeof left === "string" ? left.localeCompare(String(right)) : left - Number(right));
  });
}

export async function mountFillFactor(section: HTMLElement, id: string): Promise<void> {
  const { summary, details } = await resultParts<Result>(id, "summary", "details.slot", "details.layouts");
  const { layouts, slot } = details;
  if (!layouts || layouts.length === 0) return;
  const address = readAddress(), key = (each: Layout): string => `${each.algorithm}/${each.wire.copper}/${each.wire.outer}`;
  let chosen = layouts.find((each) => key(each) === address.layout) ?? layouts.find((each) => each.algorithm === summary.algorithm && each.wire.copper === summary.wire.copper && each.wire.outer === summary.wire.outer) ?? layouts[0]!;
  const followers: (() => void)[] = [];
  const choose = (layout: Layout): void => {
    chosen = layout;
    keepInAddress({ layout: key(layout), laid: null });
    for (const each of followers) each();
  };
  section.append(h("h2", {}, t("fill_heading")));
  const grid = h("div", { class: "side-by-side fill" });
  section.append(grid);
  grid.append(drawing(slot, () => chosen, followers, Number(address.laid ?? NaN)));
  const wires = [...new Map(layouts.map((each) => [`${each.wire.copper}/${each.wire.outer}`, each.wire])).values()];
  if (layouts.length > 1) grid.append(heatMap(layouts, wires, () => chosen, choose, followers));
  section.append(list(layouts, () => chosen, choose, followers));
  for (const each of followers) each();
}

function drawing(slot: Result["details"]["slot"], chosen: () => Layout, followers: (() => void)[], start: number): HTMLElement {
  const slider = h("input", { type: "range", min: 0, max: 1, step: 1, "aria-label": t("laid_slider") });
  const count = h("output", { class: "laid" }), heading = h("p", { class: "lead" }), why = h("ul", { class: "reasons" }), figuresBox = h("div");
  const region = h("select", { "aria-label": t("region") }), regionField = h("label", { class: "choice" }, t("region") + " ", region);
  const shown = (): Region => (region.value && region.value !== "slot" ? (chosen().regions?.[region.value] ?? chosen()) : chosen());
  const laid = (): number => Number(slider.value);
  /** The first wire that cannot be laid, from 1; beyond the last where all can. */
  const firstBad = (layout: Layout): number => Math.min(layout.count + 1, ...reasons(layout).map((each) => each.wire ?? Infinity));
  const extent = () => {
    const all = nothing();
    if (shown() === chosen()) holdOutline(all, slot.outline);
    for (const [x, y] of shown().positions) hold(all, x, y, chosen().wire.outer / 2);
    return all;
  };
  const plane = new Plane({
    label: "", extent,
    height: (width) => {
      const { x0, y0, x1, y1 } = extent();
      return Math.min(520, Math.max(220, (width * (y1 - y0)) / (x1 - x0 || 1) + 40));
    },
    draw({ context, colour, drew }, at) {
      const layout = chosen(), { wire } = layout, { positions, pulls } = shown(), inSlot = shown() === layout;
      if (inSlot) {
        drew(traceOutline(context, at, slot.outline));
        context.fillStyle = colour("--idle-back");
        context.fill();
        context.strokeStyle = colour("--strong");
        context.lineWidth = 1.5;
        context.stroke();
        drew(traceOutline(context, at, slot.room));
        context.fillStyle = colour("--back");
        context.fill();
        context.lineWidth = 1;
        context.stroke();
        if (slot.taken) {
          drew(traceOutline(context, at, slot.taken));
          context.fillStyle = colour("--line");
          context.fill();
        }
      }
      const bad = firstBad(layout), outer = (wire.outer / 2) * at.scale, inner = (wire.copper / 2) * at.scale;
      context.textAlign = "center";
      context.textBaseline = "middle";
      context.font = `${Math.max(8, Math.min(13, inner * 0.95))}px system-ui, sans-serif`;
      positions.forEach(([x, y], k) => {
        const own = k + 1, there = own <= laid(), last = own === laid();
        context.beginPath();
        context.arc(at.x(x), at.y(y), outer, 0, 2 * Math.PI);
        context.strokeStyle = colour(own >= bad ? "--c1" : "--strong");
        context.lineWidth = last ? 2.5 : 1;
        context.setLineDash(there ? [] : [2, 3]);
        if (there) {
          context.fillStyle = colour("--panel");
          context.fill();
        }
        context.stroke();
        context.setLineDash([]);
        if (!there) return;
        context.beginPath();
        context.arc(at.x(x), at.y(y), inner, 0, 2 * Math.PI);
        context.fillStyle = colour(own >= bad ? "--c1" : "--c4");
        context.globalAlpha = last ? 1 : 0.85;
        context.fill();
        context.globalAlpha = 1;
        if (own >= bad) {
          // A cross tells more than the colour alone.
          context.strokeStyle = colour("--text");
          context.lineWidth = 1;
          const arm = inner * 0.6;
          context.beginPath();
          context.moveTo(at.x(x) - arm, at.y(y) - arm), context.lineTo(at.x(x) + arm, at.y(y) + arm);
          context.moveTo(at.x(x) - arm, at.y(y) + arm), context.lineTo(at.x(x) + arm, at.y(y) - arm);
          context.stroke();
        } else if (inner >= 7) {
          context.fillStyle = "#1c2430";
          context.fillText(String(own), at.x(x), at.y(y) + 0.5);
        }
      });
      drew(2 * positions.length);
      const last = laid() - 1, pull = pulls?.[last], place = positions[last];
      if (pull && place) {
        const way = Math.hypot(pull[0] - place[0], pull[1] - place[1]) || 1, reach = Math.min(way, 4 * wire.outer) / way;
        context.strokeStyle = colour("--c0");
        context.lineWidth = 2;
        context.beginPath();
        context.moveTo(at.x(place[0]), at.y(place[1]));
        context.lineTo(at.x(place[0] + reach * (pull[0] - place[0])), at.y(place[1] + reach * (pull[1] - place[1])));
        context.stroke();
      }
    },
  });
  const tell = (): void => {
    const layout = chosen(), n = laid(), own = reasons(layout).find((each) => each.wire === n);
    count.textContent = t("laid", { n, of: layout.count }) + (own ? " · " + own.text : "");
    count.classList.toggle("warned", own !== undefined);
    plane.stage.label = t("layout_picture", { layout: nameOf(layout.algorithm), wire: millimetres(layout.wire.copper), n, of: layout.count });
    keepInAddress({ laid: n === layout.count ? null : String(n) });
    plane.redraw();
  };
  let first = true;
  followers.push(() => {
    const layout = chosen(), names = Object.keys(layout.regions ?? {});
    slider.max = String(layout.count);
    slider.value = String(first && start >= 0 && start <= layout.count ? start : layout.count);
    first = false;
    fill(region, ...["slot", ...names].map((each) => h("option", { value: each }, nameOfRegion(each))));
    regionField.hidden = names.length === 0;
    fill(heading, h("strong", {}, nameOf(layout.algorithm)), ` · ${t("wire_of", { copper: millimetres(layout.wire.copper), outer: millimetres(layout.wire.outer) })}`);
    fill(figuresBox, figures([t("wires"), layout.bound !== undefined ? t("wires_of_bound", { n: layout.count, bound: layout.bound }) : String(layout.count)], [t("electrical_fill"), fixedPercent(layout.electrical_fill)],
      [t("mechanical_fill"), fixedPercent(layout.mechanical_fill)], layout.windable && [t("windable"), t("windable_of", { wires: layout.windable.wires, of: layout.count })],
      layout.turns?.fits && [t("coil"), t("coil_of", { serial: layout.turns.serial, parallel: layout.turns.parallel }) + (layout.turns.loss ? ` (${t("empty_places", { share: percent(layout.turns.loss) })})` : "")],
      layout.resistance_per_metre !== undefined && [t("resistance"), number(layout.resistance_per_metre, 4) + " Ω/m"]));
    const list = reasons(layout);
    fill(why, ...(list.length === 0 ? [h("li", { class: "fine" }, t("all_can_be_laid"))] : list.map(({ wire, text }) => {
      const item = h("li", {}, text);
      if (wire !== null && wire <= layout.count) {
        item.append(" ", h("button", { type: "button", click: () => {
          slider.value = String(wire);
          tell();
        } }, t("show")));
      }
      return item;
    })));
    tell();
  });
  slider.addEventListener("input", tell);
  region.addEventListener("change", () => plane.redraw());
  return panel(t("layout_heading"), heading, plane.element, h("div", { class: "controls" }, player(slider, 6), slider, count), regionField,
    legend({ colour: "--c4", name: t("laid_wire"), kind: "dot" }, { colour: "--c1", name: t("bad_wire"), kind: "dot" }, { colour: "--c0", name: t("pulled_to") }), figuresBox, why);
}

const measures = { electrical_fill: (each: Layout) => each.electrical_fill, mechanical_fill: (each: Layout) => each.mechanical_fill, wires: (each: Layout) => each.count } as const;

function heatMap(layouts: Layout[], wires: Wire[], chosen: () => Layout, choose: (layout: Layout) => void, followers: (() => void)[]): HTMLElement {
  const names = [...new Set(layouts.map((each) => each.algorithm))];
  const measure = h("select", { "aria-label": t("measure") }, ...(Object.keys(measures) as (keyof typeof measures)[]).map((each) => h("option", { value: each }, t(each))));
  const body = h("tbody"), cells = new Map<Layout, HTMLButtonElement>();
  for (const wire of wires) {
    const row = h("tr", {}, h("th", { scope: "row", class: "n" }, fixed(wire.copper, 2)));
    for (const name of names) {
      const layout = layouts.find((each) => each.algorithm === name && each.wire.copper === wire.copper && each.wire.outer === wire.outer);
      if (!layout) {
        row.append(h("td", {}, "–"));
        continue;
      }
      const button = h("button", { type: "button", class: "heat", click: () => choose(layout) });
      cells.set(layout, button);
      row.append(h("td", {}, button));
    }
    body.append(row);
  }
  const paint = (): void => {
    const value = measures[measure.value as keyof typeof measures];
    const all = layouts.map(value), least = Math.min(...all), most = Math.max(...all);
    for (const [layout, button] of cells) {
      const share = most > least ? (value(layout) - least) / (most - least) : 1, shown = measure.value === "wires" ? String(layout.count) : (value(layout) * 100).toFixed(0);
      fill(button, shown, layout.producible ? null : h("span", { class: "bad" }, " ✕"));
      button.style.backgroundColor = `color-mix(in srgb, var(--c0) ${(4 + 46 * share).toFixed(0)}%, var(--back))`;
      button.title = `${nameOf(layout.algorithm)}, ${millimetres(layout.wire.copper)}: ${layout.count}` + (layout.producible ? "" : " · " + (reasons(layout)[0]?.text ?? t("not_producible")));
      button.setAttribute("aria-label", `${button.textContent} · ${button.title}` + (measure.value === "wires" ? "" : `, ${fixedPercent(value(layout))}`));
    }
  };
  followers.push(() => {
    for (const [layout, button] of cells) button.setAttribute("aria-pressed", String(layout === chosen()));
  });
  measure.addEventListener("change", paint);
  paint();
  const head = h("tr", {}, h("th", { scope: "col", class: "n" }, "mm"), ...names.map((each) => h("th", { scope: "col" }, nameOf(each))));
  return panel(t("map_heading"), h("p", { class: "soft" }, t("map_note")), h("label", { class: "choice" }, t("measure") + " ", measure), h("div", { class: "scroll tall", tabindex: 0, role: "region", "aria-label": t("map_heading") }, h("table", { class: "map" }, h("thead", {}, head), body)));
}

function list(layouts: Layout[], chosen: () => Layout, choose: (layout: Layout) => void, followers: (() => void)[]): HTMLElement {
  let column = columns.findIndex((each) => each.key === "electrical_fill"), descending = true;
  const body = h("tbody"), heads: HTMLTableCellElement[] = [], rows = new Map<Layout, HTMLTableRowElement>();
  const write = (): void => {
    body.replaceChildren();
    heads.forEach((each, k) => (k === column ? each.setAttribute("aria-sort", descending ? "descending" : "ascending") : each.removeAttribute("aria-sort")));
    for (const layout of sorted(layouts, column, descending)) {
      let row = rows.get(layout);
      if (!row) {
        row = h("tr");
        columns.forEach((each, k) => {
          const text = each.shown ? each.shown(layout) : String(each.value(layout) ?? "–"), numeric = typeof each.value(layout) === "number";
          row!.append(k === 0 ? h("th", { scope: "row" }, h("button", { type: "button", class: "plain", click: () => choose(layout) }, text)) : h("td", { class: numeric ? "n" : null }, text));
        });
        rows.set(layout, row);
      }
      row.classList.toggle("chosen", layout === chosen());
      body.append(row);
    }
  };
  columns.forEach((each, k) => {
    const cell = h("th", { scope: "col", class: typeof each.value(layouts[0]!) === "number" ? "n" : null }, h("button", { type: "button", class: "plain", click: () => {
      descending = k === column ? !descending : typeof each.value(layouts[0]!) === "number";
      column = k;
      write();
    } }, t(each.key) + (each.unit ? `, ${each.unit}` : "")));
    heads.push(cell);
  });
  const head = h("tr");
  append(head, ...heads);
  followers.push(() => {
    for (const [layout, row] of rows) row.classList.toggle("chosen", layout === chosen());
  });
  write();
  return panel(t("all_layouts", { n: layouts.length }), h("div", { class: "scroll tall", tabindex: 0, role: "region", "aria-label": t("all_layouts", { n: layouts.length }) }, h("table", { class: "data sortable" }, h("thead", {}, head), body)));
}
