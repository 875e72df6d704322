/** Ticks of times: whole divisors of minutes and hours where seconds are too narrow, down to 1 µs and less. */
import { ticks, type Ticks } from "./ticks";

const clockSteps = [60, 120, 300, 600, 1200, 1800, 3600, 7200, 14400, 28800, 86400];

/** Returns a time, s, as "2:30" or "1:02:00". */
export function clock(seconds: number): string {
  const whole = Math.round(seconds), two = (n: number): string => String(n).padStart(2, "0");
  const hours = Math.floor(whole / 3600), minutes = Math.floor(whole / 60) % 60;
  return hours > 0 ? `${hours}:${two(minutes)}:${two(whole % 60)}` : `${minutes}:${two(whole % 60)}`;
}

/** Returns at most `most` ticks between two times, s. */
export function timeTicks(from: number, to: number, most: number): Ticks {
  const least = (to - from) / Math.max(1, most);
  if (!(least > 20)) return ticks(from, to, most);
  const step = clockSteps.find((each) => each >= least * (1 - 1e-9)) ?? 86400 * Math.ceil(least / 86400);
  const values: number[] = [];
  for (let k = Math.ceil(from / step - 1e-9); k <= to / step + 1e-9; ++k) values.push(k === 0 ? 0 : k * step);
  return { values, step, text: clock };
}
