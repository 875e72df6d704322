/** A form on the page. Every field carries the JSON pointer of its value, so that faults find it. */
import en_fields from "../texts/en/fields.json";
import de_fields from "../texts/de/fields.json";
import de from "../texts/de/form.json";
import en from "../texts/en/form.json";
import { fill, h } from "../base/dom";
import { number } from "../base/numbers";
import { language, texts, type Table } from "../base/texts";
import { describe } from "./descriptions";
import { addMember, choose, faultOf, formOf, valueOf, type FormNode, type ListNode, type ObjectNode, type VariantNode } from "./model";
import { nullable, resolved, unitOf, type Schema } from "./schema";

const t = texts(en, de);
const names: Table = language === "de" ? de_fields : en_fields;
/** Longer texts are not put into a field: typing would become slow. */
const mostCharacters = 300_000;

/** Returns the name of a field or a value for people: "cycle_time" → "cycle time". "mode.position" names what is something else in the member `within`. */
export const labelOf = (name: string, within = ""): string => names[`${within}.${name}`] ?? names[name] ?? name.replace(/_/g, " ");
const token = (name: string): string => name.replace(/~/g, "~0").replace(/\//g, "~1");

export interface Hooks {
  changed: () => void;
}

let counter = 0;

interface Place {
  name: string; // name of the member, "" for entries of lists
  label: string;
  pointer: string;
  needed: boolean;
}

/** Returns what a member is for, behind a sign that opens it. */
function help(schema: Schema): HTMLElement | null {
  const text = describe(schema);
  return text ? h("details", { class: "help" }, h("summary", { "aria-label": t("what_is_it"), title: text }, "?"), h("p", {}, text)) : null;
}

/** Returns what a select says for no choice: the default, where there is one. */
function unchosen({ default: value }: Schema, within: string): string {
  if (value === undefined || value === null) return t("none");
  return t("by_default", { value: typeof value === "boolean" ? t(value ? "yes" : "no") : labelOf(String(value), within) });
}

function defaultText(schema: Schema): string {
  const value = schema.default;
  if (value === undefined || value === null) return "";
  if (typeof value === "number") return number(value, 12);
  return typeof value === "string" || typeof value === "boolean" ? String(value) : "";
}

function plain(node: FormNode, place: Place, control: HTMLElement, wide = false): HTMLElement {
  control.id = `f${++counter}`;
  const unit = node.form === "number" || node.form === "table" ? unitOf(node.schema) : "";
  control.setAttribute("aria-describedby", `${control.id}-fault`);
  return h("div", { class: wide ? "field wide" : "field", "data-pointer": place.pointer },
    h("label", { for: control.id }, place.label, place.needed ? null : "", unit && h("span", { class: "unit" }, unit)),
    help(node.schema), control, h("p", { class: "fault", id: `${control.id}-fault` }));
}

/** Marks a field whose text is none of its values, at once. */
function checkField(node: FormNode, control: HTMLElement): void {
  const fault = faultOf(node), field = control.closest(".field"), said = field?.querySelector(".fault");
  control.setAttribute("aria-invalid", String(fault !== null));
  if (said) said.textContent = fault === null ? "" : t(fault === "number" ? "not_a_number" : "not_json");
}

function field(node: FormNode, place: Place, hooks: Hooks): HTMLElement {
  const edited = (control: HTMLElement): void => {
    checkField(node, control);
    hooks.changed();
  };
  switch (node.form) {
    case "number": {
      const input = h("input", { type: "text", inputmode: "decimal", autocomplete: "off", placeholder: defaultText(node.schema) || (nullable(node.schema) ? t("none") : ""), input: () => {
        node.text = input.value;
        edited(input);
      } });
      input.value = node.text;
      return plain(node, place, input);
    }
    case "text": {
      if (!node.long) {
        const input = h("input", { type: "text", autocomplete: "off", ...(node.schema.maxLength ? { maxlength: node.schema.maxLength } : {}), placeholder: defaultText(node.schema), input: () => {
          node.text = input.value;
          hooks.changed();
        } });
        input.value = node.text;
        return plain(node, place, input);
      }
      if (node.text.length > mostCharacters) {
        const size = number(node.text.length / 1e6, 3);
        const shown = h("pre", { class: "program", tabindex: 0, "aria-label": place.label }, node.text.split("\n", 30).join("\n") + "\n…");
        return h("div", { class: "field wide", "data-pointer": place.pointer }, h("p", {}, `${place.label}: `, t("large_text", { size })), shown, h("p", { class: "fault" }));
      }
      const area = h("textarea", { class: "program", rows: Math.max(6, Math.min(18, node.text.split("\n").length + 1)), spellcheck: "false", wrap: "off", autocomplete: "off", input: () => {
        node.text = area.value;
        hooks.changed();
      } });
      area.value = node.text;
      return plain(node, place, area, true);
    }
    case "flag": {
      const select = h("select", { change: () => {
        node.value = select.value === "" ? null : select.value === "true";
        hooks.changed();
      } });
      if (!place.needed || node.value === null) select.append(h("option", { value: "" }, unchosen(node.schema, place.name)));
      select.append(h("option", { value: "true" }, t("yes")), h("option", { value: "false" }, t("no")));
      select.value = node.value === null ? "" : String(node.value);
      return plain(node, place, select);
    }
    case "choice": {
      if (node.several) {
        const boxes = node.values.map((value, at) => {
          const box = h("input", { type: "checkbox", change: () => {
            node.chosen = box.checked ? [...node.chosen, at] : node.chosen.filter((each) => each !== at);
            hooks.changed();
          } });
          box.checked = node.chosen.includes(at);
          return h("label", { class: "box" }, box, " ", labelOf(String(value), place.name));
        });
        return h("div", { class: "field wide", "data-pointer": place.pointer, role: "group", "aria-label": place.label },
          h("span", { class: "label" }, place.label), help(node.schema), h("div", { class: "boxes" }, ...boxes), h("p", { class: "fault" }));
      }
      const select = h("select", { change: () => {
        node.chosen = select.value === "" ? [] : [Number(select.value)];
        hooks.changed();
      } });
      if (!place.needed || node.chosen.length === 0) select.append(h("option", { value: "" }, unchosen(node.schema, place.name)));
      node.values.forEach((value, at) => select.append(h("option", { value: at }, labelOf(String(value), place.name))));
      select.value = node.chosen.length === 0 ? "" : String(node.chosen[0]);
      return plain(node, place, select);
    }
    case "table": {
      const change = (event: Event): void => {
        node.text = (event.target as HTMLTextAreaElement).value;
        edited(event.target as HTMLElement);
      };
      const control = node.flat
        ? h("input", { type: "text", inputmode: "decimal", autocomplete: "off", input: change })
        : h("textarea", { class: "program", rows: Math.max(3, Math.min(14, node.text.split("\n").length + 1)), spellcheck: "false", input: change });
      control.value = node.text;
      return plain(node, place, control, !node.flat);
    }
    case "raw": {
      const area = h("textarea", { class: "program", rows: Math.max(2, Math.min(10, Math.ceil(node.text.length / 70))), spellcheck: "false", input: () => {
        node.text = area.value;
        edited(area);
      } });
      area.value = node.text;
      return plain(node, { ...place, label: `${place.label} (JSON)` }, area, true);
    }
    case "object":
      return group(place, node.schema, (body) => members(body, node, place.pointer, hooks));
    case "list":
      return group(place, node.schema, (body) => entries(body, node, place, hooks));
    case "variant":
      return variant(node, place, hooks);
  }
}

function group(place: Place, schema: Schema, draw: (body: HTMLElement) => void): HTMLElement {
  const body = h("div", { class: "fields" });
  draw(body);
  return h("fieldset", { "data-pointer": place.pointer }, h("legend", {}, place.label), help(schema), h("p", { class: "fault" }), body);
}

const empty = (node: FormNode): boolean => valueOf(node) === undefined;

/** Draws the members of an object: what is needed or given, then the others, folded. */
function members(body: HTMLElement, node: ObjectNode, pointer: string, hooks: Hooks, open = false): void {
  const shown: HTMLElement[] = [], folded: HTMLElement[] = [], needed = node.schema.required ?? [];
  const within = /([^/]*)(?:\/\d+)*$/.exec(pointer)![1];
  for (const [name, member] of node.members) {
    const place: Place = { name, label: labelOf(name, within), pointer: `${pointer}/${token(name)}`, needed: needed.includes(name) };
    if (member === null) {
      const schema = resolved(node.schema.properties![name] as Schema, node.root);
      folded.push(h("div", { class: "field" }, h("button", { type: "button", class: "add", title: describe(schema) || null, click: () => {
        addMember(node, name);
        fill(body);
        members(body, node, pointer, hooks, true);
        hooks.changed();
      } }, "+ ", place.label)));
      continue;
    }
    if (member.form === "choice" && member.schema.const !== undefined) continue; // the alternative's select says it
    const removable = !place.needed && (member.form === "object" || member.form === "list");
    const element = field(member, place, hooks);
    if (removable)
      element.append(h("button", { type: "button", class: "remove", "aria-label": t("remove", { name: place.label }), title: t("remove", { name: place.label }), click: () => {
        node.members.set(name, null);
        fill(body);
        members(body, node, pointer, hooks, true);
        hooks.changed();
      } }, "×"));
    (place.needed || !empty(member) || removable ? shown : folded).push(element);
  }
  for (const [name, value] of Object.entries(node.extra))
    shown.push(h("div", { class: "field", "data-pointer": `${pointer}/${token(name)}` }, h("span", { class: "label" }, name), h("code", {}, JSON.stringify(value)),
      h("button", { type: "button", class: "remove", "aria-label": t("remove", { name }), click: () => {
        delete node.extra[name];
        fill(body);
        members(body, node, pointer, hooks, true);
        hooks.changed();
      } }, "×"), h("p", { class: "fault" })));
  body.append(...shown);
  if (folded.length > 0) body.append(h("details", { class: "advanced", open }, h("summary", {}, t("more", { n: folded.length })), h("div", { class: "fields" }, ...folded)));
}

function short(node: FormNode): string {
  const text = JSON.stringify(valueOf(node) ?? null).replace(/["{}]/g, "").replace(/[:,]/g, "$& ");
  return text.length > 70 ? text.slice(0, 68) + " …" : text;
}

function entries(body: HTMLElement, node: ListNode, place: Place, hooks: Hooks): void {
  const again = (): void => {
    fill(body);
    entries(body, node, place, hooks);
    hooks.changed();
  };
  node.entries.forEach((entry, at) => {
    const title = h("span", {}, `${at + 1}: ${short(entry)}`);
    const inner = h("div", { class: "fields" }, field(entry, { name: "", label: `${place.label} ${at + 1}`, pointer: `${place.pointer}/${at}`, needed: true }, {
      changed: () => {
        title.textContent = `${at + 1}: ${short(entry)}`;
        hooks.changed();
      },
    }));
    body.append(h("details", { class: "entry", open: node.entries.length <= 3 }, h("summary", {}, title), inner,
      h("button", { type: "button", click: () => {
        node.entries.splice(at + 1, 0, formOf(node.item, node.root, valueOf(entry)));
        again();
      } }, t("copy_entry")), " ",
      h("button", { type: "button", click: () => {
        node.entries.splice(at, 1);
        again();
      } }, t("remove", { name: `${place.label} ${at + 1}` }))));
  });
  body.append(h("button", { type: "button", class: "add", click: () => {
    const made = formOf(node.item, node.root, undefined);
    node.entries.push(made);
    again();
  } }, "+ ", t("add_entry")));
}

/** Returns the name of an alternative: the word that names it, its title, or its type. */
function branchName(branch: Schema): string {
  if (branch.const !== undefined) return labelOf(String(branch.const));
  if (branch.title) return labelOf(branch.title);
  return t(`type_${branch.type as "number"}`);
}

function variant(node: VariantNode, place: Place, hooks: Hooks): HTMLElement {
  const body = h("div", { class: "fields" });
  const select = h("select", { "aria-label": place.label, change: () => {
    choose(node, Number(select.value));
    draw();
    hooks.changed();
  } });
  const draw = (): void => {
    fill(body);
    const inner = node.at < 0 ? undefined : node.nodes[node.at];
    if (!inner || (inner.form === "choice" && inner.schema.const !== undefined)) return;
    if (inner.form === "object") members(body, inner, place.pointer, hooks);
    else body.append(field(inner, { ...place, label: place.label }, hooks));
  };
  if (node.at < 0 || !place.needed) select.append(h("option", { value: -1 }, unchosen(node.schema, place.name)));
  node.branches.forEach((branch, at) => select.append(h("option", { value: at }, branchName(branch))));
  select.value = String(node.at);
  draw();
  return h("fieldset", { "data-pointer": place.pointer, class: "variant" }, h("legend", {}, place.label), help(node.schema), h("p", { class: "fault" }), select, body);
}

/** Draws a form into an element; its members have pointers below `pointer`. */
export function drawForm(into: HTMLElement, node: FormNode, pointer: string, hooks: Hooks): void {
  fill(into);
  if (node.form === "object") members(into, node, pointer, hooks);
  else into.append(field(node, { name: "", label: "", pointer, needed: true }, hooks));
}

/** Returns the field of a pointer, or the nearest above it. */
export function fieldAt(root: ParentNode, pointer: string): HTMLElement | null {
  for (let at = pointer; at !== ""; at = at.slice(0, at.lastIndexOf("/"))) {
    const found = root.querySelector<HTMLElement>(`[data-pointer="${CSS.escape(at)}"]`);
    if (found) return found;
  }
  return null;
}

/** Opens what is folded around a field, and puts the cursor into it. */
export function focusField(field: HTMLElement): void {
  for (let at: HTMLElement | null = field; at; at = at.parentElement) if (at instanceof HTMLDetailsElement) at.open = true;
  field.scrollIntoView({ block: "center" });
  field.querySelector<HTMLElement>("input, select, textarea")?.focus({ preventScroll: true });
}

export interface Fault {
  pointer: string;
  message: string;
  line?: number;
}

/** Writes faults to their fields. */
export function showFaults(root: HTMLElement, faults: readonly Fault[]): void {
  for (const said of root.querySelectorAll(".fault")) said.textContent = "";
  for (const control of root.querySelectorAll("[aria-invalid=true]")) control.setAttribute("aria-invalid", "false");
  for (const fault of faults) {
    const found = fieldAt(root, fault.pointer), said = found?.querySelector(".fault");
    if (!found || !said) continue;
    said.textContent += (said.textContent ? " · " : "") + fault.message;
    found.querySelector(":scope > input, :scope > select, :scope > textarea")?.setAttribute("aria-invalid", "true");
  }
}

/** Selects a line of a program in its field. */
export function selectLine(area: HTMLTextAreaElement, line: number): void {
  const lines = area.value.split("\n"), from = lines.slice(0, line - 1).reduce((sum, each) => sum + each.length + 1, 0);
  area.focus();
  area.setSelectionRange(from, from + (lines[line - 1]?.length ?? 0));
  const height = area.scrollHeight / Math.max(1, lines.length);
  area.scrollTop = Math.max(0, (line - 4) * height);
}
