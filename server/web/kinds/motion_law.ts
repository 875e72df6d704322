/** A motion law: its curves with the ranges that it had to keep, what other laws would take, its spectrum, the cam and the load of its drive, tables for controllers. */
import { at, getJson } from "../base/api";
import { append, h } from "../base/dom";
import { fixed, number, percent } from "../base/numbers";
import type { PlannedJob } from "../base/planned_job";
import { working } from "../base/work";
import { type Piece, lawLine } from "./bernstein";
import { type BSpline, splineLine, splinePoint } from "./bspline";
import { type Box, Chart, type ChartOptions } from "./chart";
import { Plane, hold, nothing } from "./plane";
import { type TextKey, curveOf, envelope, figures, folded, follow, followed, legend, panel, resultParts, t, table } from "./parts";

interface Range {
  min?: number;
  max?: number;
}
type Value = number | Range | null | undefined;
export interface Point {
  at: number | Range;
  position?: Value;
  velocity?: Value;
  acceleration?: Value;
  jerk?: Value;
  section?: { [order: string]: Value } | string | null;
  law?: string | null;
}
interface Extreme {
  value: number;
  at: number;
}
interface Section {
  degree: number;
  begin: number;
  end: number;
  law: string | null;
  rise: number;
  cv: number | null;
  ca: number | null;
  cj: number | null;
  peaks?: { velocity: number; acceleration: number; jerk: number };
}
interface Cam {
  type: string;
  follower: string;
  base_radius: number;
  pressure_angle: { max: Extreme; min: Extreme } | null;
  profile_radius: Extreme | null;
  concave_radius: Extreme | null;
  stress: Extreme | null;
  profile: BSpline;
  other_flank: BSpline | null;
  pitch_curve: BSpline | null;
}
interface Load {
  unit: string;
  speed_unit: string;
  rms: number;
  mean_power: number;
  max: Extreme;
  min: Extreme;
  max_power: Extreme;
  curve: { phi: number[]; load: number[]; speed: number[]; power: number[] };
}
interface Result {
  summary: { objective: number; peak_velocity: number; peak_acceleration: number; peak_jerk: number; cycle_duration: number; stroke: number; degree: number };
  bound?: { objective: number };
  details: {
    master: { unit: string; begin: number; length: number };
    angles: number[];
    sections: Section[];
    classical?: { objective: number; peak_velocity: number; peak_acceleration: number; peak_jerk: number; pieces?: Piece[] };
    active_set?: { objective: number; degree: number } | null;
    spectrum?: { frequency: number[]; law: number[]; classical: number[] };
    cam?: Cam;
    load?: Load;
  };
}
interface Spec {
  spec: {
    points: Point[];
    slave?: { unit?: string };
    cam?: { roller_radius?: number };
    drive?: { velocity?: number; acceleration?: number; jerk?: number; torque?: number; force?: number };
  };
}

const orders = ["position", "velocity", "acceleration", "jerk"] as const;
const columns = ["s", "v", "a", "j"];

const ends = (value: Value): [number, number] | null =>
  value == null ? null : typeof value === "number" ? [value, value] : [value.min ?? -Infinity, value.max ?? Infinity];

/** Returns what a document asks of one order: ranges and limits of sections as boxes, numbers as dots at the angles that the plan has chosen. */
export function asked(points: Point[], angles: number[], end: number, order: (typeof orders)[number]): { boxes: Box[]; dots: { x: number; y: number; colour: string }[] } {
  const boxes: Box[] = [], dots: { x: number; y: number; colour: string }[] = [];
  points.forEach((point, k) => {
    const angle = angles[k] ?? (typeof point.at === "number" ? point.at : NaN), next = k + 1 < points.length ? (angles[k + 1] ?? end) : end;
    const place = ends(point.at) ?? [angle, angle], value = ends(point[order]);
    if (value && value[0] === value[1]) {
      if (place[0] !== place[1]) boxes.push({ x0: place[0], x1: place[1], y0: value[0], y1: value[1], colour: "--c1" });
      dots.push({ x: angle, y: value[0], colour: "--c1" });
    } else if (value) boxes.push({ x0: place[0], x1: place[1], y0: value[0], y1: value[1], colour: "--c1" });
    else if (place[0] !== place[1] && order === "position") boxes.push({ x0: place[0], x1: place[1], y0: -Infinity, y1: Infinity, colour: "--c1" });
    const section = typeof point.section === "object" && point.section ? ends(point.section[order]) : null;
    for (const limit of section ?? []) if (Number.isFinite(limit)) boxes.push({ x0: angle, x1: next, y0: limit, y1: limit, colour: "--c6" });
  });
  return { boxes, dots };
}

