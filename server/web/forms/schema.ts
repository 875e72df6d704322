/** What a form reads from a JSON Schema of the service: the keywords that its schemas use. */
export type Json = null | boolean | number | string | Json[] | { [key: string]: Json };
export type JsonObject = { [key: string]: Json };

export interface Schema {
  $ref?: string;
  type?: string | string[];
  title?: string;
  description?: string;
  properties?: Record<string, Schema | false>;
  required?: string[];
  additionalProperties?: boolean | Schema;
  items?: Schema;
  oneOf?: Schema[];
  enum?: Json[];
  const?: Json;
  default?: Json;
  maxLength?: number;
  $defs?: Record<string, Schema>;
}

/** Returns the schema that `schema` refers to, with what stands beside the reference. */
export function resolved(schema: Schema, root: Schema): Schema {
  if (!schema.$ref) return schema;
  const { $ref, ...beside } = schema;
  let target: unknown = root;
  for (const token of $ref.slice(2).split("/")) target = (target as Record<string, unknown>)[token];
  return { ...resolved(target as Schema, root), ...beside };
}

/** Returns the alternatives of a schema, each complete: what stands beside oneOf holds for all of them. A list of types is a choice, too; null is none of
 *  them, because an empty field says it. A single one is no choice. */
export function alternatives(given: Schema, root: Schema): Schema[] {
  const { oneOf, ...base } = given;
  if (oneOf) {
    return oneOf.map((each) => {
      const branch = resolved(each, root);
      if (!base.properties && base.type !== "object") return { ...base, ...branch };
      const properties: Record<string, Schema | false> = { ...base.properties };
      for (const [name, member] of Object.entries(branch.properties ?? {}))
        properties[name] = member === false ? false : properties[name] ? { ...(properties[name] as Schema), ...member } : member;
      for (const [name, member] of Object.entries(properties)) if (member === false) delete properties[name];
      return { ...base, ...branch, properties, required: [...new Set([...(base.required ?? []), ...(branch.required ?? [])])] };
    });
  }
  if (Array.isArray(base.type)) return base.type.filter((type) => type !== "null").map((type) => ({ ...base, type }));
  return [base];
}

/** Whether null is a value of the schema. */
export const nullable = (schema: Schema): boolean => Array.isArray(schema.type) && schema.type.includes("null");

const power = "(?:²|³|⁴|⁵)?", base = `(?:mm|m|s|min|deg|rad|Nm|N|Ω|kHz|Hz|kg|g|°C|W)${power}`;
const unit = new RegExp(`, ((?:1|${base})(?:/${base})?)(?=[.,;:]|$)`);

/** Returns the unit that a description names between a comma and the end of a clause, "" where there is none: "Length, mm." → "mm". */
export function unitOf(schema: Schema): string {
  const said = schema.description ?? "";
  const found = said.includes("no unit") ? "" : unit.exec(said)?.[1] ?? "";
  return found === "1" ? "" : found;
}

function typeOf(value: Json): string {
  if (value === null) return "null";
  if (Array.isArray(value)) return "array";
  return typeof value === "number" && Number.isInteger(value) ? "integer" : typeof value;
}

const sameJson = (a: Json | undefined, b: Json | undefined): boolean => JSON.stringify(a) === JSON.stringify(b);

/** Whether a value may be meant by an alternative: its type fits, it has all members that are required and none that there is not, and the members that name the
 *  alternative have the values that they have to. What else may be wrong with it is the service's to say. */
export function fits(value: Json, schema: Schema, root: Schema): boolean {
  if (schema.const !== undefined) return sameJson(value, schema.const);
  const types = schema.type === undefined ? [] : Array.isArray(schema.type) ? schema.type : [schema.type];
  const type = typeOf(value);
  if (types.length > 0 && !types.includes(type) && !(type === "integer" && types.includes("number"))) return false;
  if (schema.enum && !schema.enum.some((each) => sameJson(each, value))) return false;
  if (type !== "object") return true;
  const object = value as JsonObject;
  if ((schema.required ?? []).some((name) => !(name in object))) return false;
  for (const [name, member] of Object.entries(object)) {
    const given = schema.properties?.[name];
    if (!given && schema.additionalProperties === false) return false;
    if (given && resolved(given, root).const !== undefined && !sameJson(member, resolved(given, root).const)) return false;
  }
  return true;
}
