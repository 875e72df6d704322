/** A document as a form: one node per field, made from schema and document. A document that goes in comes out as it was, unless somebody changes a field. */
import { parseNumber } from "../base/numbers";
import { language } from "../base/texts";
import { alternatives, fits, nullable, resolved, type Json, type JsonObject, type Schema } from "./schema";

/** More entries than that are edited as text. */
export const mostEntries = 40;

export type FormNode = NumberNode | TextNode | FlagNode | ChoiceNode | ObjectNode | ListNode | TableNode | VariantNode | RawNode;

interface Common {
  schema: Schema;
  /** What the empty field stands for: absent, or null or an empty list where the document says so. */
  empty: Json | undefined;
}
export interface NumberNode extends Common { form: "number"; text: string }
export interface TextNode extends Common { form: "text"; text: string; long: boolean }
export interface FlagNode extends Common { form: "flag"; value: boolean | null } // null: as by default
/** One of few values; `chosen` -1: none. `several`: any number of them, in the order in which they were chosen. */
export interface ChoiceNode extends Common { form: "choice"; values: Json[]; chosen: number[]; several: boolean }
export interface ObjectNode extends Common {
  form: "object";
  members: Map<string, FormNode | null>; // null: absent
  extra: JsonObject; // members that the schema does not know: the service says what it thinks of them
  root: Schema;
}
export interface ListNode extends Common { form: "list"; entries: FormNode[]; item: Schema; root: Schema }
/** Numbers as text: one row per line, or all in one line. */
export interface TableNode extends Common { form: "table"; text: string; flat: boolean; rows: boolean }
export interface VariantNode extends Common { form: "variant"; branches: Schema[]; at: number; nodes: (FormNode | undefined)[]; root: Schema }
/** What no field suits, as JSON. */
export interface RawNode extends Common { form: "raw"; text: string }

const shownNumber = (value: number): string => (language === "de" ? String(value).replace(".", ",") : String(value));

const isNumberSchema = (schema: Schema): boolean =>
  schema.type === "number" || schema.type === "integer";
const isNumberList = (value: Json): value is number[] => Array.isArray(value) && value.every((each) => typeof each === "number");

/** Makes the form of a value; `value` undefined: absent. */
export function formOf(given: Schema, root: Schema, value: Json | undefined): FormNode {
  const schema = resolved(given, root);
  const empty: Json | undefined = value === null ? null : undefined;
  const present = value === null ? undefined : value;
  const branches = alternatives(schema, root);
  if (branches.length > 1) {
    const at = present === undefined ? 0 : branches.findIndex((branch) => fits(present, branch, root));
    if (at < 0) return raw(schema, value);
    if (present === undefined && (value === null || schema.default !== undefined)) return variant(schema, branches, -1, root, empty);
    const node = variant(schema, branches, at, root, empty);
    node.nodes[at] = formOf(branches[at]!, root, present);
    return node;
  }
  const only = branches[0]!;
  if (only.const !== undefined) return { form: "choice", schema: only, empty, values: [only.const], chosen: present === undefined ? [] : [0], several: false };
  if (only.enum) {
    const chosen = present === undefined ? [] : [only.enum.findIndex((each) => each === present)];
    return chosen[0] === -1 ? raw(only, value) : { form: "choice", schema: only, empty, values: only.enum, chosen, several: false };
  }
  switch (only.type) {
    case "number":
    case "integer":
      if (present !== undefined && typeof present !== "number") return raw(only, value);
      return { form: "number", schema: only, empty, text: present === undefined ? "" : shownNumber(present) };
    case "boolean":
      if (present !== undefined && typeof present !== "boolean") return raw(only, value);
      return { form: "flag", schema: only, empty, value: present ?? null };
    case "string":
      if (present !== undefined && typeof present !== "string") return raw(only, value);
      return { form: "text", schema: only, empty: present === "" ? "" : empty, text: present ?? "", long: (only.maxLength ?? 0) > 4000 };
    case "array":
      return arrayForm(only, root, present, empty);
    case "object":
      if (present !== undefined && (typeof present !== "object" || Array.isArray(present))) return raw(only, value);
      return only.properties ? objectForm(only, root, present as JsonObject | undefined, empty) : raw(only, value);
  }
  return raw(only, value);
}

