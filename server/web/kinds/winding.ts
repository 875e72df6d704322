/** A winding: part, needle and the wire laid so far from above and from the side, regions over time, clearance, feed, axes, and where the needle can be. */
import type { Body, Scene } from "../base/scene";
import { lastAtMost } from "../base/search";
import { Refused, at, getJson } from "../base/api";
import { append, h } from "../base/dom";
import { fixed, number, percent } from "../base/numbers";
import type { PlannedJob } from "../base/planned_job";
import { Chart, type Curve, line } from "./chart";
import { type Envelope, type TextKey, curveOf, envelope, figures, folded, follow, followed, legend, panel, resultParts, t, table } from "./parts";
import { type Extent, Plane, hold, nothing } from "./plane";
import { type Pen, Stage } from "./stage";

type Vec = [number, number, number];
interface SupportPoint {
  coil: number;
  turn: number;
  region: string;
  end: "begin" | "end";
  position: Vec;
  time?: number;
}
interface Turn {
  coil: number;
  turn: number;
  layer: number;
  layer_jump: boolean;
  begins: number;
}
interface Axis {
  name: string;
  unit: string;
  lowest: number;
  highest: number;
  travel: number;
}
interface Clearance {
  minimum: number;
  coil: number;
  turn: number;
  region: string;
  link: boolean;
  nearest: string;
  curve?: { most: number; obstacles: string[]; times: number[]; values: number[]; nearest: number[] };
}
interface Result {
  summary: { duration: number; wire_length: number; resistance: number; strokes_per_minute: number; turns: number; coils: number; clearance: number | null; path_length: number };
  details: {
    feed: string;
    fastest: number;
    turns: Turn[];
    support_points: SupportPoint[];
    axes: Axis[];
    clearance: Clearance | null;
    access?: { step: number; without_pivot_shift: number; with_pivot_shift: number | null } | null;
    turn_time?: { least: number; mean: number; most: number };
    wire?: { force: number; peak: number; least: number; permitted: number };
  };
}
const regionColours: Record<string, string> = { slot: "--c0", head_bottom: "--c4", slot_back: "--c2", head_top: "--c1", coil_change: "--c7", link: "--rapid" };
const regionNames: Record<string, TextKey> = { slot: "region_slot", head_bottom: "region_head_bottom", slot_back: "region_slot_back", head_top: "region_head_top", coil_change: "region_coil_change", link: "region_link" };
const nameOfRegion = (region: string): string => (region in regionNames ? t(regionNames[region]!) : region.replace(/_/g, " "));

export interface Stretch {
  from: number; // s
  to: number;
  region: string; // region of the wire that is laid; link: on the way to the next one
  coil: number;
  turn: number;
}

/** Returns what the needle does when: the fixed pieces by the times of their support points, and the links between them. Empty where no times are known. */
export function stretches(points: SupportPoint[], end: number): Stretch[] {
  const list: Stretch[] = [];
  let at = 0, coil = 1, turn = 1;
  for (let k = 0; k + 1 < points.length; k += 2) {
    const begin = points[k]!, finish = points[k + 1]!;
    if (begin.time === undefined || finish.time === undefined) return [];
    if (begin.time > at) list.push({ from: at, to: begin.time, region: "link", coil, turn });
    ({ coil, turn } = begin);
    if (finish.time > begin.time) list.push({ from: begin.time, to: finish.time, region: begin.region, coil, turn });
    at = Math.max(at, finish.time);
  }
  if (end > at + 1e-9 && list.length > 0) list.push({ from: at, to: end, region: "link", coil, turn });
  return list;
}

