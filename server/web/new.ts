/** "Try it": a job from a file, an example, another job or a form; checked while it is written, drawn before it is posted. */
import de from "./texts/de/form.json";
import en from "./texts/en/form.json";
import { Refused, at, getJson, postJson } from "./base/api";
import { append, byId, fill, h } from "./base/dom";
import { duration, number } from "./base/numbers";
import { onKey, startPage } from "./base/page";
import { texts } from "./base/texts";
import { Delay, working } from "./base/work";
import { loadDescriptions } from "./forms/descriptions";
import { decode, recognise, type ReadText } from "./forms/files";
import { takeFile } from "./forms/handover";
import { formOf, jobForm, valueOf, type ObjectNode } from "./forms/model";
import { OutlineView, type Outline } from "./forms/outline";
import { drawForm, fieldAt, focusField, labelOf, selectLine, showFaults, type Fault } from "./forms/render";
import type { JsonObject, Schema } from "./forms/schema";
import { kindName } from "./jobs/row";

const t = texts(en, de);

interface Listed {
  name: string;
  kind: string;
  title?: string;
  type?: string;
  own?: boolean;
}
interface Preview {
  kind: string;
  checked: boolean;
  notes: string[];
  estimate: { duration?: number; path_length?: number; setpoints?: number; cut_time?: number } | null;
  outline: Outline | null;
}

const checkDelay = 400; // ms after the last change

/** Returns a key that no other form has. */
function newKey(): string {
  return [...crypto.getRandomValues(new Uint8Array(16))].map((byte) => byte.toString(16).padStart(2, "0")).join("");
}

