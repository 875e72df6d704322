/** The page of two jobs: which ones, their figures, their curves with one cursor, and where along the path time is won or lost. */
import { lastAtMost } from "../base/search";
import de from "../texts/de/compare.json";
import en from "../texts/en/compare.json";
import { Refused, at, getJson } from "../base/api";
import { append, fill, h } from "../base/dom";
import { duration, fixed, number, percent } from "../base/numbers";
import { onKey } from "../base/page";
import { texts } from "../base/texts";
import { keepInAddress, readAddress } from "../base/view";
import { Chart, type Curve } from "../kinds/chart";
import { type Envelope, curveOf, envelope, folded, legend, panel, table } from "../kinds/parts";
import { type Along, alongPath, difference, integrated, places, sameLength, timeAt } from "./along";
import { type Figure, type Figures, compareFigures, unitOf } from "./figures";

const t = texts(en, de);

interface Job {
  id: string;
  kind: string;
  name: string | null;
  reference: string | null;
  state: string;
  created_at: string;
}
interface Column {
  name: string;
  unit: string;
}
interface Setpoints {
  count: number;
  duration: number;
  cycle_time: number;
  columns: Column[];
  independent?: { name: string; unit: string; step: number };
}
interface Side {
  job: Job;
  result: (Figures & { setpoints?: Setpoints & Record<string, unknown>; verification?: { passed?: boolean } }) | null;
}

const nameOf = (job: Job): string => job.name || job.reference || job.id;
const signed = (text: string, value: number): string => (value > 0 ? "+" : value < 0 ? "−" : "±") + text;

/** Returns the name of a figure in the page's language, its words with blanks where the table has none. */
function figureName({ name, axis }: Figure): string {
  const key = `figure_${name}`;
  return (key in en ? t(key as keyof typeof en) : name.replace(/_/g, " ")) + (axis ? " " + axis.replace(/_/g, " ") : "");
}

export async function mountCompare(section: HTMLElement): Promise<void> {
  const query = new URLSearchParams(location.search), ids = [query.get("a") ?? "", query.get("b") ?? ""];
  const form = h("form", { class: "panel choose", method: "get", action: at("/compare") }), answer = h("div");
  section.append(form, answer);
  let list: Job[] = [];
  try {
    list = (await getJson<{ jobs: Job[] }>("/v1/jobs?state=succeeded&limit=50")).jobs;
  } catch {
    // Jobs can still be named by their ids.
  }
  choose(form, list, ids);
  if (!ids[0] || !ids[1]) {
    append(answer, h("p", {}, t(list.length < 2 ? "too_few" : "choose_two")));
    return;
  }
  const sides: Side[] = [];
  for (const [k, id] of ids.entries()) {
    try {
      const job = await getJson<Job>(`/v1/jobs/${encodeURIComponent(id)}`);
      let result: Side["result"] = null;
      if (job.state === "succeeded" || job.state === "failed")
        result = await getJson<NonNullable<Side["result"]>>(`/v1/jobs/${job.id}/result?parts=summary,bound,setpoints,verification.passed`).catch((error: unknown) => {
          if (error instanceof Refused) return null;
          throw error;
        });
      sides.push({ job, result });
    } catch (error) {
      append(answer, h("p", { class: "error" }, `${"AB"[k]}: `, error instanceof Refused && error.status === 404 ? t("no_such_job", { id }) : error instanceof Refused ? error.message : t("lost")));
      return;
    }
  }
  await show(answer, sides[0]!, sides[1]!);
}

/** Writes the form: the last jobs to choose from, or an id. */
function choose(form: HTMLElement, list: Job[], ids: string[]): void {
  const field = (k: number): HTMLElement => {
    const letter = "ab"[k]!, own = ids[k]!;
    const input = h("input", { name: letter, value: own, required: true, maxlength: 64, spellcheck: "false", autocomplete: "off", "aria-label": t("id_of", { letter: letter.toUpperCase() }), placeholder: t("id") });
    const select = h("select", { "aria-label": t("job_of", { letter: letter.toUpperCase() }), change: () => {
      if (select.value) input.value = select.value;
    } }, h("option", { value: "" }, t("last_jobs")), ...list.map((job) => h("option", { value: job.id, selected: job.id === own }, `${nameOf(job).slice(0, 80)} · ${job.kind}`)));
    input.addEventListener("input", () => {
      select.value = list.some((job) => job.id === input.value.trim()) ? input.value.trim() : "";
    });
    return h("fieldset", { class: `side ${letter}` }, h("legend", {}, letter.toUpperCase()), select, input);
  };
  const swap = h("button", { type: "button", click: () => {
    location.search = new URLSearchParams({ a: ids[1]!, b: ids[0]! }).toString();
  } }, t("swap"));
  append(form, h("div", { class: "sides" }, field(0), field(1)), h("p", { class: "controls" }, h("button", { class: "primary" }, t("compare")), ids[0] && ids[1] ? swap : null));
}