const lawNames: Record<string, TextKey> = {
  polynomial_345: "law_polynomial_345", polynomial_4567: "law_polynomial_4567", modified_sine: "law_modified_sine", modified_trapezoid: "law_modified_trapezoid",
  inclined_sine: "law_inclined_sine", simple_harmonic: "law_simple_harmonic", quadratic: "law_quadratic", straight: "law_straight",
  gutman_1: "law_gutman_1", gutman_2: "law_gutman_2", gutman_3: "law_gutman_3",
  double_harmonic_from_dwell: "law_double_harmonic_from_dwell", double_harmonic_to_dwell: "law_double_harmonic_to_dwell", harmonic_combination_from_dwell: "law_harmonic_combination_from_dwell",
  harmonic_combination_to_dwell: "law_harmonic_combination_to_dwell", polynomial_3456_from_dwell: "law_polynomial_3456_from_dwell", polynomial_3456_to_dwell: "law_polynomial_3456_to_dwell",
  sine_straight_combination: "law_sine_straight_combination",
};
const nameOfLaw = (law: string | null): string => (law === null ? t("law_spline") : law in lawNames ? t(lawNames[law]!) : law.replace(/_/g, " "));

export async function mountMotionLaw(section: HTMLElement, id: string, job: PlannedJob | null): Promise<void> {
  const result = await resultParts<Result>(id, "summary", "bound", "details.master", "details.angles", "details.sections", "details.classical", "details.active_set", "details.spectrum", "details.cam", "details.load");
  const { summary, details } = result, { master } = details;
  const spec = await getJson<Spec>(`/v1/jobs/${id}/spec`);
  const slave = spec.spec.slave?.unit ?? "mm", over = `${master.unit === "s" ? t("time") : master.unit === "deg" ? t("master_angle") : t("master_way")}, ${master.unit}`;
  const end = master.begin + master.length, angle = master.unit === "deg";
  const units = [slave, `${slave}/s`, `${slave}/s²`, `${slave}/s³`];
  section.append(h("h2", {}, t("law_heading")));

  if (job) {
    // A law over time has a step in s, any other one in the master's unit.
    const step = master.length / Math.max(1, job.rows - 1);
    const data = await envelope(id, columns, 1200), x = data.rows.map((row) => master.begin + row * step);
    const shared = followed(job, master.begin, step), { drive } = spec.spec;
    const beside = details.classical?.pieces, shown = h("input", { type: "checkbox", checked: true });
    const perPiece = beside ? Math.max(4, Math.min(40, Math.ceil(1200 / beside.length))) : 0;
    const classical = beside ? orders.map((_, k) => ({ name: t("law_classical"), colour: "--rapid", dashed: true, ...lawLine(beside, k, master.length / summary.cycle_duration, perPiece) })) : [];
    const charts = orders.map((order, k) => {
      const curve = curveOf(data, columns[k]!, x, t(order), "--c0"), limit = k > 0 ? drive?.[order as "velocity"] : undefined;
      return new Chart({
        label: t("law_chart", { order: t(order) }), height: k === 0 ? 220 : 150, xName: k === 0 ? over : "", yName: `${t(order)}, ${units[k]}`, unit: units[k]!, angle, curves: [...classical.slice(k, k + 1), ...(curve ? [curve] : [])],
        ...asked(spec.spec.points, details.angles, end, order), rules: limit ? [{ value: limit, colour: "--c6" }, { value: -limit, colour: "--c6" }] : [], ...shared,
      });
    });
    shown.addEventListener("change", () => charts.forEach((each, k) => {
      each.options.curves = each.options.curves.filter((curve) => curve !== classical[k]);
      if (shown.checked) each.options.curves.unshift(classical[k]!);
      each.redraw();
    }));
    const limits = spec.spec.points.some((point) => typeof point.section === "object" && point.section) || drive !== undefined;
    section.append(panel(t("law_curves"), legend({ colour: "--c0", name: t("law_this") }, { colour: "--c1", name: t("law_value"), kind: "dot" },
      { colour: "--c1", name: t("law_range"), kind: "box" }, limits && { colour: "--c6", name: t("law_limit") }, classical.length > 0 && { colour: "--rapid", name: t("law_classical"), kind: "dashed" }), classical.length > 0 ? h("label", { class: "choice" }, shown, t("law_show_classical")) : null, ...charts.map((each) => each.element)));
    follow(job, charts);
    for (const each of charts) each.redraw();
  }

  section.append(lawsBeside(result, slave), sections(details.sections, slave, master.unit));
  const wide = h("div", { class: "side-by-side" });
  if (details.cam) wide.append(cam(details.cam, spec, job, master, section));
  if (details.spectrum) wide.append(spectrum(details.spectrum, units[2]!));
  if (wide.childElementCount > 0) section.append(wide);
  if (details.load) section.append(load(details.load, spec, over, angle, master, job));
  if (job) section.append(tables(id));
}

