/** The path of a plan, in the plane or in space, with its playback and its program. */
import { getColumns, getJson } from "../base/api";
import { append, fill, h } from "../base/dom";
import { duration, fixed, number } from "../base/numbers";
import type { Limit, PlannedJob } from "../base/planned_job";
import { limitColours } from "../base/limit_colours";
import { keepInAddress, readAddress } from "../base/view";
import { Delay, working } from "../base/work";
import type { ColourBy } from "./colours";
import { fillLegend } from "./legend";
import type { Mark } from "./layer";
import { placeAt, vertexBefore, type PathData } from "./path_data";
import { Picture } from "./picture";
import { Player } from "./player";
import { Program, toolsOf, type Page } from "./program";
import { ProgramList } from "./program_list";
import { Slices, valuesAt, type Slice } from "./slices";
import { PathSource } from "./source";
import type { SpaceCanvas } from "./space_canvas";
import { pathTable } from "./table";
import { t } from "./words";

const choices: ColourBy[] = ["speed", "limit", "use", "block", "tool"];
const restAfter = 150, addressAfter = 400, emphasisAfter = 120; // ms

/** Draws the path into the section of the page. A motion law has none. */
export function mountPath(section: HTMLElement, job: PlannedJob): void {
  if (!job.columns.includes("x") || !job.columns.includes("y")) {
    section.hidden = true;
    return;
  }
  new PathPanel(section, job);
}

class PathPanel {
  private readonly picture: Picture;
  private readonly player: Player;
  private readonly program: Program | null;
  private readonly list: ProgramList | null;
  private readonly slices: Slices;
  private readonly legend = h("p", { class: "path-legend" });
  private readonly readout = h("output", { class: "path-readout", for: "play-position" }, t("readout_none"));
  private readonly notice = h("p", { class: "error", role: "status", hidden: true });
  private readonly stage = h("span", { class: "path-choices" });
  private readonly moving: string[];
  private readonly values: Float64Array;
  private limits: readonly Limit[] = [];
  private toolNumbers: number[] = [];
  private space: Promise<SpaceCanvas | null> | null = null;
  private canvas: SpaceCanvas | null = null;
  private laid = false;
  private mine = -1; // row that this panel has told the others last
  private readonly rest = new Delay(restAfter);
  private skipped = 0; // looks at the playback without its line
  private readonly address = new Delay(addressAfter);
  private readonly emphasis = new Delay(emphasisAfter);

