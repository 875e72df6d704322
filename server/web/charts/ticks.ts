/** Ticks of an axis: round values, from years down to a millionth, with as many digits as tell neighbours apart. */
import { fixed } from "../base/numbers";

export interface Ticks {
  values: number[];
  step: number;
  text(value: number): string;
}

/** Returns at most `most` ticks between two values, at multiples of 1, 2 or 5 times a power of ten. */
export function ticks(from: number, to: number, most: number): Ticks {
  const low = Math.min(from, to), high = Math.max(from, to), least = (high - low) / Math.max(1, most);
  if (!(least > 0) || !Number.isFinite(least)) return { values: Number.isFinite(low) ? [low] : [], step: 1, text: (value) => plain(value, 1) };
  const power = Math.pow(10, Math.floor(Math.log10(least)));
  const factor = [1, 2, 5, 10].find((each) => each * power >= least * (1 - 1e-9)) ?? 10;
  const step = factor * power, values: number[] = [];
  // Multiples are counted, so that no error adds up.
  for (let k = Math.ceil(low / step - 1e-9); k <= high / step + 1e-9 && values.length <= most + 1; ++k) values.push(k === 0 ? 0 : k * step);
  return { values, step, text: (value) => plain(value, step) };
}

/** Returns at most `most` ticks of an angle, at multiples of 1, 2, 5, 10, 15, 30, 45, 60, 90 … deg. */
export function angleTicks(from: number, to: number, most: number): Ticks {
  const low = Math.min(from, to), high = Math.max(from, to), least = (high - low) / Math.max(1, most);
  const step = [10, 15, 30, 45, 60, 90, 180, 360].find((each) => each >= least * (1 - 1e-9));
  if (!step || least < 5) return ticks(from, to, most);
  const values: number[] = [];
  for (let k = Math.ceil(low / step - 1e-9); k <= high / step + 1e-9; ++k) values.push(k === 0 ? 0 : k * step);
  return { values, step, text: (value) => plain(value, step) };
}

/** Returns a tick's value with the digits that its step needs; very large and very small ones with a power of ten. */
function plain(value: number, step: number): string {
  if (value === 0) return "0";
  const size = Math.abs(value), digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  if (size >= 1e6 || digits > 9) {
    const power = Math.floor(Math.log10(size) + 1e-12);
    return fixed(value / Math.pow(10, power), Math.max(0, Math.min(6, power + digits))).replace(/([.,]\d*?)0+$/, "$1").replace(/[.,]$/, "") + "e" + power;
  }
  return fixed(value, Math.min(digits, 9));
}
