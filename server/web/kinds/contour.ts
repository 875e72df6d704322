/** A contour with coarse and fine axes: where both are, the fine stage in its window, and what a longer duration buys. */
import { lastAtMost } from "../base/search";
import { Refused, at, getJson, postJson } from "../base/api";
import { fill, h } from "../base/dom";
import { duration, fixed, number, percent } from "../base/numbers";
import type { PlannedJob } from "../base/planned_job";
import { working } from "../base/work";
import { Chart, type Curve, line } from "./chart";
import { Plane, hold, nothing } from "./plane";
import { type Envelope, curveOf, envelope, figures, folded, follow, followed, legend, panel, resultParts, t, table } from "./parts";
import { ticks } from "../charts/ticks";
import { Stage } from "./stage";

type PerAxis = Record<string, number>;
interface Redundancy {
  method: string;
  trades?: { stretch: number; duration: number; coarse_smoothness: PerAxis }[];
}
interface Summary {
  duration: number;
  coarse_smoothness?: PerAxis;
  peak_coarse_acceleration?: PerAxis;
}
interface Result {
  summary: Summary;
  details: { redundancy?: Redundancy };
}
interface Document {
  kind: string;
  name?: string | null;
  reference?: string | null;
  spec: { machine: { coarse: Record<string, unknown>; fine: Record<string, { stroke?: number }>; redundancy?: Record<string, unknown> } };
  [member: string]: unknown;
}

const colours = ["--c0", "--c1", "--c2"];

export async function mountCoarseFine(section: HTMLElement, id: string, job: PlannedJob): Promise<void> {
  const axes = ["x", "y", "z"].filter((each) => job.columns.includes(each + "c"));
  if (axes.length === 0) return; // no coarse and fine axes
  const [result, data, document] = await Promise.all([
    resultParts<Result>(id, "summary", "details.redundancy"),
    envelope(id, axes.flatMap((each) => [each, each + "c", ...(job.columns.includes(each + "f") ? [each + "f"] : [])]), 1500),
    getJson<Document>(`/v1/jobs/${id}/spec`),
  ]);
  // Where a machine lacks the fine axis of a coordinate, its column is rounding.
  const fine = axes.filter((each) => job.columns.includes(each + "f") && document.spec.machine.fine[each]);
  const strokes = new Map(fine.map((each) => [each, document.spec.machine.fine[each]?.stroke ?? NaN]));
  const used = fine.map((each) => {
    const low = data.low.get(each + "f")!, high = data.high.get(each + "f")!;
    return { axis: each, most: low.reduce((most, value, k) => Math.max(most, Math.abs(value), Math.abs(high[k]!)), 0), stroke: strokes.get(each)! };
  });
  section.append(h("h2", {}, t("coarse_fine_heading")));
  section.append(figures(...used.map(({ axis, most, stroke }): [string, string] => [t("stroke_use", { axis }), Number.isFinite(stroke) ? t("stroke_of", { most: number(most, 4), stroke: number(stroke), share: percent(most / stroke) }) : `${number(most, 4)} mm`]),
    ...Object.entries(result.summary.peak_coarse_acceleration ?? {}).map(([axis, value]): [string, string] => [t("coarse_peak", { axis }), `${number(value, 5)} mm/s²`])));
  const wide = h("div", { class: "side-by-side" });
  const ways = axes.length > 1 ? bothWays(data, job, axes) : null, window_ = fine.length > 0 ? strokeWindow(data, job, fine, strokes) : null;
  if (ways) wide.append(ways.element);
  if (window_) wide.append(window_.element);
  section.append(wide, overTime(data, job, axes, fine, strokes), trade(id, document, result));
  follow(job, [ways?.picture, window_?.picture].filter((each) => each != null));
}