function lawsBeside({ summary, bound, details }: Result, slave: string): HTMLElement {
  const rows: (string | Node)[][] = [];
  const compared = (value: number, own: number): string => (own > 0 && Math.abs(value / own - 1) > 5e-5 ? `${number(value, 5)} (${value > own ? "+" : "−"}${percent(Math.abs(value / own - 1))})` : number(value, 5));
  rows.push([t("law_this"), number(summary.objective, 5), number(summary.peak_velocity, 5), number(summary.peak_acceleration, 5), number(summary.peak_jerk, 5)]);
  const { classical, active_set } = details;
  if (classical)
    rows.push([t("law_classical"), compared(classical.objective, summary.objective), compared(classical.peak_velocity, summary.peak_velocity),
      compared(classical.peak_acceleration, summary.peak_acceleration), compared(classical.peak_jerk, summary.peak_jerk)]);
  if (active_set) rows.push([t("law_active_set", { degree: active_set.degree }), compared(active_set.objective, summary.objective), "–", "–", "–"]);
  if (bound) rows.push([t("law_bound"), compared(bound.objective, summary.objective), "–", "–", "–"]);
  return panel(t("law_beside"), h("p", { class: "soft" }, t("law_beside_note")),
    table(t("law_beside"), [t("law"), "#J", `#${t("velocity")}, ${slave}/s`, `#${t("acceleration")}, ${slave}/s²`, `#${t("jerk")}, ${slave}/s³`], rows));
}

function sections(list: Section[], slave: string, unit: string): HTMLElement {
  const shown = (value: number | null): string => (value === null ? "–" : number(value, 4));
  const rows = (from: number, to: number) => list.slice(from, to).map((each, k) => [from + k + 1, `${number(each.begin, 5)} … ${number(each.end, 5)}`, nameOfLaw(each.law), each.degree, number(each.rise, 5), shown(each.cv), shown(each.ca), shown(each.cj)]);
  const headings = ["#" + t("section"), `${t("from_to")}, ${unit}`, t("law"), "#" + t("degree"), `#${t("rise")}, ${slave}`, "#Cv", "#Ca", "#Cj"];
  const most = 40;
  return panel(t("sections"), table(t("sections"), headings, rows(0, most)),
    list.length > most ? folded(t("sections_more", { n: list.length - most }), () => table(t("sections"), headings, rows(most, 1000))) : null);
}

function spectrum(spectrum: NonNullable<Result["details"]["spectrum"]>, unit: string): HTMLElement {
  const { frequency, law, classical } = spectrum, largest = Math.max(...law.slice(1), ...classical.slice(1), 0);
  // Harmonics beyond the last that matters are left out of the picture, not of the table.
  let last = frequency.length - 1;
  while (last > 8 && Math.max(law[last]!, classical[last] ?? 0) < 0.01 * largest) --last;
  const stems = (values: number[], shift: number, name: string, colour: string) => {
    const step = (frequency[2] ?? 2) - (frequency[1] ?? 1), x: number[] = [], low: number[] = [];
    for (let k = 0; k <= last; ++k) {
      const place = frequency[k]! + shift * step;
      x.push(place - 0.14 * step, place - 0.14 * step, place + 0.14 * step, place + 0.14 * step);
      low.push(0, values[k] ?? 0, values[k] ?? 0, 0);
    }
    return { name, colour, x, low };
  };
  const step = (frequency[2] ?? 2) - (frequency[1] ?? 1);
  const chart = new Chart({
    label: t("spectrum_chart"), height: 240, x: () => ({ from: Math.max(0, (frequency[0] ?? 0) - step / 2), to: frequency[last]! + step / 2 }), xName: t("frequency") + ", Hz", yName: `${t("amplitude")}, ${unit}`, zero: true,
    curves: [stems(law, -0.17, t("law_this"), "--c0"), stems(classical, 0.17, t("law_classical"), "--c1")],
  });
  chart.redraw();
  return panel(t("spectrum"), h("p", { class: "soft" }, t("spectrum_note")), legend({ colour: "--c0", name: t("law_this") }, { colour: "--c1", name: t("law_classical") }), chart.element,
    folded(t("as_table"), () => table(t("spectrum"), [`#${t("frequency")}, Hz`, `#${t("law_this")}, ${unit}`, `#${t("law_classical")}, ${unit}`],
      frequency.map((each, k) => [number(each, 5), number(law[k]!, 4), number(classical[k] ?? NaN, 4)]))));
}

