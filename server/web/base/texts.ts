/** The texts of a page in the language of its reader, from the tables in server/web/texts that the service uses, too. */
export type Language = "en" | "de";
export type Table = Record<string, string>;

/** Language of the page. In modules tested without a page it is English. */
export const language: Language =
  typeof document !== "undefined" && document.documentElement.lang === "de" ? "de" : "en";

/** Returns `text` with the values in place of {names}. */
export function filled(text: string, values: Record<string, string | number> = {}): string {
  return text.replace(/\{(\w+)\}/g, (whole, name: string) => (name in values ? String(values[name]) : whole));
}

/** Returns the function that gives the texts of an area: t("verified", {time: "3 s"}). A key that is not in the table is a fault of the program. */
export function texts<E extends Table>(en: E, de: Record<keyof E, string>) {
  const table: Record<keyof E, string> = language === "de" ? de : en;
  return (key: keyof E & string, values?: Record<string, string | number>): string => filled(table[key], values);
}

import names_de from "../texts/de/names.json";
import names_en from "../texts/en/names.json";
const names: Table = language === "de" ? names_de : names_en;

/** Returns the name of a limit or check, e.g. "acceleration x", in the page's language: its words are in the area "names", what stays is an axis. */
export function nameOf(english: string): string {
  if (english in names) return names[english]!;
  const last = english.lastIndexOf(" ");
  return last < 0 ? english : nameOf(english.slice(0, last)) + english.slice(last);
}
