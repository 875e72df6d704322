/** What the fields of a form are for, in the language of the page. Schemas say it in English; its German is a module of its own, which a German form loads. */
import { language, type Table } from "../base/texts";
import type { Schema } from "./schema";

let table: Table = {};

/** Loads what describe() needs in the language of the page. */
export async function loadDescriptions(): Promise<void> {
  if (language === "de") table = ((await import(new URL("./descriptions_de.js", import.meta.url).href)) as { descriptions: Table }).descriptions;
}

/** Returns the description of a schema, "" where it has none. */
export function describe(schema: Schema): string {
  const english = schema.description ?? "";
  return table[english] ?? english;
}
