/** Numbers as pages show them: a comma as decimal sign in German, never a sign for thousands. */
import { language } from "./texts";

const comma = (text: string): string => (language === "de" ? text.replace(".", ",") : text);

/** Returns a number with so many digits after the point. */
export const fixed = (value: number, digits: number): string => comma(value.toFixed(digits));

/** Returns a number with at most six significant digits. */
export function number(value: number, digits = 6): string {
  if (!Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) return comma(value.toExponential(3).replace("e+", "e"));
  return comma(String(Number(value.toPrecision(digits))));
}

/** Returns a duration, s, as "3.315 s", "152.97 s", "12 min 33 s" or "1 h 2 min". */
export function duration(seconds: number): string {
  if (seconds < 59.9995) return fixed(seconds, 3) + " s";
  if (seconds < 599.995) return fixed(seconds, 2) + " s";
  const whole = Math.round(seconds), minutes = Math.floor(whole / 60), hours = Math.floor(minutes / 60);
  return hours > 0 ? `${hours} h ${minutes - 60 * hours} min` : `${minutes} min ${whole - 60 * minutes} s`;
}

/** Returns a share as "48 %", with two digits; "0 %" for nothing, "< 0.01 %" for less than that. */
export function percent(share: number): string {
  const value = share * 100;
  if (value === 0) return "0 %";
  if (Math.abs(value) < 0.01) return "< " + comma("0.01") + " %";
  return Math.abs(value) >= 9.95 ? value.toFixed(0) + " %" : comma(String(Number(value.toPrecision(2)))) + " %";
}

/** Returns the number that somebody typed with a point or a comma as decimal sign; NaN for anything else, signs for thousands among them. */
export function parseNumber(text: string): number {
  const trimmed = text.trim();
  return /^[+-]?(\d+([.,]\d*)?|[.,]\d+)([eE][+-]?\d+)?$/.test(trimmed) ? Number(trimmed.replace(",", ".")) : NaN;
}