const raw = (schema: Schema, value: Json | undefined): RawNode => ({
  form: "raw", schema, empty: value === null ? null : undefined, text: value == null ? "" : JSON.stringify(value),
});

const variant = (schema: Schema, branches: Schema[], at: number, root: Schema, empty: Json | undefined): VariantNode =>
  ({ form: "variant", schema, branches, at, nodes: branches.map(() => undefined), root, empty });

function objectForm(schema: Schema, root: Schema, value: JsonObject | undefined, empty: Json | undefined): ObjectNode {
  const members = new Map<string, FormNode | null>(), extra: JsonObject = {};
  for (const [name, member] of Object.entries(schema.properties ?? {})) {
    if (member === false) continue;
    const node = formOf(member, root, value?.[name]);
    const needed = (schema.required ?? []).includes(name);
    // Groups that are absent are offered, not shown.
    const group = node.form === "object" || node.form === "list" || (node.form === "variant" && node.at >= 0) || (node.form === "raw" && node.text === "");
    members.set(name, group && value?.[name] === undefined && !needed ? null : node);
  }
  for (const [name, member] of Object.entries(value ?? {})) if (!members.has(name)) extra[name] = member;
  return { form: "object", schema, empty, members, extra, root };
}

function arrayForm(schema: Schema, root: Schema, present: Json | undefined, given: Json | undefined): FormNode {
  if (present !== undefined && !Array.isArray(present)) return raw(schema, present);
  const item = resolved(schema.items ?? {}, root), list = (present as Json[] | undefined) ?? [];
  const empty = present !== undefined && list.length === 0 ? [] : given;
  if (isNumberSchema(item) && list.every((each) => typeof each === "number"))
    return { form: "table", schema, empty, text: list.map((each) => shownNumber(each as number)).join("  "), flat: true, rows: false };
  if (item.type === "array" && isNumberSchema(resolved(item.items ?? {}, root)) && list.every((row) => isNumberList(row) && row.length > 0))
    return { form: "table", schema, empty, text: list.map((row) => (row as number[]).map(shownNumber).join("  ")).join("\n"), flat: false, rows: true };
  if (item.enum) {
    const chosen = list.map((each) => item.enum!.indexOf(each));
    return chosen.includes(-1) || new Set(chosen).size < chosen.length ? raw(schema, present)
      : { form: "choice", schema, empty, values: item.enum, chosen, several: true };
  }
  if (list.length > mostEntries) return raw(schema, present);
  return { form: "list", schema, empty, entries: list.map((each) => formOf(item, root, each)), item, root };
}

/** Returns the value of a form; undefined: absent. A field that says no number has its text as value: the service, or faultOf(), says what is wrong. */
export function valueOf(node: FormNode | null): Json | undefined {
  if (node === null) return undefined;
  switch (node.form) {
    case "number":
      return node.text.trim() === "" ? node.empty : numberOr(node.text);
    case "text":
      return node.text === "" ? node.empty : node.text;
    case "flag":
      return node.value ?? node.empty;
    case "choice":
      if (node.several) return node.chosen.length === 0 ? node.empty : node.chosen.map((at) => node.values[at]!);
      return node.chosen.length === 0 ? node.empty : node.values[node.chosen[0]!];
    case "object": {
      const object: JsonObject = {};
      for (const [name, member] of node.members) {
        const value = valueOf(member);
        if (value !== undefined) object[name] = value;
      }
      return { ...object, ...node.extra };
    }
    case "list":
      return node.entries.length === 0 ? node.empty : node.entries.map((each) => valueOf(each) ?? null);
    case "table":
      return node.text.trim() === "" ? node.empty : tableValue(node);
    case "variant":
      return node.at < 0 ? node.empty : valueOf(node.nodes[node.at] ?? null);
    case "raw":
      if (node.text.trim() === "") return node.empty;
      try {
        return JSON.parse(node.text) as Json;
      } catch {
        return node.text;
      }
  }
}