/** The way of the tool and of the coarse axes in the plane. */
function bothWays(data: Envelope, job: PlannedJob, axes: string[]) {
  const [a, b] = [axes[0]!, axes[1]!], extent = nothing(), count = data.rows.length;
  const middle = (column: string, k: number): number => (data.low.get(column)![k]! + data.high.get(column)![k]!) / 2;
  for (const suffix of ["", "c"])
    for (let k = 0; k < count; ++k) {
      hold(extent, data.low.get(a + suffix)![k]!, data.low.get(b + suffix)![k]!);
      hold(extent, data.high.get(a + suffix)![k]!, data.high.get(b + suffix)![k]!);
    }
  const shape = (extent.y1 - extent.y0) / (extent.x1 - extent.x0 || 1);
  const picture = new Plane({
    label: t("ways_picture"), height: (width) => Math.min(440, Math.max(220, width * Math.min(1, shape) + 30)), extent: () => extent,
    draw({ context, colour, drew }, at) {
      for (const [suffix, variable, width] of [["", "--text", 1], ["c", "--c0", 2]] as const) {
        context.strokeStyle = colour(variable);
        context.lineWidth = width;
        context.beginPath();
        for (let k = 0; k < count; ++k) {
          const x = at.x(middle(a + suffix, k)), y = at.y(middle(b + suffix, k));
          k === 0 ? context.moveTo(x, y) : context.lineTo(x, y);
        }
        context.stroke();
        drew(count);
      }
    },
    over({ context, colour }, at) {
      const k = intervalAt(data, job);
      if (k === null) return;
      const [x, y, xc, yc] = [a, b, a + "c", b + "c"].map((each) => middle(each, k)) as [number, number, number, number];
      context.strokeStyle = colour("--c1");
      context.lineWidth = 2;
      line(context, at.x(xc), at.y(yc), at.x(x), at.y(y));
      for (const [px, py, variable] of [[xc, yc, "--c0"], [x, y, "--c1"]] as const) {
        context.fillStyle = colour(variable);
        context.beginPath();
        context.arc(at.x(px), at.y(py), 5, 0, 2 * Math.PI);
        context.fill();
      }
    },
  });
  picture.redraw();
  return { picture, element: panel(t("both_ways"), legend({ colour: "--text", name: t("tool") }, { colour: "--c0", name: t("coarse_axes") }, { colour: "--c1", name: t("fine_offset") }), picture.element) };
}

function intervalAt(data: Envelope, job: PlannedJob): number | null {
  const { row } = job.view.get();
  return row === null ? null : Math.max(0, lastAtMost(data.rows, row));
}