  constructor(section: HTMLElement, private readonly job: PlannedJob) {
    const lines = job.kind === "contour", state = readAddress();
    this.picture = new Picture(new PathSource(job.id, "tool", lines, job.seconds), job.rows, {
      hover: (row) => !this.player.clock.playing && job.view.point(row),
      pick: (row) => this.picked(row),
      moved: () => this.remember(),
      recoloured: () => this.showLegend(),
      failed: (error) => this.fail(error),
    });
    this.moving = ["x", "y", "z", "xc", "yc", "zc", "phi", "psi", "v"].filter((name) => job.columns.includes(name));
    this.values = new Float64Array(this.moving.length);
    this.slices = new Slices(job.rows, async (first, every, count, signal): Promise<Slice> => {
      const query = `first=${first}&every=${every}&count=${count}&columns=${this.moving.join(",")}&format=f32`;
      const { names, data: values } = await getColumns(`/v1/jobs/${job.id}/setpoints?${query}`, signal);
      return { first, every, count: Math.floor(values.length / names.length), values, names };
    });
    this.program = lines
      ? new Program(job.rows, job.cycle, (first, count, signal) => getJson<Page>(`/v1/jobs/${job.id}/blocks?by=segment&sort=start&first=${first}&count=${count}`, signal))
      : null;
    this.list = this.program && new ProgramList(this.program, (row) => this.go(row), (by) => this.step(by));
    if (this.program)
      this.program.changed = () => {
        const row = this.row();
        this.list!.show(row, true);
      };
    this.player = new Player(job.rows, job.cycle, lines, {
      line: (row) => this.program?.at(Math.floor(row)) ?? null,
      frame: (row, share) => this.frame(row, share),
      started: (playing) => this.started(playing),
      seek: (row) => this.go(Math.round(row)),
      step: (by) => this.step(by),
    });

    if (choices.includes(state.colour as ColourBy)) this.picture.by = state.colour as ColourBy;
    this.picture.shown.rapids = state.rapids !== "0";
    const tools = h(
      "div", { class: "path-tools" }, this.colourChoice(lines), lines && this.rapidChoice(), this.stage,
      h(
        "span", { class: "path-buttons" }, h("button", { type: "button", title: t("closer"), "aria-label": t("closer"), click: () => this.picture.scaleBy(1.5) }, "+"),
        h("button", { type: "button", title: t("farther"), "aria-label": t("farther"), click: () => this.picture.scaleBy(1 / 1.5) }, "−"),
        h("button", { type: "button", click: () => this.picture.fit() }, t("fit")),
      ),
    );
    const table = h("details", { class: "path-table" }, h("summary", {}, t("table")));
    table.addEventListener("toggle", () => table.open && this.picture.path && fill(table, h("summary", {}, t("table")), pathTable(this.picture.path, job.rows, job.cycle)));
    section.classList.add("path");
    if (!section.querySelector("h2")) append(section, h("h2", {}, t("path")));
    append(
      section, this.notice, tools,
      h("div", { class: "path-both" + (this.list ? " path-with-program" : "") }, h("div", { class: "path-left" }, this.picture.element, this.legend, this.player.element, this.readout), this.list?.element),
      table,
    );
    job.view.follow((view, changed) => {
      if (changed.has("first") || changed.has("count")) {
        Object.assign(this.picture.shown, { first: view.first, end: view.first + view.count });
        // The curves come first: a picture of the path may take longer than all of them.
        this.emphasis.start(() => this.picture.redraw());
      }
      if (changed.has("row") || changed.has("locked")) this.follow();
    });
    Object.assign(this.picture.shown, { first: job.view.get().first, end: job.view.get().first + job.view.get().count });
    // What a path in space needs is asked for together with it; it is hardly ever one in a plane.
    if (job.columns.includes("z") && state.view !== "plane") {
      this.picture.expectSpace(true);
      this.space = this.makeSpace();
    }
    void this.load(true);
  }

  private async load(first = false): Promise<void> {
    try {
      if (this.picture.by === "limit") await this.loadLimits();
      if (this.picture.by === "tool") await this.loadTools();
      const path = await this.picture.load();
      this.notice.hidden = true;
      this.showLegend();
      if (first) this.loaded(path);
    } catch (error) {
      this.fail(error);
    }
  }
  private loaded(path: PathData): void {
    const state = readAddress(), { high, low } = this.picture.reach;
    const place = (state.plane ?? "").split(",").map(Number);
    if (place.length === 3 && place.every(Number.isFinite) && place[2]! > 0) this.picture.showPlane(place[0]!, place[1]!, place[2]!);
    if (this.job.columns.includes("xc")) this.addCoarse();
    const deep = path.dimension === 3 && high[2] - low[2] > 1e-3;
    if (deep) this.addSpace(state.view !== "plane");
    else this.picture.expectSpace(false);
    this.follow();
    if (this.program) this.program.at(this.row() ?? 0);
  }
  private fail(error: unknown): void {
    const reason = error instanceof Error ? error.message : String(error);
    fill(this.notice, t("no_data", { reason }), " ", h("button", { type: "button", click: () => void this.load(!this.picture.path) }, t("again")));
    this.notice.hidden = false;
  }

  // Choices