export async function mountWinding(section: HTMLElement, id: string, job: PlannedJob | null): Promise<void> {
  const { summary, details } = await resultParts<Result>(id, "summary", "details.feed", "details.fastest", "details.turns", "details.support_points", "details.axes", "details.clearance", "details.access", "details.turn_time", "details.wire");
  section.append(h("h2", {}, t("winding_heading")));
  section.append(figures([t("turns"), summary.coils > 1 ? t("turns_of_coils", { turns: summary.turns, coils: summary.coils }) : String(summary.turns)], details.turn_time && [t("turn_time"), `${fixed(details.turn_time.mean, 3)} s`],
    [t("strokes"), number(summary.strokes_per_minute, 4) + " 1/min"], [t("wire_length"), fixed(summary.wire_length / 1000, 2) + " m"], [t("resistance"), number(summary.resistance, 4) + " Ω"], summary.clearance !== null && [t("clearance"), number(summary.clearance, 4) + " mm"]));
  if (details.clearance) {
    const { minimum, coil, turn, region, link, nearest } = details.clearance;
    section.append(h("p", {}, t(link ? "clearance_sentence_link" : "clearance_sentence", { minimum: number(minimum, 4), coil, turn, region: nameOfRegion(region), nearest: nameOfBody(nearest) })));
  }
  if (job) {
    const axes = details.axes.map((each) => each.name).filter((each) => job.columns.includes(each));
    const columns = [...axes, "v", "brake", "x", "y", "z", "phi", "psi"].filter((each) => job.columns.includes(each));
    const [data, scene] = await Promise.all([envelope(id, columns, 1500, "&frame=part"), job.scene()]);
    const list = stretches(details.support_points, (job.rows - 1) * job.cycle);
    if (list.length > 0) section.append(ribbon(list, details.turns, job));
    section.append(flatViews(scene, details.support_points, data, job));
    section.append(overTime(data, job, details, axes, summary));
  }
  section.append(axesTable(details.axes));
  if (details.access) {
    const { step, without_pivot_shift, with_pivot_shift } = details.access;
    section.append(panel(t("access"), h("p", {}, t("access_note", { step: number(step, 2) })), figures([t("access_straight"), percent(without_pivot_shift)], with_pivot_shift !== null && [t("access_swivelled"), percent(with_pivot_shift)]),
      h("figure", { class: "plain" }, h("img", { src: at(`/jobs/${id}/drawings/clearance_map.svg`), alt: t("access_picture"), loading: "lazy" }))));
  }
}

const bodyNames: Record<string, TextKey> = { stack: "body_stack", "winding tool": "body_tool", pole: "body_pole", "end cap": "body_cap" };
const nameOfBody = (name: string): string => (name in bodyNames ? t(bodyNames[name]!) : name);

