/** Which axis and which derivative a column of the setpoints is. */

export type Quantity = "position" | "velocity" | "acceleration" | "jerk" | "snap" | "use" | "other";
export const quantities: readonly Quantity[] = ["position", "velocity", "acceleration", "jerk", "snap", "use", "other"];

export interface ChartColumn {
  name: string;
  unit: string; // "" for shares
  quantity: Quantity;
  axis: string; // "" for what belongs to the path, or the law, as a whole
  of?: string; // the column of the series of which this is the difference per cycle
}

const differences = "d:";
/** Returns the column of the series from which a shown one comes: "ax" of "d:ax". */
export const sourceOf = (name: string): string => (name.startsWith(differences) ? name.slice(differences.length) : name);
const next: Partial<Record<Quantity, [Quantity, string]>> = { acceleration: ["jerk", "/s³"], jerk: ["snap", "/s⁴"] };

const derivatives: Record<string, Quantity> = { s: "position", v: "velocity", a: "acceleration", j: "jerk" };
const numbers = new Set(["mode", "block", "phi_master"]);

/** Returns the columns that are drawn: those of the series but its numbers and its independent variable, and the use of the limits. */
export function chartColumns(names: string[], units: string[], kind: string): ChartColumn[] {
  const known = new Set(names), list: ChartColumn[] = [];
  names.forEach((name, i) => {
    if (numbers.has(name) || (kind === "motion_law" && name === "phi")) return;
    const unit = units[i] === "1" ? "" : units[i] ?? "", rest = name.slice(1), whole = derivatives[name];
    if (whole) list.push({ name, unit, quantity: whole, axis: "" });
    else if (name[0]! in derivatives && rest !== "" && known.has(rest)) list.push({ name, unit, quantity: derivatives[name[0]!]!, axis: rest });
    else if (known.has("v" + name) || known.has("a" + name)) list.push({ name, unit, quantity: "position", axis: name });
    else if (/^(x|y|z|phi|psi|q\d)$/.test(name)) list.push({ name, unit, quantity: "position", axis: name });
    else list.push({ name, unit, quantity: "other", axis: name });
  });
  // The derivative that the series lacks is a difference of the last one that it has, as the service takes it for its limits.
  for (const column of [...list]) {
    const [quantity, per] = next[column.quantity] ?? [];
    if (quantity && !list.some((each) => each.axis === column.axis && each.quantity === quantity) && (column.axis !== "" || kind === "motion_law"))
      list.push({ name: differences + column.name, unit: column.unit.replace(/\/s.*$/, "") + per!, quantity, axis: column.axis, of: column.name });
  }
  list.push({ name: "use", unit: "", quantity: "use", axis: "" });
  return list;
}

/** Returns the columns shown where the address names none: speed, then what limits usually belong to. */
export function defaultColumns(columns: ChartColumn[], kind: string): string[] {
  const of = (quantity: Quantity, axis: (name: string) => boolean): string[] => columns.filter((each) => each.quantity === quantity && axis(each.axis)).map((each) => each.name);
  if (kind === "motion_law") return ["s", "v", "a", "j"].filter((name) => columns.some((each) => each.name === name));
  const axes = of("acceleration", (axis) => axis !== "");
  const fine = axes.filter((name) => /[cf]$/.test(name)); // where there are coarse and fine axes, theirs, not their sums
  return [...of("velocity", (axis) => axis === ""), ...(fine.length > 0 ? fine : axes).slice(0, 6), ...of("other", (axis) => axis === "deviation"), "use"];
}