async function show(answer: HTMLElement, a: Side, b: Side): Promise<void> {
  const card = (side: Side, letter: string): HTMLElement => {
    const seconds = mainDuration(side), passed = side.result?.verification?.passed;
    return h("div", { class: `panel side ${letter.toLowerCase()}` }, h("p", { class: "letter", "aria-hidden": "true" }, letter),
      h("div", {}, h("a", { href: at(`/jobs/${side.job.id}`) }, h("bdi", {}, nameOf(side.job))),
        h("p", { class: "soft" }, `${side.job.kind} · `, passed === undefined ? side.job.state : t(passed ? "verified" : "not_verified")), seconds !== null ? h("p", { class: "lasts" }, duration(seconds)) : null));
  };
  append(answer, h("p", { class: "lead", "data-verdict": true }, headline(a, b)), h("div", { class: "sides" }, card(a, "A"), card(b, "B")));
  if (a.job.kind !== b.job.kind) append(answer, h("p", { class: "remark" }, t("kinds_differ", { a: a.job.kind, b: b.job.kind })));
  for (const [side, letter] of [[a, "A"], [b, "B"]] as const) if (!side.result) append(answer, h("p", { class: "remark" }, t("no_result", { letter, state: side.job.state })));
  const curves = h("div");
  append(answer, curves);
  if (a.result && b.result) append(answer, await figuresPanel(a, b));
  if (a.job.kind === b.job.kind && a.result?.setpoints && b.result?.setpoints) await curvesPanel(curves, a, b, a.result.setpoints, b.result.setpoints);
}

/** The planned duration of a side, s; of a law that of its cycle. */
function mainDuration({ result }: Side): number | null {
  const summary = result?.summary ?? {}, value = summary.duration ?? summary.cycle_duration;
  return typeof value === "number" ? value : null;
}

/** One sentence: which of both is better, and by how much. */
function headline(a: Side, b: Side): string {
  if (!a.result || !b.result) return t("nothing_to_compare");
  if (a.job.kind !== b.job.kind) return t("kinds_differ_short");
  const one = mainDuration(a), other = mainDuration(b);
  if (a.job.kind === "fill_factor") {
    const [n, m] = [a.result.summary?.count, b.result.summary?.count] as [number, number];
    return n === m ? t("same_wires", { n }) : t(m > n ? "more_wires" : "fewer_wires", { n: Math.abs(m - n) });
  }
  if (one === null || other === null) return t("nothing_to_compare");
  // Below a microsecond it is rounding.
  if (Math.abs(other - one) < 1e-6) {
    const [j, k] = [a.result.summary?.objective, b.result.summary?.objective];
    if (typeof j === "number" && typeof k === "number" && j > 0 && Math.abs(k / j - 1) > 1e-6) return t(k < j ? "smaller_objective" : "larger_objective", { share: percent(Math.abs(k / j - 1)) });
    return t("same_duration", { time: duration(one) });
  }
  const values = { time: duration(Math.abs(other - one)), share: percent(Math.abs(other / one - 1)) };
  return t(other < one ? "b_faster" : "b_slower", values);
}

async function figuresPanel(a: Side, b: Side): Promise<HTMLElement> {
  const same = a.job.kind === b.job.kind, list = compareFigures(["summary", "bound"], a.result!, b.result!).filter((each) => each.name !== "basis" && (same || (each.a !== null && each.b !== null)));
  const unit = await getJson<Parameters<typeof unitOf>[0]>(`/v1/schemas/${a.job.kind}.result`).then((schema) => (each: Figure) => unitOf(schema, each.path.split(".")), () => () => "");
  const value = (each: unknown): string => (typeof each === "number" ? number(each) : typeof each === "boolean" ? t(each ? "yes" : "no") : each === null ? "–" : String(each).replace(/_/g, " "));
  const row = (each: Figure): (string | Node)[] => {
    const equal = each.difference !== null && Math.abs(each.difference) <= 1e-9 * Math.max(Math.abs(Number(each.a)), Math.abs(Number(each.b)));
    return [(each.part === "bound" ? t("bound") + ": " : "") + figureName(each), value(each.a), value(each.b), each.difference === null ? (each.a === each.b ? "=" : "≠") : equal ? "=" : signed(number(Math.abs(each.difference), 4), each.difference),
      each.share === null || equal ? "" : signed(percent(Math.abs(each.share)), each.share), unit(each)];
  };
  return panel(t("figures"), table(t("figures"), [t("figure"), "#A", "#B", "#B − A", "#%", t("unit")], list.map(row)));
}