/** One line over time with the colour of the region in which wire is laid. */
function ribbon(list: Stretch[], turns: Turn[], job: PlannedJob): HTMLElement {
  const shared = followed(job, 0, job.cycle), readout = h("p", { class: "told", role: "status" }, " "), left = 12, right = 12;
  const at = (seconds: number): Stretch | undefined => list.find((each) => seconds >= each.from && seconds <= each.to);
  const stage: Stage = new Stage({
    label: t("ribbon_picture"), height: 74,
    draw({ context, colour, width, drew }) {
      const { from, to } = shared.x(), x = (value: number): number => left + ((value - from) / (to - from || 1)) * (width - left - right);
      for (const each of list) {
        if (each.to < from || each.from > to) continue;
        const x0 = Math.max(left, x(each.from)), x1 = Math.min(width - right, x(each.to)), free = each.region === "link";
        context.fillStyle = colour(regionColours[each.region] ?? "--c6");
        context.fillRect(x0, free ? 24 : 16, Math.max(0.5, x1 - x0), free ? 14 : 30);
      }
      context.fillStyle = colour("--soft");
      context.textAlign = "left";
      context.textBaseline = "top";
      let free = -Infinity;
      for (const each of turns) {
        const place = x(each.begins);
        if (place < left - 1 || place > width - right) continue;
        context.fillStyle = context.strokeStyle = colour(each.layer_jump ? "--text" : "--soft");
        line(context, place, 12, place, 50);
        const text = (each.coil > 1 || turns.some((other) => other.coil > 1) ? `${each.coil}.` : "") + String(each.turn);
        if (place < free) continue;
        context.fillText(text, place, 54);
        free = place + context.measureText(text).width + 8;
      }
      drew(list.length + turns.length);
    },
    over({ context, colour, width }) {
      const { from, to } = shared.x(), cursor = shared.cursor();
      if (cursor === null) return;
      const x = left + ((cursor - from) / (to - from || 1)) * (width - left - right), found = at(cursor);
      context.strokeStyle = colour("--text");
      context.lineWidth = 2;
      line(context, x, 6, x, 52);
      const text = found ? t("ribbon_readout", { time: fixed(cursor, 3), region: nameOfRegion(found.region), coil: found.coil, turn: found.turn }) : "";
      if (readout.textContent !== text) readout.textContent = text;
    },
  });
  const place = (event: MouseEvent): number => {
    const { from, to } = shared.x();
    return from + ((stage.place(event).x - left) / (stage.width - left - right)) * (to - from);
  };
  stage.canvas.addEventListener("pointermove", (event) => shared.point(place(event)));
  stage.canvas.addEventListener("pointerleave", () => shared.point(null));
  stage.canvas.addEventListener("click", (event) => shared.pick(place(event)));
  follow(job, [stage]);
  stage.redraw();
  const times = new Map<string, number>();
  for (const each of list) times.set(each.region, (times.get(each.region) ?? 0) + each.to - each.from);
  const total = [...times.values()].reduce((sum, each) => sum + each, 0);
  return panel(t("ribbon"), legend(...[...times].sort(([one], [other]) => Number(one === "link") - Number(other === "link")).map(([region, seconds]) => ({ colour: regionColours[region] ?? "--c6", name: `${nameOfRegion(region)} ${percent(seconds / total)}`, kind: "box" as const }))), stage.element, readout,
    folded(t("as_table"), () => table(t("ribbon"), [`#${t("from")}, s`, `#${t("to")}, s`, t("region"), "#" + t("coil"), "#" + t("turn")], list.slice(0, 2000).map((each) => [fixed(each.from, 4), fixed(each.to, 4), nameOfRegion(each.region), each.coil, each.turn]))));
}