  private colourChoice(lines: boolean): HTMLElement {
    const select = h("select", {
      id: "path-colour",
      change: () => {
        this.picture.by = select.value as ColourBy;
        keepInAddress({ colour: select.value === "speed" ? null : select.value });
        void this.load();
      },
    });
    for (const by of choices)
      if (lines || by === "speed" || by === "limit" || by === "use") select.append(h("option", { value: by, selected: by === this.picture.by }, t(`by_${by}`)));
    return h("label", {}, t("colour"), " ", select);
  }
  private rapidChoice(): HTMLElement {
    const box = h("input", {
      type: "checkbox", id: "path-rapids", checked: this.picture.shown.rapids,
      change: () => {
        this.picture.shown.rapids = box.checked;
        keepInAddress({ rapids: box.checked ? null : "0" });
        this.picture.redraw();
        this.showLegend();
      },
    });
    return h("label", {}, box, " ", t("rapids"));
  }
  private addCoarse(): void {
    let coarse: Promise<PathData> | null = null;
    const box = h("input", {
      type: "checkbox", id: "path-coarse",
      change: () => {
        if (!box.checked) return this.picture.setCoarse(null);
        coarse ??= new PathSource(this.job.id, "coarse", false, this.job.seconds).whole("speed");
        coarse.then((path) => box.checked && this.picture.setCoarse(path), (error) => this.fail(error));
      },
    });
    append(this.stage, h("label", {}, box, " ", t("coarse")));
    // The window of the fine axes about the coarse ones: the curves ask for the limits, too.
    this.job.limits().then(
      ({ limits }) => {
        const stroke = (axis: string): number => limits.find((limit) => limit.column === `${axis}f` && limit.name.startsWith("stroke"))?.value ?? 0;
        this.picture.stroke = [stroke("x"), stroke("y")];
      },
      () => {
        // The marks are drawn without it.
      },
    );
  }
  private addSpace(now: boolean): void {
    const radio = (value: "plane" | "space", text: string): HTMLElement => {
      const button = h("input", { type: "radio", name: "path-view", value, checked: now === (value === "space"), change: () => void this.chooseSpace(value === "space") });
      return h("label", {}, button, " ", text);
    };
    const bodies = h("input", { type: "checkbox", id: "path-bodies", checked: true, change: () => {
      this.canvas?.setBodiesShown(bodies.checked);
      this.picture.redraw();
    } });
    const laid = h("input", { type: "checkbox", id: "path-laid", change: () => {
      this.laid = laid.checked;
      this.marks(this.row());
      this.picture.redraw();
    } });
    append(
      this.stage, h("span", { role: "radiogroup", "aria-label": t("view") }, radio("space", t("space")), " ", radio("plane", t("flat"))),
      this.hasScene() && h("label", { class: "in-space" }, bodies, " ", t("bodies")), h("label", { class: "in-space" }, laid, " ", t("laid")),
    );
    if (now) void this.chooseSpace(true);
    else this.stage.classList.add("flat");
  }
  private hasScene(): boolean {
    return this.job.kind === "winding" || this.job.kind === "probe_path" || this.job.columns.includes("zc");
  }
  private async chooseSpace(space: boolean): Promise<void> {
    keepInAddress({ view: space ? null : "plane" });
    this.stage.classList.toggle("flat", !space);
    if (!space) {
      this.canvas = null;
      this.picture.setSpace(null);
      return;
    }
    this.space ??= this.makeSpace();
    const canvas = await this.space;
    if (!canvas) {
      this.picture.expectSpace(false);
      this.stage.classList.add("flat");
      fill(this.notice, t("no_webgl"));
      this.notice.classList.remove("error");
      this.notice.hidden = false;
      this.stage.hidden = true;
      return;
    }
    if (this.stage.classList.contains("flat")) return;
    this.canvas = canvas;
    this.picture.setSpace(canvas);
    this.marks(this.row());
  }
  private async makeSpace(): Promise<SpaceCanvas | null> {
    // A picture of path and bodies takes little more time than one of the path alone. Without bodies the path is drawn alone.
    const asked = this.hasScene() ? this.job.scene().catch(() => null) : null;
    try {
      const module = (await working(import(new URL("./space.js", import.meta.url).href))) as { makeSpace(): SpaceCanvas | null };
      const canvas = module.makeSpace(), scene = await asked;
      if (canvas && scene) {
        canvas.setScene(scene);
        if (scene.box) this.picture.setBodies({ low: scene.box[0], high: scene.box[1] });
      }
      return canvas;
    } catch {
      return null;
    }
  }
  private async loadLimits(): Promise<void> {
    if (this.limits.length > 0) return;
    this.limits = (await this.job.limits()).limits;
    this.picture.limitVariables = limitColours(this.limits);
  }
  private async loadTools(): Promise<void> {
    if (this.picture.tools) return;
    const document = await getJson<{ spec?: { contour?: { gcode?: string } } }>(`/v1/jobs/${this.job.id}/spec`);
    const program = document.spec?.contour?.gcode ?? "", tools = toolsOf(program);
    this.picture.tools = tools;
    this.toolNumbers = [...new Set(program.split(/\r\n|\n|\r/).map((_, i) => tools(i + 1)))].sort((a, b) => a - b);
  }
  private showLegend(): void {
    fillLegend(this.legend, {
      by: this.picture.by, scheme: this.picture.legendColours(), speeds: this.picture.speeds, hasModes: this.program !== null, rapids: this.picture.shown.rapids,
      limits: this.limits, limitVariables: this.picture.limitVariables, tools: this.toolNumbers,
    });
  }

