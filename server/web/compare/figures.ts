/** Figures of two results side by side. */
export interface Figure {
  path: string; // e.g. "summary.duration" or "summary.coarse_smoothness.x"
  part: string;
  name: string; // member of the part
  axis: string | null; // member of that, e.g. x
  a: unknown;
  b: unknown;
  difference: number | null; // b - a, where both are numbers
  share: number | null; // b / a - 1
}

type Part = Record<string, unknown>;
export type Figures = Record<string, Part | null | undefined>;

const plain = (value: unknown): boolean => typeof value === "number" || typeof value === "boolean" || typeof value === "string";
const isPart = (value: unknown): value is Part => typeof value === "object" && value !== null && !Array.isArray(value);

/** Returns the figures of the parts of two results, in the order in which they come; those that one of both alone has, too. Texts as long as sentences are
 *  left out. */
export function compareFigures(parts: string[], a: Figures, b: Figures): Figure[] {
  const list: Figure[] = [];
  const add = (part: string, name: string, axis: string | null, left: unknown, right: unknown): void => {
    if (!plain(left) && !plain(right)) return;
    if ([left, right].some((each) => typeof each === "string" && each.length > 40)) return;
    const numbers = typeof left === "number" && typeof right === "number";
    list.push({
      path: [part, name, ...(axis ? [axis] : [])].join("."), part, name, axis, a: left ?? null, b: right ?? null,
      difference: numbers ? right - left : null, share: numbers && left !== 0 ? right / left - 1 : null,
    });
  };
  for (const part of parts) {
    const left = a[part] ?? {}, right = b[part] ?? {};
    for (const name of new Set([...Object.keys(left), ...Object.keys(right)])) {
      const one = left[name], other = right[name];
      if (isPart(one) || isPart(other)) {
        const first = isPart(one) ? one : {}, second = isPart(other) ? other : {};
        for (const axis of new Set([...Object.keys(first), ...Object.keys(second)])) add(part, name, axis, first[axis], second[axis]);
      } else add(part, name, null, one, other);
    }
  }
  return list;
}

const baseUnits = ["1", "mm", "m", "s", "min", "deg", "rad", "N", "Nm", "Ω", "Hz", "kHz", "kg", "g", "°C", "W"];
const isUnit = (token: string): boolean => {
  const [upper, lower, more] = token.split("/");
  const known = (text: string): boolean => baseUnits.includes(text.replace(/[²³⁴]$/, ""));
  return more === undefined && token !== "1" && known(upper!) && (lower === undefined || known(lower));
};

/** Returns the unit that a description of a schema names after a comma, e.g. "mm" of "Length of the path, mm."; "" where it names none. */
export function describedUnit(description: string): string {
  for (const match of description.matchAll(/, ([^.;,]+)(?=([.;,]|$))/g)) if (match[2] !== "," && isUnit(match[1]!)) return match[1]!;
  return "";
}

interface Schema {
  description?: string;
  $ref?: string;
  properties?: Record<string, Schema>;
  $defs?: Record<string, Schema>;
}

/** Returns the unit of a member of a result by its schema; "" where it has none. */
export function unitOf(schema: Schema, path: string[]): string {
  const resolved = (each: Schema | undefined): Schema => (each?.$ref?.startsWith("#/$defs/") ? (schema.$defs?.[each.$ref.slice(8)] ?? {}) : (each ?? {}));
  let at = schema, unit = "";
  for (const name of path) {
    at = resolved(at.properties?.[name]);
    unit = describedUnit(at.description ?? "") || unit;
  }
  return unit;
}