/** The fine stage in its window: a rectangle for each interval of time in which it is somewhere, darker where it is more often. */
function strokeWindow(data: Envelope, job: PlannedJob, fine: string[], strokes: Map<string, number>) {
  const a = fine[0]!, b = fine[1] ?? null, count = data.rows.length;
  const reach = (axis: string): number => {
    const stroke = strokes.get(axis)!;
    return Number.isFinite(stroke) ? stroke : Math.max(...data.high.get(axis + "f")!.map(Math.abs), ...data.low.get(axis + "f")!.map(Math.abs), 1e-6);
  };
  const w = reach(a), v = b ? reach(b) : w / 3;
  const spanOf = (axis: string | null, k: number): [number, number] => (axis ? [data.low.get(axis + "f")![k]!, data.high.get(axis + "f")![k]!] : [0, 0]);
  const picture = new Plane({
    label: t("window_picture"), height: (width) => Math.min(440, Math.max(200, (width * v) / w)),
    extent: () => ({ x0: -1.12 * w, x1: 1.12 * w, y0: -1.12 * v, y1: 1.12 * v }),
    draw({ context, colour, drew }, at) {
      context.fillStyle = colour("--panel");
      context.fillRect(at.x(-w), at.y(v), 2 * w * at.scale, 2 * v * at.scale);
      context.strokeStyle = colour("--line");
      line(context, at.x(-w), at.y(0), at.x(w), at.y(0));
      line(context, at.x(0), at.y(-v), at.x(0), at.y(v));
      context.setLineDash([3, 4]);
      context.strokeRect(at.x(-w / 2), at.y(v / 2), w * at.scale, v * at.scale);
      context.setLineDash([]);
      context.fillStyle = colour("--c0");
      context.globalAlpha = Math.min(0.8, Math.max(0.22, 60 / count));
      for (let k = 0; k < count; ++k) {
        // Neighbours share a corner, so that the way does not break.
        const next = Math.min(count - 1, k + 1), [x0, x1] = spanOf(a, k), [y0, y1] = spanOf(b, k), exact = x0 === x1 && y0 === y1;
        if (exact && next > k) {
          context.strokeStyle = colour("--c0");
          context.lineWidth = 1.5;
          context.globalAlpha = 0.7;
          line(context, at.x(x0), at.y(y0), at.x(spanOf(a, next)[0]), at.y(spanOf(b, next)[0]));
        } else {
          const left = at.x(x0), top = at.y(y1);
          context.fillRect(left - 0.75, top - 0.75, Math.max(1.5, at.x(x1) - left + 1.5), Math.max(1.5, at.y(y0) - top + 1.5));
        }
      }
      context.globalAlpha = 1;
      drew(count);
      context.strokeStyle = colour("--c6");
      context.lineWidth = 2;
      context.strokeRect(at.x(-w), at.y(v), 2 * w * at.scale, 2 * v * at.scale);
      context.fillStyle = colour("--soft");
      context.textBaseline = "bottom";
      context.textAlign = "right";
      context.fillText(`${a}: ±${number(w)} mm`, at.x(w), at.y(v) - 2);
      context.textAlign = "left";
      context.fillText("100 %", at.x(-w) + 2, at.y(v) - 2);
      context.fillText("50 %", at.x(-w / 2) + 2, at.y(v / 2) - 2);
      if (b) {
        context.textAlign = "center";
        context.fillText(`${b}: ±${number(v)} mm`, at.x(0), at.y(v) - 2);
      }
    },
    over({ context, colour }, at) {
      const k = intervalAt(data, job);
      if (k === null) return;
      const [x0, x1] = spanOf(a, k), [y0, y1] = spanOf(b, k);
      context.fillStyle = colour("--c1");
      context.beginPath();
      context.arc(at.x((x0 + x1) / 2), at.y((y0 + y1) / 2), 6, 0, 2 * Math.PI);
      context.fill();
      const share = Math.max(Math.abs(x0), Math.abs(x1)) / w;
      const other = b ? Math.max(Math.abs(y0), Math.abs(y1)) / v : 0;
      context.fillStyle = colour("--text");
      context.textAlign = "right";
      context.textBaseline = "bottom";
      context.fillText(t("use_now", { share: percent(Math.max(share, other)) }), at.x(w), at.y(-v) + 16);
    },
  });
  picture.redraw();
  return { picture, element: panel(t("window"), h("p", { class: "soft" }, t("window_note")), legend({ colour: "--c0", name: t("fine_stage") }, { colour: "--c6", name: t("stroke") }), picture.element) };
}

/** Coarse axis and tool over time, and the fine axis within its stroke, for each axis. */
function overTime(data: Envelope, job: PlannedJob, axes: string[], fine: string[], strokes: Map<string, number>): HTMLElement {
  const time = data.rows.map((row) => row * job.cycle), shared = followed(job, 0, job.cycle), charts: Chart[] = [];
  const curves = (list: (Curve | null)[]): Curve[] => list.filter((each) => each !== null);
  axes.forEach((axis, k) => {
    charts.push(new Chart({
      label: t("axis_chart", { axis }), height: 150, xName: k === 0 ? `${t("time")}, s` : "", yName: `${axis}, mm`, unit: "mm", ...shared,
      curves: curves([curveOf(data, axis, time, t("tool"), "--text"), curveOf(data, axis + "c", time, t("coarse"), "--c0")]),
    }));
    if (!fine.includes(axis)) return;
    const stroke = strokes.get(axis)!;
    charts.push(new Chart({
      label: t("fine_chart", { axis }), height: 120, xName: "", yName: `${t("fine")} ${axis}, mm`, unit: "mm", include: 0.3, ...shared,
      curves: curves([curveOf(data, axis + "f", time, t("fine"), "--c1")]), rules: Number.isFinite(stroke) ? [{ value: stroke, colour: "--c6" }, { value: -stroke, colour: "--c6" }] : [],
    }));
  });
  follow(job, charts);
  for (const each of charts) each.redraw();
  return panel(t("each_axis"), legend({ colour: "--text", name: t("tool") }, { colour: "--c0", name: t("coarse") }, { colour: "--c1", name: t("fine") }, { colour: "--c6", name: t("stroke"), kind: "dashed" }), ...charts.map((each) => each.element));
}

