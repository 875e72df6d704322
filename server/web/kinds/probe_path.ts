/** A probe path: tube and points in plan and elevation, deviation against its tolerance, speed, and what the head does when. */
import { lastAtMost } from "../base/search";
import { getJson } from "../base/api";
import { h } from "../base/dom";
import { duration, fixed, number, percent } from "../base/numbers";
import type { PlannedJob } from "../base/planned_job";
import { Chart } from "./chart";
import { type Extent, Plane, type Placing, hold, nothing } from "./plane";
import { type Envelope, type TextKey, curveOf, envelope, figures, folded, follow, followed, legend, panel, resultParts, t, table } from "./parts";
import type { Pen } from "./stage";

interface Phase {
  kind: string;
  start: number;
  end: number;
  point: number;
}
interface Result {
  summary: { duration: number; path_length: number; max_deviation: number; mean_speed: number; speed_ripple: number };
  details: { stops_duration?: number; points: { index: number; time: number; distance: number }[]; phases: Phase[]; phases_total: number };
}
interface Spec {
  spec: { points: number[][]; tolerance: number; speed: number };
}

const phaseColours: Record<string, string> = { accelerate: "--c2", hold: "--c0", brake: "--c1", turn: "--c4", rest: "--c7", interval: "--c5" };
const phaseNames: Record<string, TextKey> = { accelerate: "phase_accelerate", hold: "phase_hold", brake: "phase_brake", turn: "phase_turn", rest: "phase_rest", interval: "phase_interval" };
const nameOf = (kind: string): string => (kind in phaseNames ? t(phaseNames[kind]!) : kind);
const colourOf = (kind: string): string => phaseColours[kind] ?? "--rapid";

/** Returns how long the head is in each kind of phase, s, in the order in which they first come. */
export function phaseTimes(phases: Phase[]): Map<string, number> {
  const times = new Map<string, number>();
  for (const each of phases) times.set(each.kind, (times.get(each.kind) ?? 0) + each.end - each.start);
  return times;
}

export async function mountProbePath(section: HTMLElement, id: string, job: PlannedJob | null): Promise<void> {
  const { summary, details } = await resultParts<Result>(id, "summary", "details.stops_duration", "details.points", "details.phases", "details.phases_total");
  section.append(h("h2", {}, t("probe_heading")));
  const stops = details.stops_duration;
  section.append(figures([t("duration"), duration(summary.duration)], stops !== undefined && stops > summary.duration && [t("stops_duration"), `${duration(stops)} (+${percent(stops / summary.duration - 1)})`],
    [t("mean_speed"), `${number(summary.mean_speed, 4)} mm/s`], [t("ripple"), percent(summary.speed_ripple)]));
  if (!job) return;
  const { spec } = await getJson<Spec>(`/v1/jobs/${id}/spec`), inSpace = spec.points[0]!.length > 2;
  const data = await envelope(id, ["x", "y", ...(inSpace ? ["z"] : []), "deviation", "v"], 2000);
  const time = data.rows.map((row) => row * job.cycle), shared = followed(job, 0, job.cycle);
  const kinds = phaseTimes(details.phases);
  const bands = details.phases.map((each) => ({ x0: each.start, x1: each.end, colour: colourOf(each.kind) }));

  const planes = [plane(job, spec, data, time, details, 0, 1)];
  if (inSpace) planes.push(plane(job, spec, data, time, details, 0, 2));
  const pictures = h("div", { class: "side-by-side" });
  planes.forEach((each, k) => pictures.append(h("figure", { class: "plain" }, h("figcaption", {}, t(k === 0 ? (inSpace ? "plan_xy" : "plane_xy") : "elevation_xz")), each.element)));
  section.append(panel(t("probe_path"), legend(...[...kinds.keys()].map((each) => ({ colour: colourOf(each), name: nameOf(each) })), { colour: "--rapid", name: t("tube_of", { tolerance: number(spec.tolerance) }), kind: "box" as const },
    { colour: "--text", name: t("points"), kind: "dot" as const }), pictures));

  const deviation = curveOf(data, "deviation", time, t("deviation"), "--c0"), speed = curveOf(data, "v", time, t("speed"), "--c0");
  const passings = details.points.map((each) => ({ x: each.time, y: each.distance, colour: "--text" }));
  const charts = [
    new Chart({ label: t("deviation_chart", { most: number(summary.max_deviation, 4), tolerance: number(spec.tolerance) }), height: 180, xName: `${t("time")}, s`, yName: `${t("deviation")}, mm`, unit: "mm", zero: true, include: 0.3,
      curves: deviation ? [deviation] : [], rules: [{ value: spec.tolerance, colour: "--c6" }], bands, dots: passings, ...shared }),
    new Chart({ label: t("speed_chart"), height: 150, xName: "", yName: `${t("speed")}, mm/s`, unit: "mm/s", zero: true, curves: speed ? [speed] : [], rules: [{ value: spec.speed, colour: "--c6" }], bands, ...shared }),
  ];
  follow(job, [...charts, ...planes.map((each) => ({ redraw: () => each.move(), move: () => each.move() }))]);
  for (const each of [...charts, ...planes]) each.redraw();
  const total = [...kinds.values()].reduce((sum, each) => sum + each, 0);
  section.append(panel(t("deviation_heading"),
    h("p", {}, t("deviation_sentence", { most: fixed(summary.max_deviation, 4), tolerance: number(spec.tolerance), share: fixed((summary.max_deviation / spec.tolerance) * 100, 1) + " %" })),
    legend({ colour: "--c6", name: t("law_limit"), kind: "dashed" }, ...[...kinds.keys()].map((each) => ({ colour: colourOf(each), name: nameOf(each), kind: "box" as const }))), ...charts.map((each) => each.element)));
  section.append(panel(t("phases"), table(t("phases"), [t("phase"), `#${t("time")}, s`, "#" + t("share")], [...kinds].map(([kind, seconds]) => [nameOf(kind), fixed(seconds, 3), percent(seconds / total)])),
    folded(t("phases_all", { n: details.phases.length, of: details.phases_total }), () => table(t("phases"), [t("phase"), `#${t("from")}, s`, `#${t("to")}, s`, "#" + t("point")],
      details.phases.slice(0, 2000).map((each) => [nameOf(each.kind), fixed(each.start, 4), fixed(each.end, 4), each.point])))));
  const go = (seconds: number) => h("button", { type: "button", class: "plain", click: () => job.view.set({ row: Math.round(seconds / job.cycle), locked: true }) }, fixed(seconds, 4));
  section.append(panel(t("points_heading"), folded(t("points_all", { n: spec.points.length }), () => table(t("points"), ["#" + t("point"), "#x, mm", "#y, mm", ...(inSpace ? ["#z, mm"] : []), `#${t("passed_at")}, s`, `#${t("distance")}, mm`],
    details.points.map((each) => [each.index, ...(spec.points[each.index] ?? []).map((value) => number(value)), go(each.time), number(each.distance, 3)])))));
}