/** One motion, as the page draws it. */
interface Motion {
  id: string;
  cycle: number; // s per row
  lastRow: number;
  step: number; // step of the independent variable per row
  data: Envelope; // columns so far
  along: Along | null;
}

const points = 2000;

async function load(side: Side, setpoints: Setpoints, columns: string[]): Promise<Motion> {
  const names = setpoints.columns.map((each) => each.name), way = names.includes("s") && side.job.kind !== "motion_law" ? "s" : names.includes("v") && side.job.kind !== "motion_law" ? "v" : null;
  const wanted = [...new Set([...(way ? [way] : []), ...columns])];
  const data = await envelope(side.job.id, wanted, points), cycle = setpoints.cycle_time, lastRow = setpoints.count - 1;
  let along: Along | null = null;
  if (way === "s") along = alongPath(data.rows, cycle, data.low.get("s")!, { row: lastRow, s: data.high.get("s")!.at(-1) ?? 0 });
  if (way === "v") {
    const { s, end } = integrated(data.rows, cycle, data.low.get("v")!, data.high.get("v")!, lastRow);
    along = alongPath(data.rows, cycle, s, { row: lastRow, s: end });
  }
  return { id: side.job.id, cycle, lastRow, step: setpoints.independent?.step ?? cycle, data, along };
}