/** One plan in the picture of the trade. */
export interface Trade {
  id: string | null; // null: a figure of this plan, not a plan of its own
  name: string;
  duration: number;
  smoothness: number; // sum over axes, mm²/s³
  own: boolean;
}

export const roughness = (smoothness: PerAxis | undefined): number => Object.values(smoothness ?? {}).reduce((sum, each) => sum + each, 0);

interface ListedJob {
  id: string;
  name: string | null;
  kind: string;
  state: string;
}
const settings = [0, 0.25, 0.5, 0.75, 1];

/** Time against smoothness: what this plan says that more time would buy, and all plans of the same reference. */
function trade(id: string, document: Document, result: Result): HTMLElement {
  const reference = document.reference || id, own: Trade = { id, name: document.name || t("this_plan"), duration: result.summary.duration, smoothness: roughness(result.summary.coarse_smoothness), own: true };
  const told: Trade[] = (result.details.redundancy?.trades ?? []).map((each) => ({ id: null, name: t("trade_told", { share: percent(each.stretch - 1) }), duration: each.duration, smoothness: roughness(each.coarse_smoothness), own: false }));
  let plans: Trade[] = [];
  const rows = h("div"), note = h("p", { role: "status" });
  const shown = (): Trade[] => [...told, ...plans, own];
  let places: { x: number; y: number; trade: Trade }[] = [];
  const stage = new Stage({
    label: t("trade_picture"), height: 280,
    draw({ context, colour, width, height, drew }) {
      const list = shown(), least = Math.min(...list.map((each) => each.duration)), most = Math.max(...list.map((each) => each.duration)), top = Math.max(...list.map((each) => each.smoothness), 1e-9);
      const room = Math.max((most - least) * 0.12, least * 0.002), from = least - room, to = most + room, left = 66, right = width - 16, bottom = height - 36, above = 24;
      const x = (value: number): number => left + ((value - from) / (to - from)) * (right - left), y = (value: number): number => bottom - (value / (1.1 * top)) * (bottom - above);
      context.fillStyle = colour("--back");
      context.fillRect(left, above, right - left, bottom - above);
      context.strokeStyle = colour("--line");
      context.fillStyle = colour("--soft");
      context.textBaseline = "middle";
      context.textAlign = "right";
      const vertical = ticks(0, 1.1 * top, 6), across = ticks(from, to, Math.max(2, Math.floor((right - left) / 80)));
      for (const value of vertical.values) line(context, left, y(value), right, y(value)), context.fillText(vertical.text(value), left - 6, y(value));
      context.textAlign = "center";
      context.textBaseline = "top";
      for (const value of across.values) line(context, x(value), above, x(value), bottom + 3), context.fillText(across.text(value), x(value), bottom + 6);
      context.fillText(`${t("duration")}, s`, (left + right) / 2, bottom + 21);
      context.textAlign = "left";
      context.textBaseline = "alphabetic";
      context.fillStyle = colour("--text");
      context.fillText(`${t("roughness")}, mm²/s³`, 4, 14);
      const line_ = [...told].sort((a, b) => a.duration - b.duration);
      context.strokeStyle = colour("--c5");
      context.setLineDash([5, 4]);
      context.beginPath();
      line_.forEach((each, k) => (k === 0 ? context.moveTo(x(each.duration), y(each.smoothness)) : context.lineTo(x(each.duration), y(each.smoothness))));
      context.stroke();
      context.setLineDash([]);
      places = list.map((each) => ({ x: x(each.duration), y: y(each.smoothness), trade: each }));
      for (const each of places) {
        context.beginPath();
        context.arc(each.x, each.y, each.trade.own ? 7 : 5, 0, 2 * Math.PI);
        context.fillStyle = colour(each.trade.own ? "--c1" : each.trade.id ? "--c0" : "--back");
        context.fill();
        context.lineWidth = 1.5;
        context.strokeStyle = colour(each.trade.own ? "--c1" : each.trade.id ? "--c0" : "--c5");
        context.stroke();
      }
      drew(list.length);
    },
  });
  stage.canvas.addEventListener("click", (event) => {
    const { x, y } = stage.place(event), hit = places.find((each) => Math.hypot(each.x - x, each.y - y) < 14);
    if (hit?.trade.id && !hit.trade.own) location.href = at(`/jobs/${hit.trade.id}`);
  });
  const write = (): void => {
    stage.redraw();
    const list = [...shown()].sort((a, b) => a.duration - b.duration || b.smoothness - a.smoothness);
    fill(rows, table(t("trade"), [t("plan"), `#${t("duration")}, s`, "#" + t("against_this"), `#${t("roughness")}, mm²/s³`, "#" + t("against_this"), t("compare")], list.map((each) => [
      each.own ? h("strong", {}, t("this_plan")) : each.id ? h("a", { href: at(`/jobs/${each.id}`) }, h("bdi", {}, each.name)) : each.name, fixed(each.duration, 4), each.own ? "–" : signed(each.duration / own.duration - 1),
      number(each.smoothness, 4), each.own || own.smoothness === 0 ? "–" : signed(each.smoothness / own.smoothness - 1), each.id && !each.own ? h("a", { href: at(`/compare?a=${id}&b=${each.id}`) }, t("compare")) : "",
    ])));
  };
  const load = async (): Promise<void> => {
    const list = await getJson<{ jobs: ListedJob[] }>(`/v1/jobs?kind=contour&state=succeeded&limit=20&reference=${encodeURIComponent(reference)}`);
    const results = await Promise.all(list.jobs.filter((each) => each.id !== id).map(async (each) => {
      const { summary } = await resultParts<Result>(each.id, "summary");
      return summary.coarse_smoothness ? { id: each.id, name: each.name || each.id, duration: summary.duration, smoothness: roughness(summary.coarse_smoothness), own: false } : null;
    }));
    plans = results.filter((each) => each !== null);
    write();
  };
  const five = h("button", { type: "button", click: async () => {
    five.disabled = true;
    try {
      const posted = await Promise.all(settings.map((smoothness) => postJson<ListedJob>("/v1/jobs", withSmoothness(document, smoothness, reference, t("smoothness_name", { value: number(smoothness) })))));
      note.textContent = t("five_posted");
      for (const each of posted) await getJson(`/v1/jobs/${each.id}`).then(() => ended(each.id));
      note.textContent = t("five_done");
      await load();
    } catch (error) {
      note.textContent = error instanceof Refused ? `${error.problem.title}: ${error.message}` : t("failed");
    }
    five.disabled = false;
  } }, t("post_five"));
  write();
  load().catch(() => {}); // the picture stays with what this plan tells
  return panel(t("trade"), h("p", { class: "soft" }, t("trade_note")), legend({ colour: "--c1", name: t("this_plan"), kind: "dot" }, { colour: "--c0", name: t("plans_of_reference", { reference: document.reference || "–" }), kind: "dot" }, told.length > 0 && { colour: "--c5", name: t("told_by_plan"), kind: "dashed" }),
    stage.element, h("p", { class: "controls" }, five), note, folded(t("as_table"), () => rows));
}

const signed = (share: number): string => (share === 0 ? "0 %" : (share > 0 ? "+" : "−") + percent(Math.abs(share)));

/** Waits until a job has ended: each request is held by the service for up to half a minute. */
async function ended(id: string): Promise<void> {
  for (;;) {
    const response = await working(fetch(at(`/v1/jobs/${id}`), { headers: { Accept: "application/json", Prefer: "wait=30" }, credentials: "same-origin" }));
    if (!response.ok) return;
    const { state } = (await working(response.json())) as ListedJob;
    if (state !== "queued" && state !== "running") return;
  }
}

/** Returns the document of a job with another setting of smoothness, under the reference that groups the plans. Other members stay, but for deadline and callback, which are the first plan's. */
export function withSmoothness<D extends Document>(document: D, smoothness: number, reference: string, suffix: string): D {
  const { stretch: _, ...redundancy } = document.spec.machine.redundancy ?? {};
  return {
    ...document, deadline: null, callback: null, reference, name: [(document.name ?? "").slice(0, 160), suffix].filter((each) => each).join(", "),
    spec: { ...document.spec, machine: { ...document.spec.machine, redundancy: { ...redundancy, method: "joint", smoothness } } },
  };
}