/** Part, needle and wire from above and from the side. The part's frame where the scene has it; else the support points alone. */
function flatViews(scene: Scene | null, points: SupportPoint[], data: Envelope, job: PlannedJob): HTMLElement {
  const count = data.rows.length;
  const middle = (column: string, k: number): number => (data.low.get(column)![k]! + data.high.get(column)![k]!) / 2;
  const now = (): number => job.view.get().row ?? job.rows - 1;
  const needle = scene?.bodies.find((each) => each.moves === "tool" && each.kind === "cylinder" && (each.points?.length ?? 0) >= 2);
  const wires = scene?.bodies.filter((each) => each.name === "wire" && each.points) ?? [];
  const flat = (axes: [0 | 1 | 2, 0 | 1 | 2], title: TextKey): [Plane, HTMLElement] => {
    const [a, b] = axes, extent: Extent = nothing(), names = ["x", "y", "z"];
    // The part is far larger than the coil: what is shown is the coil, with the needle's way around it.
    for (const each of points) hold(extent, each.position[a]!, each.position[b]!);
    for (const body of wires) for (const point of body.points!) hold(extent, point[a]!, point[b]!, body.radius ?? 0);
    const room = 0.08 * Math.max(extent.x1 - extent.x0, extent.y1 - extent.y0);
    hold(extent, extent.x0, extent.y0, room);
    hold(extent, extent.x1, extent.y1, room);
    const shape = (extent.y1 - extent.y0) / (extent.x1 - extent.x0 || 1);
    const turned = (local: Vec, k: number): Vec => {
      const phi = (middle("phi", k) * Math.PI) / 180, psi = (middle("psi", k) * Math.PI) / 180;
      // Rz(phi) · Ry(psi), as the scene states it.
      const x = local[0] * Math.cos(psi) + local[2] * Math.sin(psi), z = -local[0] * Math.sin(psi) + local[2] * Math.cos(psi);
      return [middle("x", k) + x * Math.cos(phi) - local[1] * Math.sin(phi), middle("y", k) + x * Math.sin(phi) + local[1] * Math.cos(phi), middle("z", k) + z];
    };
    const picture = new Plane({
      label: t("flat_picture"), height: (width) => Math.min(460, Math.max(220, width * Math.min(1.1, shape) + 30)), extent: () => extent,
      draw({ context, colour, drew }, at) {
        for (const body of scene?.bodies ?? []) {
          if (body.moves !== "none" || !body.outline) continue;
          context.fillStyle = colour("--idle-back");
          context.strokeStyle = colour("--strong");
          context.lineWidth = 1;
          const lift = (u: number, v: number, w: number): Vec => {
            const { frame } = body;
            if (!frame) return [u, v, w];
            return [0, 1, 2].map((k) => frame.origin[k]! + u * frame.x[k]! + v * frame.y[k]! + w * frame.z[k]!) as Vec;
          };
          const loops = [body.outline, ...(body.holes ?? [])];
          if (b === 1 && !body.frame) {
            context.beginPath();
            for (const loop of loops) {
              loop.forEach(([u, v], k) => (k === 0 ? context.moveTo(at.x(u), at.y(v)) : context.lineTo(at.x(u), at.y(v))));
              context.closePath();
              drew(loop.length);
            }
            context.fill("evenodd");
            context.stroke();
          } else {
            // From the side a body is the box around its corners.
            const box = nothing();
            for (const [u, v] of body.outline) for (const w of [body.from ?? 0, body.to ?? 0]) {
              const point = lift(u, v, w);
              hold(box, point[a]!, point[b]!);
            }
            context.globalAlpha = 0.6;
            context.fillRect(at.x(box.x0), at.y(box.y1), (box.x1 - box.x0) * at.scale, (box.y1 - box.y0) * at.scale);
            context.globalAlpha = 1;
            context.strokeRect(at.x(box.x0), at.y(box.y1), (box.x1 - box.x0) * at.scale, (box.y1 - box.y0) * at.scale);
          }
        }
        if (data.low.has("x")) {
          context.strokeStyle = colour("--rapid");
          context.lineWidth = 1;
          context.beginPath();
          for (let k = 0; k < count; ++k) {
            const px = at.x(middle(names[a]!, k)), py = at.y(middle(names[b]!, k));
            k === 0 ? context.moveTo(px, py) : context.lineTo(px, py);
          }
          context.stroke();
          drew(count);
        }
        if (!scene) {
          for (const each of points) {
            context.fillStyle = colour(regionColours[each.region] ?? "--c6");
            context.beginPath();
            context.arc(at.x(each.position[a]!), at.y(each.position[b]!), 2.5, 0, 2 * Math.PI);
            context.fill();
          }
          drew(points.length);
        }
      },
      over({ context, colour }: Pen, at) {
        const row = now(), seconds = row * job.cycle;
        context.lineJoin = "round";
        for (const body of wires) {
          const { points: wire, times } = body;
          context.strokeStyle = colour("--c4");
          context.lineWidth = Math.max(1.5, 2 * (body.radius ?? 0) * at.scale);
          context.beginPath();
          for (let k = 0; k < wire!.length && (!times || times[k]! <= seconds); ++k) {
            const px = at.x(wire![k]![a]!), py = at.y(wire![k]![b]!);
            k === 0 ? context.moveTo(px, py) : context.lineTo(px, py);
          }
          context.stroke();
        }
        if (!data.low.has("x")) return;
        const k = Math.max(0, lastAtMost(data.rows, row)), tip = turned([0, 0, 0], k);
        const back = needle && data.low.has("phi") ? turned(needle.points![0]!, k) : null;
        context.strokeStyle = context.fillStyle = colour("--c0");
        if (back) {
          context.lineCap = "round";
          context.lineWidth = Math.max(3, 2 * (needle!.radius ?? 0) * at.scale);
          line(context, at.x(back[a]!), at.y(back[b]!), at.x(tip[a]!), at.y(tip[b]!));
          context.lineCap = "butt";
        }
        context.beginPath();
        context.arc(at.x(tip[a]!), at.y(tip[b]!), 4, 0, 2 * Math.PI);
        context.fill();
      },
    });
    picture.redraw();
    return [picture, h("figure", { class: "plain" }, h("figcaption", {}, t(title)), picture.element)];
  };
  const views = [flat([0, 1], "from_above"), flat([1, 2], "from_front"), flat([0, 2], "from_side")];
  follow(job, views.map(([each]) => ({ redraw: () => each.move(), move: () => each.move() })));
  const box = h("div", { class: "side-by-side three" });
  append(box, ...views.map(([, element]) => element));
  const frame = scene && scene.frame !== "part" ? null : t("part_frame");
  return panel(t("flat_views"), legend({ colour: "--strong", name: t("part"), kind: "box" }, wires.length > 0 && { colour: "--c4", name: t("wire_so_far") }, { colour: "--c0", name: t("needle") }, { colour: "--rapid", name: t("needle_way") }), frame ? h("p", { class: "soft" }, frame) : null, box);
}