function cam(cam: Cam, spec: Spec, job: PlannedJob | null, master: Result["details"]["master"], section: HTMLElement): HTMLElement {
  const flat = cam.type !== "barrel", roller = spec.spec.cam?.roller_radius ?? 0;
  const profile = splineLine(cam.profile, 720), other = cam.other_flank ? splineLine(cam.other_flank, 720) : null, pitch = cam.pitch_curve ? splineLine(cam.pitch_curve, 360) : null;
  const extent = nothing();
  for (const [x, y] of [...profile, ...(other ?? [])]) hold(extent, x, y);
  if (flat) hold(extent, 0, 0, cam.base_radius);
  for (const [x, y] of pitch ?? []) hold(extent, x, y, roller);
  const place = (): number | null => {
    const row = job?.view.get().row;
    return row == null || !job ? null : master.begin + (row * master.length) / Math.max(1, job.rows - 1);
  };
  const follower = cam.pitch_curve ?? cam.profile;
  const plane = new Plane({
    label: t("cam_picture"), height: (width) => (flat ? Math.min(440, Math.max(260, width * 0.8)) : Math.min(300, Math.max(200, width / 2))), extent: () => extent,
    draw({ context, colour, drew }, at) {
      const path = (points: [number, number][]): void => {
        context.beginPath();
        points.forEach(([x, y], k) => (k === 0 ? context.moveTo(at.x(x), at.y(y)) : context.lineTo(at.x(x), at.y(y))));
        drew(points.length);
      };
      if (flat) {
        path(profile);
        context.closePath();
        context.fillStyle = colour("--idle-back");
        context.fill();
        context.setLineDash([3, 4]);
        context.strokeStyle = colour("--soft");
        context.beginPath();
        context.arc(at.x(0), at.y(0), cam.base_radius * at.scale, 0, 2 * Math.PI);
        context.stroke();
        context.setLineDash([]);
        context.beginPath();
        context.moveTo(at.x(0) - 7, at.y(0));
        context.lineTo(at.x(0) + 7, at.y(0));
        context.moveTo(at.x(0), at.y(0) - 7);
        context.lineTo(at.x(0), at.y(0) + 7);
        context.stroke();
      }
      if (pitch) {
        context.strokeStyle = colour("--soft");
        context.setLineDash([6, 4]);
        path(pitch);
        context.stroke();
        context.setLineDash([]);
      }
      context.strokeStyle = colour("--c0");
      context.lineWidth = 2;
      for (const each of [profile, other]) {
        if (!each) continue;
        path(each);
        context.stroke();
      }
    },
    over({ context, colour }, at) {
      const phi = place();
      if (phi === null) return;
      const [x, y] = splinePoint(follower, phi);
      context.strokeStyle = context.fillStyle = colour("--c1");
      context.lineWidth = 2;
      context.beginPath();
      context.arc(at.x(x), at.y(y), Math.max(3, roller * at.scale), 0, 2 * Math.PI);
      context.stroke();
      context.beginPath();
      context.arc(at.x(x), at.y(y), 2, 0, 2 * Math.PI);
      context.fill();
    },
  });
  plane.redraw();
  job?.view.follow(() => plane.move());
  if (job) {
    // The place on the cam next to the pointer is the cursor.
    const nearest = (event: MouseEvent): number | null => {
      const point = plane.point(event);
      if (!point) return null;
      const line = pitch ?? profile;
      let best = 0, least = Infinity;
      line.forEach(([x, y], k) => {
        const distance = (x - point.x) ** 2 + (y - point.y) ** 2;
        if (distance < least) (least = distance), (best = k);
      });
      return Math.round((best / (line.length - 1)) * (job.rows - 1));
    };
    plane.stage.canvas.addEventListener("pointermove", (event) => job.view.point(nearest(event)));
    plane.stage.canvas.addEventListener("click", (event) => job.view.set({ row: nearest(event), locked: true }));
  }
  const extreme = (name: TextKey, value: Extreme | null | undefined, unit: string): [string, string] | null =>
    value ? [t(name), `${number(value.value, 4)} ${unit} ${t("at_angle", { angle: number(value.at, 4) })}`] : null;
  return panel(t("cam"), legend({ colour: "--c0", name: flat ? t("cam_profile") : t("cam_flanks") }, pitch !== null && { colour: "--soft", name: t("cam_pitch"), kind: "dashed" }, { colour: "--c1", name: t("cam_follower"), kind: "dot" }),
    plane.element,
    figures([t("base_radius"), `${number(cam.base_radius, 5)} mm`], extreme("pressure_angle", cam.pressure_angle?.max, "deg"), extreme("profile_radius", cam.profile_radius, "mm"),
      extreme("concave_radius", cam.concave_radius, "mm"), extreme("hertz", cam.stress, "N/mm²")));
}