async function curvesPanel(box: HTMLElement, a: Side, b: Side, left: Setpoints, right: Setpoints): Promise<void> {
  const state = readAddress(), common = left.columns.filter((each) => right.columns.some((other) => other.name === each.name && other.unit === each.unit));
  const firstColumn = common.find((each) => each.name === "v")?.name ?? common[0]?.name;
  if (!firstColumn) return;
  const second = common.find((each) => /^(ax|a|aq1|q1)$/.test(each.name))?.name ?? firstColumn;
  const wanted = [firstColumn, common.some((each) => each.name === state.column) ? state.column! : second];
  const motions = await Promise.all([load(a, left, wanted), load(b, right, wanted)]) as [Motion, Motion];
  const [one, other] = motions, paths = one.along !== null && other.along !== null && one.along.length > 0 && other.along.length > 0;
  const law = left.independent, equal = paths && sameLength(one.along!, other.along!);

  let over: "path" | "time" = paths && state.over !== "time" ? "path" : "time";
  // Over the path the axis is the share of each one's way, in mm of a where both are equally long.
  const scale = (): number => (over === "path" ? (equal ? one.along!.length : 100) : 1);
  const whole = (): { from: number; to: number } => over === "path" ? { from: 0, to: scale() } : { from: 0, to: Math.max(...motions.map((each) => each.lastRow * each.step)) };
  let range = whole(), cursor: number | null = state.at === undefined ? null : Number(state.at);
  if (state.from !== undefined && state.to !== undefined && Number(state.to) > Number(state.from)) range = { from: Number(state.from), to: Number(state.to) };
  const keep = (): void => {
    const { from, to } = whole(), shown = (value: number): string => String(Number(value.toPrecision(7)));
    keepInAddress({ over: over === "time" && paths ? "time" : null, column: wanted[1] === second ? null : wanted[1]!, at: cursor === null ? null : shown(cursor),
      from: range.from === from && range.to === to ? null : shown(range.from), to: range.from === from && range.to === to ? null : shown(range.to) });
  };
  const xOf = (motion: Motion): Float64Array => motion.data.rows.map((_, k) => over === "path" ? ((motion.along!.way[k]! - motion.along!.way[0]!) / motion.along!.length) * scale() : motion.data.rows[k]! * motion.step);
  const rowAt = (motion: Motion, x: number): number => Math.round(Math.min(motion.lastRow, Math.max(0, over === "path" ? timeAt(motion.along!, motion.along!.way[0]! + (x / scale()) * motion.along!.length) / motion.cycle : x / motion.step)));
  const xName = (): string => over === "path" ? (equal ? `${t("path_length")}, mm` : `${t("path_share")}, %`) : law ? `${t("master")}, ${law.unit}` : `${t("time")}, s`;
  const unitOfColumn = (name: string): string => common.find((each) => each.name === name)?.unit ?? "";

  const readout = h("p", { class: "told", role: "status" }), links = h("p", { class: "controls" }), charts: Chart[] = [], chartBox = h("div");
  const gains = paths ? difference(one.along!, other.along!, 1000) : null;
  const moved = (): void => {
    for (const each of charts) each.move();
    fill(links);
    if (cursor === null) {
      readout.textContent = t("cursor_hint");
      return;
    }
    const x = cursor, shown = number(x, 5) + " " + (over === "path" ? (equal ? "mm" : "%") : law ? law.unit : "s");
    if (over === "path") {
      const [first, last] = motions.map((each) => timeAt(each.along!, each.along!.way[0]! + (x / scale()) * each.along!.length)) as [number, number];
      readout.textContent = t("cursor_path", { place: shown, a: fixed(first, 4), b: fixed(last, 4), delta: signed(fixed(Math.abs(last - first), 4), last - first) });
    } else readout.textContent = t("cursor_time", { place: shown });
    motions.forEach((each, k) => append(links, h("a", { href: at(`/jobs/${each.id}#row=${rowAt(each, x)}&locked=1`) }, t("open_there", { letter: "AB"[k]! }))));
  };
  const point = (x: number | null): void => {
    if (x === null) return; // The cursor stays where the pointer left, for reading and for keys.
    cursor = x;
    moved();
  };
  const build = (): void => {
    charts.length = 0;
    const shared = { x: () => range, cursor: () => cursor, point, pick: (x: number) => {
      point(x);
      keep();
    } };
    const pair = (column: string): Curve[] => motions.flatMap((each, k) => {
      const curve = curveOf(each.data, column, xOf(each), "AB"[k]!, k === 0 ? "--c0" : "--c1");
      // A is wider, so that it is seen below B where both are the same.
      return curve ? [{ ...curve, width: k === 0 ? 3.4 : 1.4 }] : [];
    });
    if (gains && over === "path")
      charts.push(new Chart({ label: t("gain_chart"), height: 170, xName: xName(), yName: t("gain_axis"), unit: "s", curves: [{ name: "Δt", colour: "--c2", x: gains.share.map((each) => each * scale()), low: gains.delta }], zero: true, ...shared }));
    [...new Set(wanted)].forEach((column, k) => charts.push(new Chart({ label: t("column_chart", { column }), height: 190, xName: k === 0 && over === "time" ? xName() : "", yName: `${column}, ${unitOfColumn(column)}`, unit: unitOfColumn(column), angle: over === "time" && law?.unit === "deg", curves: pair(column), ...shared })));
    fill(chartBox, ...charts.map((each) => each.element));
    for (const each of charts) {
      each.element.addEventListener("wheel", (event) => {
        if (!event.ctrlKey && !event.shiftKey) return;
        event.preventDefault();
        zoom(event.deltaY > 0 ? 1.25 : 0.8);
      }, { passive: false });
      each.redraw();
    }
    moved();
  };
  const show = (next: { from: number; to: number }): void => {
    const { from, to } = whole(), width = Math.min(to - from, Math.max((to - from) * 1e-4, next.to - next.from));
    const begin = Math.min(Math.max(from, next.from), to - width);
    range = width >= (to - from) * 0.9999 ? { from, to } : { from: begin, to: begin + width };
    for (const each of charts) each.redraw();
    keep();
  };
  const zoom = (factor: number): void => {
    const middle = cursor !== null && cursor >= range.from && cursor <= range.to ? cursor : (range.from + range.to) / 2;
    show({ from: middle - (middle - range.from) * factor, to: middle + (range.to - middle) * factor });
  };
  const step = (share: number): void => {
    const width = range.to - range.from, { from, to } = whole();
    cursor = Math.min(to, Math.max(from, (cursor ?? (range.from + range.to) / 2) + share * width));
    if (cursor < range.from) show({ from: cursor, to: cursor + width });
    if (cursor > range.to) show({ from: cursor - width, to: cursor });
    moved();
    keep();
  };
  onKey("ArrowLeft", t("key_left"), (event) => step(event.shiftKey ? -0.05 : -0.005));
  onKey("ArrowRight", t("key_right"), (event) => step(event.shiftKey ? 0.05 : 0.005));
  onKey("+", t("zoom_in"), () => zoom(0.5));
  onKey("-", t("zoom_out"), () => zoom(2));
  onKey("Home", t("zoom_all"), () => show(whole()));

  const select = h("select", { change: async () => {
    wanted[1] = select.value;
    await Promise.all(motions.map(async (motion) => {
      if (motion.data.low.has(select.value)) return;
      const more = await envelope(motion.id, [select.value], points);
      motion.data.low.set(select.value, more.low.get(select.value)!);
      motion.data.high.set(select.value, more.high.get(select.value)!);
    }));
    build();
    keep();
  } }, ...common.map((each) => h("option", { value: each.name, selected: each.name === wanted[1] }, `${each.name}, ${each.unit}`)));
  const axis = h("select", { change: () => {
    // The cursor stays at the same row of a.
    const row = cursor === null ? null : rowAt(one, cursor);
    over = axis.value as "path" | "time";
    cursor = row === null ? null : over === "path" ? xOf(one)[Math.max(0, lastAtMost(one.data.rows, row))]! : row * one.step;
    range = whole();
    build();
    keep();
  } }, h("option", { value: "path", selected: over === "path" }, t(equal ? "over_path" : "over_share")), h("option", { value: "time", selected: over === "time" }, t("over_time")));
  const button = (text: string, act: () => void): HTMLElement => h("button", { type: "button", click: act }, text);
  append(box, panel(t("curves"), paths && !equal ? h("p", { class: "remark" }, t("lengths_differ", { a: fixed(one.along!.length, 2), b: fixed(other.along!.length, 2) })) : null,
    h("div", { class: "controls" }, paths ? h("label", { class: "choice" }, t("over") + " ", axis) : null, h("label", { class: "choice" }, t("second_curve") + " ", select), button(t("zoom_in"), () => zoom(0.5)), button(t("zoom_out"), () => zoom(2)), button(t("zoom_all"), () => show(whole()))),
    legend({ colour: "--c0", name: "A" }, { colour: "--c1", name: "B" }, gains !== null && { colour: "--c2", name: t("gain_legend") }), chartBox, readout, links));
  if (gains) append(box, placesPanel());
  build();

  function placesPanel(): HTMLElement {
    const list = places(gains!, 12), unit = equal ? "mm" : "%", in_ = equal ? one.along!.length : 100;
    if (list.length === 0) return panel(t("places"), h("p", {}, t("no_places")));
    const won = list.reduce((sum, each) => sum + Math.min(0, each.gain), 0), lost = list.reduce((sum, each) => sum + Math.max(0, each.gain), 0);
    const times = (each: { from: number; to: number }): [string, string] => motions.map((motion) => {
      const { way, length } = motion.along!;
      const seconds = timeAt(motion.along!, way[0]! + each.to * length) - timeAt(motion.along!, way[0]! + each.from * length);
      return fixed(seconds, 4);
    }) as [string, string];
    return panel(t("places"), h("p", {}, t("places_sentence", { won: fixed(-won, 3), lost: fixed(lost, 3) })),
      table(t("places"), [`${t("stretch")}, ${unit}`, "#A, s", "#B, s", "#B − A, s", t("winner")], list.map((each) => [
        h("button", { type: "button", class: "plain", click: () => {
          over = "path";
          axis.value = "path";
          cursor = ((each.from + each.to) / 2) * scale();
          const room = 0.5 * (each.to - each.from);
          range = whole();
          build();
          show({ from: (each.from - room) * scale(), to: (each.to + room) * scale() });
          chartBox.scrollIntoView({ block: "nearest" });
        } }, `${number(each.from * in_, 4)} … ${number(each.to * in_, 4)}`), ...times(each), signed(fixed(Math.abs(each.gain), 4), each.gain), each.gain < 0 ? "B" : "A",
      ])), folded(t("gain_table"), () => table(t("gain_chart"), [`#${t("path_length")}, ${unit}`, "#Δt, s"], Array.from({ length: 51 }, (_, k) => [number(gains!.share[20 * k]! * in_, 5), number(gains!.delta[20 * k]!, 4)]))));
  }
}