  // Cursor and playback

  private row(): number | null {
    return this.player.clock.playing ? Math.floor(this.player.clock.row) : this.job.view.get().row;
  }
  private picked(row: number | null): void {
    this.player.stop();
    if (row === null) this.job.view.set({ locked: false });
    else this.job.view.set({ row, locked: true });
  }
  /** Keeps the cursor at a row, and shows it. */
  private go(row: number): void {
    if (this.player.clock.playing) {
      this.player.clock.seek(row);
      return;
    }
    this.job.view.set({ row, locked: true });
    const place = this.picture.path && placeAt(this.picture.path, row);
    if (place) this.picture.reveal(place);
  }
  private step(by: 1 | -1): void {
    const { program } = this;
    if (!program) return;
    this.player.stop();
    const row = this.job.view.get().row ?? 0, index = program.find(row);
    program.at(row);
    if (index < 0) return;
    // Back goes to the begin of the line first.
    const next = by < 0 && row > program.visits[index]!.first ? index : index + by;
    const visit = program.visits[next];
    if (visit) this.go(Math.min(visit.first, this.job.rows - 1));
  }
  private started(playing: boolean): void {
    if (!playing) return;
    const { row, locked } = this.job.view.get();
    if (row !== null && (locked || this.player.clock.row === 0) && row < this.job.rows - 1) this.player.clock.seek(row);
  }
  private frame(row: number, share: boolean): void {
    this.marks(row);
    if (!share) return;
    this.mine = Math.round(row);
    this.job.view.set({ row: this.mine, locked: true });
    this.read(row);
    // A list that is built anew at every look would cost more than the rest of the frame.
    if (!this.program || (this.program.find(Math.floor(row)) < 0 && ++this.skipped % 4 !== 0)) return;
    this.program.at(Math.floor(row));
    this.list!.show(Math.floor(row), true);
  }
  /** Shows the cursor that the panels share. */
  private follow(): void {
    const { row, locked } = this.job.view.get();
    if (this.player.clock.playing) {
      if (row !== null && row !== this.mine) this.player.clock.seek(row);
      return;
    }
    if (row !== null) this.player.follow(row);
    this.marks(row);
    this.read(row);
    // A cursor that hovers costs no request.
    if (row !== null && locked) this.program?.at(row);
    this.list?.show(row, locked);
    if (row !== null && locked) this.rest.start(() => void this.exact(row));
    else this.rest.cancel();
  }
  /** Asks for the rows around a cursor that rests: their places are exact, and stepping on costs nothing. */
  private async exact(row: number): Promise<void> {
    if (!this.slices.peek(row)) await this.slices.around(row);
    if (this.job.view.get().row !== row || this.player.clock.playing) return;
    this.marks(row);
    this.read(row);
  }
  private value(name: string): number | undefined {
    const k = this.moving.indexOf(name);
    return k < 0 ? undefined : this.values[k];
  }
  /** Draws what moves at a row. */
  private marks(row: number | null): void {
    const { path } = this.picture;
    if (row === null || !path) {
      this.tool(null, null);
      this.picture.setMarks([], false);
      return;
    }
    const playing = this.player.clock.playing, rate = this.player.clock.by === "line" ? 1 / this.job.cycle : this.player.clock.rate;
    const slice = playing ? this.slices.at(row, rate) : this.slices.peek(row);
    const marks: Mark[] = [];
    let place: [number, number, number] | null = null, coarse: [number, number, number] | null = null;
    if (slice && valuesAt(slice, row, this.values)) {
      const [x, y, z] = ["x", "y", "z"].map((name) => this.value(name) ?? 0);
      place = [x!, y!, z!];
      const xc = this.value("xc"), yc = this.value("yc");
      if (xc !== undefined && yc !== undefined) marks.push({ place: (coarse = [xc, yc, this.value("zc") ?? z!]), shape: "coarse" });
    } else {
      this.values.fill(NaN);
      place = placeAt(path, row);
    }
    if (place) marks.push({ place, shape: "tool" });
    this.tool(place, row, coarse);
    this.picture.setMarks(marks, this.job.view.get().locked);
  }
  private tool(place: [number, number, number] | null, row: number | null, coarse: [number, number, number] | null = null): void {
    if (!this.canvas) return;
    const phi = this.value("phi"), psi = this.value("psi");
    const turned = phi !== undefined && Number.isFinite(phi);
    const changes = this.canvas.setTool(place && row !== null ? { place, coarse, phi: turned ? phi : NaN, psi: turned ? psi! : NaN, row, time: row * this.job.cycle } : null, this.laid);
    if (changes) this.picture.showSpace(this.player.clock.playing);
  }
  private read(row: number | null): void {
    const { path } = this.picture;
    if (row === null || !path) {
      this.readout.textContent = t("readout_none");
      return;
    }
    const whole = Math.round(row), i = vertexBefore(path, whole), exact = Number.isFinite(this.values[0]!);
    const place = exact ? (["x", "y", "z"].map((name) => this.value(name) ?? 0) as [number, number, number]) : placeAt(path, whole);
    const digits = exact ? 3 : Math.max(0, Math.min(3, Math.ceil(-Math.log10(path.tolerance))));
    const parts = [`t ${duration(whole * this.job.cycle)}`];
    if (place) ["x", "y", "z"].slice(0, path.dimension).forEach((name, k) => parts.push(`${name} ${fixed(place[k]!, digits)}`));
    const v = exact ? this.value("v") : path.columns.v?.[i];
    if (v !== undefined) parts.push(`v ${number(v, 4)} mm/s`);
    const visit = this.program && this.program.find(whole);
    const { number: line, text } = visit !== null && visit >= 0 ? this.program!.visits[visit]! : { number: path.columns.line?.[i], text: this.program?.visits[0]?.text };
    if (line !== undefined) parts.push(t(text === null ? "segment" : "line", { n: line }));
    parts.push(t("of_rows", { row: whole, rows: this.job.rows }));
    this.readout.textContent = parts.join(" · ");
  }
  private remember(): void {
    this.address.start(() => {
      if (this.picture.inSpace) return;
      const { x, y, scale } = this.picture.plane;
      keepInAddress({ plane: this.picture.isFit() ? null : [x.toFixed(3), y.toFixed(3), scale.toPrecision(5)].join(",") });
    });
  }
}