function load(load: Load, spec: Spec, over: string, angle: boolean, master: Result["details"]["master"], job: PlannedJob | null): HTMLElement {
  const { curve } = load, limit = spec.spec.drive?.torque ?? spec.spec.drive?.force;
  const what = load.unit.includes("m") && load.unit !== "mm" ? t("torque") : t("force");
  const step = job ? master.length / Math.max(1, job.rows - 1) : 1;
  const shared: Pick<ChartOptions, "x"> = job ? followed(job, master.begin, step) : { x: () => ({ from: master.begin, to: master.begin + master.length }) };
  const charts = ([["load", what, load.unit], ["speed", t("drive_speed"), load.speed_unit], ["power", t("power"), "W"]] as const).map(([column, name, unit], k) => new Chart({
    label: t("load_chart", { what: name }), height: 150, xName: k === 0 ? over : "", yName: `${name}, ${unit}`, unit, angle,
    curves: [{ name, colour: "--c0", x: curve.phi, low: curve[column] }], rules: column === "load" && limit ? [{ value: limit, colour: "--c6" }, { value: -limit, colour: "--c6" }] : [], ...shared,
  }));
  if (job) follow(job, charts);
  for (const each of charts) each.redraw();
  return panel(t("load"), figures([t("load_peak", { what }), `${number(Math.max(Math.abs(load.max.value), Math.abs(load.min.value)), 4)} ${load.unit}`], [t("load_rms", { what }), `${number(load.rms, 4)} ${load.unit}`],
    [t("power_peak"), `${number(load.max_power.value, 4)} W`], [t("power_mean"), `${number(load.mean_power, 4)} W`]), ...charts.map((each) => each.element));
}

const layouts = ["twincat_nc", "twincat_mc3", "isg", "lcamhdl_xy", "lcamhdl_basic", "lcamhdl_advanced", "codesys_xyva", "codesys_xy", "csv"] as const;

/** The tables for controllers, each with how far it is from the law: asked for when the list is seen, since each table is made anew. */
function tables(id: string): HTMLElement {
  const cells = new Map<string, HTMLElement>();
  const rows = layouts.map((layout) => {
    const cell = h("span", { class: "soft" }, "…");
    cells.set(layout, cell);
    return [h("a", { href: at(`/v1/jobs/${id}/setpoints?layout=${layout}`), download: true }, t(`table_${layout}`)), t(`rows_${layout}`), cell];
  });
  const element = panel(t("tables"), h("p", { class: "soft" }, t("tables_note")), table(t("tables"), [t("controller"), t("table_content"), t("refit")], rows));
  const button = h("button", { type: "button" }, t("tables_measure"));
  const measure = async (): Promise<void> => {
    button.disabled = true;
    for (const layout of layouts) {
      const cell = cells.get(layout)!;
      try {
        const response = await fetch(at(`/v1/jobs/${id}/setpoints?layout=${layout}`), { credentials: "same-origin" });
        await response.arrayBuffer();
        cell.textContent = response.ok ? refitText(response.headers.get("X-Refit-Error")) : t("table_refused");
      } catch {
        cell.textContent = "–";
      }
    }
    button.remove();
  };
  button.addEventListener("click", () => void working(measure()));
  append(element, button);
  return element;
}

/** Returns the header X-Refit-Error in the words of the page. */
export const refitText = (header: string | null): string =>
  header === null ? t("refit_none") : header.replace(/\bposition\b/g, t("position")).replace(/\bvelocity\b/g, t("velocity")).replace(/\bacceleration\b/g, t("acceleration")).replace(/\bjerk\b/g, t("jerk"));
