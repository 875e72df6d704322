/** What moves above the picture of a path: the cursor, the axes, the scale bar. */
import { number } from "../base/numbers";
import { at, niceLength, type Projection, type Size } from "./projection";

export interface Mark {
  place: [number, number, number];
  shape: "tool" | "coarse";
}

export interface LayerColours {
  text: string;
  back: string;
  cursor: string;
  coarse: string;
}

/** Draws a horizontal bar of a round length with its length. */
export function drawScaleBar(pen: CanvasRenderingContext2D, scale: number, size: Size, colours: LayerColours): void {
  const length = niceLength(Math.min(160, size.width / 4) / scale), width = length * scale, x = 12, y = size.height - 12;
  pen.font = "12px system-ui, sans-serif";
  pen.textAlign = "left";
  pen.textBaseline = "alphabetic";
  const text = length >= 1 || length < 1e-3 ? `${number(length)} mm` : `${number(length * 1000)} µm`;
  for (const [colour, thick] of [[colours.back, 5], [colours.text, 1.5]] as const) {
    pen.strokeStyle = colour;
    pen.lineWidth = thick;
    pen.beginPath();
    pen.moveTo(x, y - 5);
    pen.lineTo(x, y);
    pen.lineTo(x + width, y);
    pen.lineTo(x + width, y - 5);
    pen.stroke();
  }
  pen.strokeStyle = colours.back;
  pen.lineWidth = 4;
  pen.strokeText(text, x + 4, y - 8);
  pen.fillStyle = colours.text;
  pen.fillText(text, x + 4, y - 8);
}

/** Draws the directions of the axes in the upper left corner. */
export function drawAxes(pen: CanvasRenderingContext2D, matrix: readonly number[], scale: number, dimension: number, colours: LayerColours): void {
  const x0 = 40, y0 = 46, long = 24;
  pen.font = "12px system-ui, sans-serif";
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  ["x", "y", "z"].slice(0, dimension).forEach((name, k) => {
    const dx = (matrix[k]! / scale) * long, dy = (matrix[4 + k]! / scale) * long;
    if (Math.hypot(dx, dy) < 5) return;
    pen.strokeStyle = colours.text;
    pen.lineWidth = 1.25;
    pen.beginPath();
    pen.moveTo(x0, y0);
    pen.lineTo(x0 + dx, y0 + dy);
    pen.stroke();
    pen.fillStyle = colours.text;
    pen.fillText(name, x0 + dx * 1.4, y0 + dy * 1.4);
  });
}

/** Draws marks: a ring with a cross for the tool, a square for the coarse axes, a line between the two. `window`: the fine stage's stroke to each side, mm. */
export function drawMarks(
  pen: CanvasRenderingContext2D, projection: Projection, marks: readonly Mark[], colours: LayerColours, locked: boolean, window: readonly [number, number] | null = null,
): void {
  const matrix = projection.matrix();
  const places = marks.map((mark) => at(matrix, ...mark.place));
  const twice = (draw: () => void, colour: string): void => {
    pen.lineWidth = 5;
    pen.strokeStyle = colours.back;
    draw();
    pen.lineWidth = 2;
    pen.strokeStyle = colour;
    draw();
  };
  if (places.length > 1)
    twice(() => {
      pen.beginPath();
      places.forEach(([x, y], i) => (i === 0 ? pen.moveTo(x, y) : pen.lineTo(x, y)));
      pen.stroke();
    }, colours.coarse);
  marks.forEach((mark, i) => {
    const [x, y] = places[i]!;
    if (mark.shape === "coarse") {
      twice(() => pen.strokeRect(x - 6, y - 6, 12, 12), colours.coarse);
      if (window) {
        const wide = window[0] * projection.scale, tall = window[1] * projection.scale;
        pen.lineWidth = 1.25;
        pen.setLineDash([5, 4]);
        pen.strokeRect(x - wide, y - tall, 2 * wide, 2 * tall);
        pen.setLineDash([]);
      }
      return;
    }
    twice(() => {
      pen.beginPath();
      pen.arc(x, y, 7, 0, 2 * Math.PI);
      for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]] as const) {
        pen.moveTo(x + 7 * dx, y + 7 * dy);
        pen.lineTo(x + 13 * dx, y + 13 * dy);
      }
      pen.stroke();
    }, colours.cursor);
    if (locked) {
      pen.fillStyle = colours.cursor;
      pen.beginPath();
      pen.arc(x, y, 3, 0, 2 * Math.PI);
      pen.fill();
    }
  });
}