/** Returns a curve that has a value in each interval between bounds. */
export function stairs(bounds: number[], values: number[], name: string, colour: string): Curve {
  return { name, colour, x: values.flatMap((_, k) => [bounds[k]!, bounds[k + 1]!]), low: values.flatMap((each) => [each, each]) };
}

function overTime(data: Envelope, job: PlannedJob, details: Result["details"], axes: string[], summary: Result["summary"]): HTMLElement {
  const time = data.rows.map((row) => row * job.cycle), shared = followed(job, 0, job.cycle), charts: Chart[] = [];
  const add = (curve: Curve | null, label: string, yName: string, unit: string, height: number, rest: Partial<ConstructorParameters<typeof Chart>[0]> = {}): void => {
    if (curve) charts.push(new Chart({ label, height, xName: charts.length === 0 ? `${t("time")}, s` : "", yName, unit, curves: [curve], ...shared, ...rest }));
  };
  add(curveOf(data, "v", time, t("feed"), "--c0"), t("feed_chart"), `${t("feed")}, mm/s`, "mm/s", 150, { zero: true });
  const curve = details.clearance?.curve;
  if (curve)
    add(stairs(curve.times, curve.values, t("clearance"), "--c2"), t("clearance_chart"), `${t("clearance")}, mm (${t("at_most", { most: number(curve.most) })})`, "mm", 130, { zero: true, rules: summary.clearance !== null ? [{ value: summary.clearance, colour: "--c6" }] : [] });
  const wire = details.wire;
  add(curveOf(data, "brake", time, t("brake"), "--c3"), t("brake_chart"), `${t("brake")}, N`, "N", 110, wire ? { rules: [{ value: wire.force, colour: "--c6" }] } : {});
  const general = charts.length;
  for (const name of axes) {
    const axis = details.axes.find((each) => each.name === name)!;
    add(curveOf(data, name, time, name, "--c1"), t("axis_chart", { axis: name }), `${name}, ${axis.unit}`, axis.unit, 100);
  }
  follow(job, charts);
  for (const each of charts) each.redraw();
  const element = panel(t("winding_curves"), ...charts.slice(0, general).map((each) => each.element));
  const box = h("div");
  append(box, h("h4", {}, t("axes_heading", { first: axes[0] ?? "", last: axes[axes.length - 1] ?? "" })), ...charts.slice(general).map((each) => each.element));
  append(element, box);
  return element;
}

function axesTable(axes: Axis[]): HTMLElement {
  return panel(t("axes"), table(t("axes"), [t("axis"), "#" + t("lowest"), "#" + t("highest"), "#" + t("travel")], axes.map((each) => [each.name, `${number(each.lowest, 5)} ${each.unit}`, `${number(each.highest, 5)} ${each.unit}`, `${number(each.travel, 6)} ${each.unit}`])));
}