async function start(section: HTMLElement): Promise<void> {
  const parameters = new URLSearchParams(location.search);
  const [envelope, kinds, examples, machines] = await Promise.all([
    getJson<Schema>("/v1/schemas/job"), getJson<{ kinds: { kind?: string; name?: string; title?: string }[] }>("/v1/kinds"),
    getJson<{ examples: Listed[] }>("/v1/examples"), getJson<{ machines: Listed[] }>("/v1/machines"),
    loadDescriptions(),
  ]);
  const kindNames = kinds.kinds.map((each) => (each.kind ?? each.name)!);
  const schemas = new Map<string, Promise<Schema>>();
  const schemaOf = (kind: string): Promise<Schema> => {
    if (!schemas.has(kind)) schemas.set(kind, getJson<Schema>(`/v1/schemas/${kind}`));
    return schemas.get(kind)!;
  };

  // The page.
  const note = h("p", { class: "notice", role: "status", hidden: true });
  const tell = (text: string, bad = false): void => {
    note.hidden = text === "";
    note.textContent = text;
    note.classList.toggle("bad", bad);
  };
  const file = h("input", { type: "file", id: "file", class: "visually-hidden", tabindex: -1, "aria-label": t("choose_file"), change: () => {
    if (file.files?.[0]) void takeBytes(file.files[0].name, file.files[0]);
    file.value = "";
  } });
  const example = h("select", { id: "example", change: () => example.value && void fromExample(example.value) });
  example.append(h("option", { value: "" }, t("choose_example")));
  for (const kind of kindNames)
    example.append(append1(h("optgroup", { label: kindName(kind) }), examples.examples.filter((each) => each.kind === kind).map((each) => h("option", { value: each.name }, each.title ? `${each.title} (${each.name})` : each.name))));
  const kind = h("select", { id: "kind", change: () => {
    const first = examples.examples.find((each) => each.kind === kind.value);
    if (first) void fromExample(first.name);
  } }, ...kindNames.map((each) => h("option", { value: each }, kindName(each))));
  const machine = h("select", { id: "machine", change: () => void takeMachine() });
  const machineField = h("p", { class: "field" }, h("label", { for: "machine" }, t("machine")), machine);
  const formPlace = h("div", { id: "form" }), verdict = h("div", { id: "verdict", role: "status" });
  const post = h("button", { type: "submit", class: "primary big" }, t("plan"));
  const outline = new OutlineView((segments) => t("outline", { n: segments }));
  const documentText = h("pre", { class: "document", tabindex: 0, "aria-label": t("document") });
  const documentView = h("details", { toggle: () => documentView.open && showDocument() }, h("summary", {}, t("document")), documentText);
  const form = h("form", { class: "try", autocomplete: "off", novalidate: true, submit: (event: Event) => {
    event.preventDefault();
    void submit();
  } },
    h("div", { class: "main" }, h("div", { class: "fields head" }, h("p", { class: "field" }, h("label", { for: "kind" }, t("kind")), kind), machineField), formPlace),
    h("aside", {}, h("div", { class: "panel sticky" }, outline.canvas, verdict, h("p", {}, post), documentView)));
  const drop = h("div", { class: "drop small" },
    h("p", {}, t("drop"), " ", h("button", { type: "button", click: () => file.click() }, t("choose_file")), file),
    h("p", {}, h("label", { for: "example" }, t("or_example")), " ", example));
  fill(section, drop, note, form);

  const checking = new Delay(checkDelay);
  let node: ObjectNode | null = null, current = "", key = newKey(), posted = "", aborter: AbortController | null = null, faults: Fault[] = [];

  const documentOf = (): JsonObject => valueOf(node!) as JsonObject;
  const showDocument = (): void => {
    const text = JSON.stringify(documentOf(), null, 1);
    documentText.textContent = text.length > 50_000 ? text.slice(0, 50_000) + "\n…" : text;
  };

  /** Shows a document in its form. */
  async function show(document: JsonObject): Promise<void> {
    const name = String(document.kind);
    if (!kindNames.includes(name)) return tell(t("unknown_kind", { kind: name }), true);
    const schema = await schemaOf(name);
    current = name;
    kind.value = name;
    node = jobForm(envelope, schema, document);
    const choices = machines.machines.filter((each) => each.kind === name);
    machineField.hidden = choices.length === 0;
    fill(machine, h("option", { value: "" }, t("as_below")), ...choices.map((each) => h("option", { value: each.name }, each.name + (each.type ? ` (${labelOf(each.type)})` : "") + (each.own ? ` – ${t("own")}` : ""))));
    draw();
    changed();
    const pointer = decodeURIComponent(location.hash.slice(1));
    if (pointer.startsWith("/")) {
      const found = fieldAt(formPlace, pointer);
      if (found) focusField(found);
    }
  }

  /** The envelope's rarely used members stand below the spec. */
  function draw(): void {
    if (!node) return;
    const members = node.members, spec = members.get("spec")!;
    const rest: ObjectNode = { ...node, members: new Map([...members].filter(([name]) => name !== "spec" && name !== "kind" && name !== "name" && name !== "reference")) };
    const head: ObjectNode = { ...node, extra: {}, members: new Map([...members].filter(([name]) => name === "name" || name === "reference")), schema: { ...node.schema, required: ["name", "reference"] } };
    const top = h("div", { class: "fields head" }), main = h("div", { class: "fields" }), handling = h("div", { class: "fields" });
    drawForm(top, head, "", { changed });
    drawForm(main, spec, "/spec", { changed });
    // Members are added to the part that is drawn, and belong to the whole.
    const follow = (): void => {
      for (const [name, member] of rest.members) members.set(name, member);
      node!.extra = rest.extra;
      changed();
    };
    drawForm(handling, rest, "", { changed: follow });
    fill(formPlace, top, main, h("h2", {}, t("handling")), handling);
  }

  function changed(): void {
    aborter?.abort();
    checking.start(() => void check());
    if (documentView.open) showDocument();
  }

  function showFaultList(title: string): void {
    const entry = (fault: Fault): HTMLElement => h("li", {}, h("button", { type: "button", class: "link", click: () => {
      const found = fieldAt(formPlace, fault.pointer);
      if (!found) return;
      focusField(found);
      const area = found.querySelector<HTMLTextAreaElement>("textarea.program");
      if (fault.line && area) selectLine(area, fault.line);
    } }, fault.line ? t("line", { n: fault.line }) : fault.pointer || t("document")), " ", h("span", { lang: "en" }, fault.message));
    fill(verdict, h("p", { class: "state failed" }, title), h("ul", { class: "faults" }, ...faults.slice(0, 20).map(entry)));
  }

  function refused(error: unknown): void {
    if (error instanceof Refused && error.problem.errors?.length) {
      faults = error.problem.errors.map((each) => ({ pointer: each.pointer, message: each.message, ...(each.line ? { line: each.line } : {}) }));
      showFaults(formPlace, faults);
      showFaultList(faults.length === 1 ? t("one_fault") : t("faults", { n: faults.length }));
      return;
    }
    faults = [];
    showFaults(formPlace, []);
    const text = error instanceof Refused ? (error.status === 401 ? t("log_in") : error.message) : t("offline");
    fill(verdict, h("p", { class: "notice bad" }, text));
  }

  async function check(): Promise<void> {
    if (!node) return;
    aborter = new AbortController();
    const { signal } = aborter;
    verdict.classList.add("busy");
    try {
      const preview = await postJson<Preview>("/v1/check", documentOf(), {}, signal);
      faults = [];
      showFaults(formPlace, []);
      outline.show(preview.outline);
      const { estimate } = preview, facts: string[] = [];
      if (estimate?.duration !== undefined) facts.push(t("about", { time: duration(estimate.duration) }));
      if (estimate?.path_length !== undefined) facts.push(`${number(estimate.path_length, 5)} mm`);
      if (estimate?.setpoints !== undefined) facts.push(t("setpoints", { n: estimate.setpoints }));
      fill(verdict, h("p", {}, h("span", { class: "state succeeded" }, preview.checked ? t("good") : t("not_checked")), facts.length > 0 ? " " + facts.join(" · ") : ""),
        preview.notes.length > 0 && append1(h("ul", { class: "notes", lang: "en" }), preview.notes.slice(0, 10).map((each) => h("li", {}, each))));
    } catch (error) {
      if (signal.aborted) return;
      if (error instanceof Refused && error.status === 422) outline.show(null);
      refused(error);
    }
    verdict.classList.remove("busy");
  }

  async function submit(): Promise<void> {
    if (!node) return;
    checking.cancel();
    aborter?.abort();
    const text = JSON.stringify(documentOf());
    if (text !== posted) key = newKey(); // the same document, posted again after an answer was lost, is the same job
    posted = text;
    post.disabled = true;
    post.textContent = t("posting");
    try {
      const job = await postJson<{ id: string }>("/v1/jobs", text, { "Idempotency-Key": key });
      location.href = at(`/jobs/${job.id}`);
      return;
    } catch (error) {
      refused(error);
      const first = faults[0] && fieldAt(formPlace, faults[0].pointer);
      if (first) focusField(first);
    }
    post.disabled = false;
    post.textContent = t("plan");
  }

  async function takeMachine(): Promise<void> {
    if (!machine.value || !node) return;
    const [document, schema] = await Promise.all([getJson<JsonObject>(`/v1/machines/${machine.value}`), schemaOf(current)]);
    setMachine(document, schema);
  }
  function setMachine(document: JsonObject, schema: Schema): void {
    const spec = node?.members.get("spec");
    const given = schema.properties?.machine;
    if (!node || spec?.form !== "object" || !given) return;
    spec.members.set("machine", formOf(given, schema, document));
    draw();
    changed();
  }

  async function example_(name: string): Promise<JsonObject> {
    return getJson<JsonObject>(`/v1/examples/${encodeURIComponent(name)}`);
  }
  async function fromExample(name: string): Promise<void> {
    tell("");
    history.replaceState(null, "", location.pathname + `?example=${encodeURIComponent(name)}`);
    await show(await example_(name));
    example.value = name;
  }

  async function takeBytes(name: string, data: Blob): Promise<void> {
    await takeText(name, decode(new Uint8Array(await working(data.arrayBuffer()))));
  }
  async function takeText(name: string, { text, encoding }: ReadText): Promise<void> {
    const said = name ? [t("read", { name })] : [t("pasted")];
    if (encoding === "windows-1252") said.push(t("windows"));
    const content = recognise(text, encoding);
    history.replaceState(null, "", location.pathname);
    example.value = "";
    switch (content.what) {
      case "bad-json":
        return tell(t("bad_json", { reason: content.reason }), true);
      case "unknown-json":
        return tell(t("unknown_json", { members: content.reason }), true);
      case "job":
        await show(content.document);
        break;
      case "machine":
        if (node) setMachine(content.document, await schemaOf(current));
        said.push(t("is_machine"));
        break;
      default: {
        // The machine and the way of planning come from an example with a file of that form, or stay as they are in the form.
        const template = await example_(examples.examples.find((each) => each.name.endsWith(content.what === "dxf" ? ".dxf" : ".ngc"))?.name ?? "bracket");
        const spec = { ...(template.spec as JsonObject) };
        const own = current === "contour" && node ? ((documentOf().spec as JsonObject | undefined) ?? {}) : {};
        if (own.machine) spec.machine = own.machine;
        if (own.planning) spec.planning = own.planning;
        spec.contour = { [content.what]: content.text };
        await show({ kind: "contour", ...(name ? { name: name.slice(0, 200) } : {}), spec });
        said.push(t(content.what === "dxf" ? "is_dxf" : "is_gcode"));
      }
    }
    tell(said.join(" "));
  }

  for (const target of [drop, document.body]) {
    target.addEventListener("dragover", (event) => {
      event.preventDefault();
      drop.classList.add("over");
    });
    target.addEventListener("dragleave", () => drop.classList.remove("over"));
  }
  document.body.addEventListener("drop", (event) => {
    event.preventDefault();
    drop.classList.remove("over");
    const dropped = event.dataTransfer?.files[0];
    if (dropped) void takeBytes(dropped.name, dropped);
  });
  document.addEventListener("paste", (event) => {
    if ((event.target as Element).closest?.("input, textarea")) return;
    const pasted = event.clipboardData?.files[0], text = event.clipboardData?.getData("text/plain");
    if (pasted) void takeBytes(pasted.name, pasted);
    else if (text) void takeText("", { text, encoding: "utf-8" });
  });
  onKey("o", t("choose_file"), () => file.click());
  onKey("p", t("plan"), () => void submit());

  // Where the form begins.
  try {
    const from = parameters.get("from"), kept = location.hash === "#file" ? await takeFile().catch(() => undefined) : undefined;
    if (kept) {
      await takeBytes(kept.name, kept.data);
    } else if (from) {
      await show(await getJson<JsonObject>(`/v1/jobs/${encodeURIComponent(from)}/spec`));
      tell("");
      fill(note, t("repost"), " ", h("a", { href: at(`/jobs/${encodeURIComponent(from)}`) }, h("bdi", {}, String(documentOf().name ?? from))));
      note.hidden = false;
    } else {
      const wanted = parameters.get("example") ?? examples.examples.find((each) => each.kind === parameters.get("kind"))?.name ?? "bracket";
      await show(await example_(wanted));
      example.value = wanted;
    }
  } catch (error) {
    tell((error as Error).message, true);
  }
  document.documentElement.dataset.ready = "1";
}

function append1<T extends Element>(parent: T, children: Node[]): T {
  append(parent, ...children);
  return parent;
}

startPage();
const section = byId("new");
if (section) void working(start(section)).catch((error: Error) => fill(section, h("p", { class: "notice bad", role: "alert" }, error.message)));