function plane(job: PlannedJob, spec: Spec["spec"], data: Envelope, time: ArrayLike<number>, { phases }: Result["details"], across: number, up: number): Plane {
  const names = ["x", "y", "z"], low = [data.low.get(names[across]!)!, data.low.get(names[up]!)!], high = [data.high.get(names[across]!)!, data.high.get(names[up]!)!];
  const count = data.rows.length, extent: Extent = nothing();
  for (const point of spec.points) hold(extent, point[across]!, point[up]!, spec.tolerance);
  const middle = (k: number, axis: number): number => (low[axis]![k]! + high[axis]![k]!) / 2;
  const picture = new Plane({
    label: t("tube_picture", { n: spec.points.length }), height: (width) => Math.min(420, Math.max(180, width * Math.min(0.9, Math.max(0.3, (extent.y1 - extent.y0) / (extent.x1 - extent.x0 || 1)))) + 24), extent: () => extent,
    draw({ context, colour, drew }, at) {
      context.lineJoin = context.lineCap = "round";
      context.beginPath();
      spec.points.forEach((point, k) => (k === 0 ? context.moveTo(at.x(point[across]!), at.y(point[up]!)) : context.lineTo(at.x(point[across]!), at.y(point[up]!))));
      context.strokeStyle = colour("--line");
      context.lineWidth = Math.max(3, 2 * spec.tolerance * at.scale);
      context.stroke();
      context.strokeStyle = colour("--rapid");
      context.lineWidth = 1;
      context.stroke();
      context.lineWidth = 2;
      let phase = 0;
      for (let k = 1; k < count; ++k) {
        while (phase + 1 < phases.length && phases[phase]!.end <= time[k - 1]! + 1e-9) ++phase;
        context.strokeStyle = colour(colourOf(phases[phase]?.kind ?? ""));
        context.beginPath();
        context.moveTo(at.x(middle(k - 1, 0)), at.y(middle(k - 1, 1)));
        context.lineTo(at.x(middle(k, 0)), at.y(middle(k, 1)));
        context.stroke();
      }
      context.lineCap = "butt";
      context.fillStyle = colour("--text");
      context.textAlign = "left";
      context.textBaseline = "bottom";
      const numbered = spec.points.length <= 60;
      spec.points.forEach((point, k) => {
        context.beginPath();
        context.arc(at.x(point[across]!), at.y(point[up]!), 3, 0, 2 * Math.PI);
        context.fill();
        if (numbered) context.fillText(String(k), at.x(point[across]!) + 5, at.y(point[up]!) - 4);
      });
      drew(count + 2 * spec.points.length);
    },
    over: (pen: Pen, at: Placing) => {
      const { row } = job.view.get();
      if (row === null) return;
      const k = Math.max(0, lastAtMost(data.rows, row)), next = Math.min(count - 1, k + 1), width = data.rows[next]! - data.rows[k]!, share = width > 0 ? Math.min(1, (row - data.rows[k]!) / width) : 0;
      const place = [0, 1].map((axis) => middle(k, axis) + share * (middle(next, axis) - middle(k, axis)));
      pen.context.strokeStyle = pen.colour("--focus");
      pen.context.lineWidth = 3;
      pen.context.beginPath();
      pen.context.arc(at.x(place[0]!), at.y(place[1]!), 7, 0, 2 * Math.PI);
      pen.context.stroke();
    },
  });
  const nearest = (event: MouseEvent): number | null => {
    const point = picture.point(event);
    if (!point) return null;
    let best = -1, least = Infinity;
    for (let k = 0; k < count; ++k) {
      const distance = (middle(k, 0) - point.x) ** 2 + (middle(k, 1) - point.y) ** 2;
      if (distance < least) (least = distance), (best = k);
    }
    return Math.sqrt(least) * point.scale < 40 && best >= 0 ? data.rows[best]! : null;
  };
  picture.stage.canvas.addEventListener("pointermove", (event) => job.view.point(nearest(event)));
  picture.stage.canvas.addEventListener("pointerleave", () => job.view.point(null));
  picture.stage.canvas.addEventListener("click", (event) => {
    const row = nearest(event);
    if (row !== null) job.view.set({ row, locked: true });
  });
  return picture;
}
