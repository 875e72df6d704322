/** Draws a path onto a canvas in the plane or, where there is no WebGL, in space. */
import { isRapid, type Colouring } from "./colours";
import type { PathData } from "./path_data";
import { at, type Size } from "./projection";

export interface Shown {
  rapids: boolean;
  first: number; // rows that are emphasised: those that the curves show
  end: number;
}

/** Returns whether the chord to a vertex is drawn. */
export const isShown = (path: PathData, i: number, shown: Shown): boolean => i > 0 && !path.begin[i] && (shown.rapids || !isRapid(path, i));

/** Returns whether the chord to a vertex belongs to the rows that are emphasised. */
export const isEmphasised = (path: PathData, i: number, shown: Shown): boolean => path.rows[i]! > shown.first && path.rows[i - 1]! < shown.end;

const cutWidth = 1.75, rapidWidth = 1; // CSS pixels

/** Chords of a picture, by the number of their colour: sx0, sy0, sx1, sy1 of each. Those outside of the picture are left out. */
export function chordsByColour(path: PathData, matrix: readonly number[], size: Size, colouring: Colouring, shown: Shown): { drawn: number[][]; faint: number[] } {
  const drawn: number[][] = colouring.colours.map(() => []), faint: number[] = [];
  let x0 = 0, y0 = 0;
  for (let i = 0; i < path.count; ++i) {
    const [x1, y1] = at(matrix, path.x[i]!, path.y[i]!, path.z[i]!);
    const outside = (x0 < -4 && x1 < -4) || (y0 < -4 && y1 < -4) || (x0 > size.width + 4 && x1 > size.width + 4) || (y0 > size.height + 4 && y1 > size.height + 4);
    if (!outside && isShown(path, i, shown)) (isEmphasised(path, i, shown) ? drawn[colouring.kind[i]!]! : faint).push(x0, y0, x1, y1);
    x0 = x1;
    y0 = y1;
  }
  return { drawn, faint };
}

function stroke(pen: CanvasRenderingContext2D, chords: readonly number[], colour: string, width: number): void {
  if (chords.length === 0) return;
  pen.strokeStyle = colour;
  pen.lineWidth = width;
  pen.beginPath();
  let x = NaN, y = NaN;
  for (let i = 0; i < chords.length; i += 4) {
    if (chords[i] !== x || chords[i + 1] !== y) pen.moveTo(chords[i]!, chords[i + 1]!);
    pen.lineTo((x = chords[i + 2]!), (y = chords[i + 3]!));
  }
  pen.stroke();
}

/** Draws the path; the pen's unit is the CSS pixel. Returns the number of chords drawn. */
export function drawPath(
  pen: CanvasRenderingContext2D, path: PathData, matrix: readonly number[], size: Size, colouring: Colouring, shown: Shown, faintColour: string,
): number {
  const { drawn, faint } = chordsByColour(path, matrix, size, colouring, shown);
  pen.lineCap = "round";
  pen.lineJoin = "round";
  stroke(pen, faint, faintColour, rapidWidth);
  let count = faint.length / 4;
  drawn.forEach((chords, kind) => {
    stroke(pen, chords, colouring.colours[kind]!, kind === 0 ? rapidWidth : cutWidth);
    count += chords.length / 4;
  });
  return count;
}