const numberOr = (text: string): Json => {
  const number = parseNumber(text);
  return Number.isNaN(number) ? text : number;
};

const words = (line: string): string[] => line.split(/[\s;]+/).map((word) => word.replace(/,$/, "")).filter((word) => word !== "");

function tableValue(node: TableNode): Json {
  if (node.flat) return words(node.text).map(numberOr);
  return node.text.split("\n").map((line) => words(line).map(numberOr)).filter((row) => row.length > 0);
}

/** Whether a field has a text that is none of its values: "number" or "json"; null: no fault. */
export function faultOf(node: FormNode): "number" | "json" | null {
  if (node.form === "number") return node.text.trim() !== "" && Number.isNaN(parseNumber(node.text)) ? "number" : null;
  if (node.form === "table") return words(node.text).some((word) => Number.isNaN(parseNumber(word))) ? "number" : null;
  if (node.form === "raw" && node.text.trim() !== "") {
    try {
      JSON.parse(node.text);
    } catch {
      return "json";
    }
  }
  return null;
}

/** Chooses an alternative. Members that both have keep their values. */
export function choose(node: VariantNode, at: number): void {
  const before = node.at < 0 ? undefined : valueOf(node.nodes[node.at] ?? null);
  node.at = at;
  if (at < 0 || node.nodes[at]) return;
  const branch = node.branches[at]!;
  let value: Json | undefined = branch.const;
  if (branch.properties) {
    const object: JsonObject = {};
    for (const [name, given] of Object.entries(branch.properties)) {
      if (given === false) continue;
      const member = resolved(given, node.root);
      const kept = before && typeof before === "object" && !Array.isArray(before) ? before[name] : undefined;
      if (member.const !== undefined) object[name] = member.const;
      else if (kept !== undefined && fits(kept, member, node.root)) object[name] = kept;
    }
    value = object;
  }
  node.nodes[at] = formOf(branch, node.root, value);
}

/** Adds a member that is absent, with what it needs. */
export function addMember(node: ObjectNode, name: string): FormNode {
  const schema = resolved(node.schema.properties![name] as Schema, node.root);
  const start: Json | undefined = schema.default !== undefined && schema.default !== null ? schema.default : alternatives(schema, node.root)[0]!.type === "object" ? {} : undefined;
  let made = formOf(schema, node.root, undefined);
  if (start !== undefined) {
    const filled = formOf(schema, node.root, start);
    if (filled.form !== "raw") made = filled;
  }
  if (made.form === "variant" && made.at < 0) choose(made, 0);
  node.members.set(name, made);
  return made;
}

/** Returns the node that a JSON pointer names, or the one above it where it names none, with the tokens that are left. */
export function nodeAt(root: FormNode, pointer: string): { node: FormNode; rest: string[] } {
  const tokens = pointer.split("/").slice(1).map((token) => token.replace(/~1/g, "/").replace(/~0/g, "~"));
  let node = root;
  for (let i = 0; i < tokens.length; ) {
    if (node.form === "variant") {
      const inner: FormNode | undefined = node.at < 0 ? undefined : node.nodes[node.at];
      if (!inner) return { node, rest: tokens.slice(i) };
      node = inner;
      continue;
    }
    const next: FormNode | null | undefined =
      node.form === "object" ? node.members.get(tokens[i]!) : node.form === "list" ? node.entries[Number(tokens[i])] : undefined;
    if (!next) return { node, rest: tokens.slice(i) };
    node = next;
    ++i;
  }
  return { node, rest: [] };
}

/** Returns the schema of a whole job document of a kind: the envelope with the kind's schema as its spec. */
export function jobForm(envelope: Schema, kindSchema: Schema, document: JsonObject): ObjectNode {
  const { spec, ...rest } = document;
  const { spec: _, ...properties } = envelope.properties ?? {};
  const node = objectForm({ ...envelope, properties }, envelope, rest, undefined);
  node.members.set("spec", formOf({ ...kindSchema, title: "" }, kindSchema, spec ?? {}));
  return node;
}

export { isNumberList };
