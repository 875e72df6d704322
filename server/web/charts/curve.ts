/** One chart: a column over the rows that are shown, its limits as lines, and in the colour of its limit where that is what holds the motion back. */
import { number } from "../base/numbers";
import type { Limit } from "../base/planned_job";
import type { ChartData } from "./chart_data";
import type { ChartColumn } from "./columns";
import { axisRange, fillIntervals, lineOfRows, type Envelope, type Scale } from "./intervals";
import type { Palette } from "../base/canvas";
import { begin } from "./picture";
import { ticks } from "./ticks";

export interface Frame {
  left: number; // px of the picture to the left of the rows
  right: number;
  first: number; // rows that are shown
  end: number;
  x: (row: number) => number; // px
  grid: number[]; // px of the vertical lines
}

export interface Drawn {
  segments: number;
  low: number; // values that the axis reaches
  high: number;
}

/** Returns what of a limit can be drawn as lines in a chart of its column: [first row, end, value]. */
export function limitLines(limit: Limit, column: ChartColumn, rows: number): [number, number, number][] {
  if (limit.column !== (column.of ?? column.name) || (limit.unit ?? "") !== column.unit) return [];
  const lines: [number, number, number][] = [];
  const add = (first: number, end: number, value: number | null, lowest: number | null | undefined): void => {
    if (value !== null) lines.push([first, end, value]);
    if (lowest === undefined && value !== null) lines.push([first, end, -value]);
    else if (lowest != null) lines.push([first, end, lowest]);
  };
  if (limit.intervals) for (const each of limit.intervals) add(each.first, each.first + each.count, each.value, each.lowest);
  else add(0, rows, limit.value, limit.lowest);
  return lines;
}

/** `closer` is what stands in place of a curve that is known of single rows alone. */
export function drawCurve(canvas: HTMLCanvasElement, column: ChartColumn, data: ChartData, limits: readonly Limit[], colours: Map<number, string>,
                          palette: Palette, frame: Frame, rows: number, closer: string): Drawn | null {
  const picture = begin(canvas);
  if (!picture) return null;
  const { context, width, height, snap } = picture, parts = data.parts(column.name, frame.first, frame.end);
  let low = Infinity, high = -Infinity;
  for (const part of parts) {
    const range = part.envelope.range(column.name, part.from, part.to);
    if (range) [low, high] = [Math.min(low, range[0]), Math.max(high, range[1])];
  }
  if (column.quantity === "use") [low, high] = [0, Math.max(1, high)];
  const own = limits.filter((limit) => limit.column === (column.of ?? column.name) && (!column.of || limit.unit === column.unit));
  const lines = own.flatMap((limit) => limitLines(limit, column, rows).map((line) => ({ line, limit }))).filter(({ line }) => line[1] > frame.first && line[0] < frame.end);
  const size = Math.max(Math.abs(low), Math.abs(high)), [least, most] = [low, high];
  for (const { line } of lines) {
    const value = line[2];
    // A limit of a side on which nothing happens would flatten the curve.
    if (Math.abs(value) > 1.6 * size || (value < 0 && least >= 0) || (value > 0 && most <= 0)) continue;
    [low, high] = [Math.min(low, value), Math.max(high, value)];
  }
  if (column.of && !(low <= high)) {
    context.font = "12px system-ui, sans-serif";
    context.fillStyle = palette.of("--soft");
    context.fillText(closer, frame.left + 6, height / 2);
    return { segments: 0, low, high };
  }
  const [from, to] = axisRange(low, high);
  const scale: Scale = { x: frame.x, y: (value) => height - 1 - ((value - from) / (to - from)) * (height - 2) };
  const right = width - frame.right, bars: Scale = { x: (row) => snap(frame.x(row)), y: scale.y };

  context.lineWidth = 1;
  context.fillStyle = palette.of("--line");
  for (const x of frame.grid) context.fillRect(Math.round(x), 0, 1, height);
  const vertical = ticks(from, to, Math.max(3, height / 18));
  context.font = "11px system-ui, sans-serif";
  context.textAlign = "right";
  context.textBaseline = "middle";
  for (const value of vertical.values) {
    const y = scale.y(value);
    context.fillStyle = palette.of("--line");
    context.fillRect(frame.left, Math.round(y), right - frame.left, 1);
    if (y < 5 || y > height - 5) continue;
    context.fillStyle = palette.of("--soft");
    context.fillText(column.quantity === "use" ? number(value * 100) : vertical.text(value), frame.left - 5, y);
  }

  context.save();
  context.beginPath();
  context.rect(frame.left, 0, right - frame.left, height);
  context.clip();
  const neutral = palette.of("--curve"), ids = new Set(own.map((limit) => limit.id));
  const colourOf = (envelope: Envelope, interval: number): string => {
    if (!envelope.has("limit")) return neutral;
    const id = envelope.most(interval, "limit");
    return column.quantity === "use" || ids.has(id) ? palette.of(colours.get(id) ?? "--curve") : neutral;
  };
  let segments = 0;
  for (const { envelope, from: a, to: b } of parts) {
    const wide = envelope.exact && (scale.x(b) - scale.x(a)) / Math.max(1, b - a) > 1.5;
    segments += wide ? drawLine(context, envelope, column.name, a, b, scale, colourOf)
                     : fillIntervals(envelope, column.name, a, b, bars, 1.5, (x, y, w, h) => context.fillRect(x, y, w, h),
                                     (interval) => (context.fillStyle = colourOf(envelope, interval)));
  }
  context.setLineDash([5, 3]);
  for (const { line, limit } of lines) {
    const y = scale.y(line[2]);
    context.strokeStyle = palette.of(colours.get(limit.id) ?? "--soft");
    context.beginPath();
    context.moveTo(Math.max(frame.left, frame.x(line[0])), y);
    context.lineTo(Math.min(right, frame.x(line[1])), y);
    context.stroke();
    ++segments;
  }
  context.restore();
  return { segments, low: least, high: most };
}

function drawLine(context: CanvasRenderingContext2D, envelope: Envelope, column: string, from: number, to: number, scale: Scale,
                  colourOf: (envelope: Envelope, interval: number) => string): number {
  const apart = scale.x(from + 1) - scale.x(from) > 7;
  let before: { x: number; y: number; colour: string } | null = null;
  context.lineWidth = 1.75;
  context.lineJoin = "round";
  const segments = lineOfRows(envelope, column, from, to, scale, (x, y, interval) => {
    const colour = colourOf(envelope, interval);
    if (before && before.colour === colour) context.lineTo(x, y);
    else {
      if (before) {
        context.lineTo(x, y);
        context.stroke();
      }
      context.strokeStyle = colour;
      context.beginPath();
      context.moveTo(x, y);
    }
    if (apart) {
      context.fillStyle = colour;
      context.fillRect(x - 2, y - 2, 4, 4);
    }
    before = { x, y, colour };
  });
  context.stroke();
  context.lineWidth = 1;
  return segments;
}
