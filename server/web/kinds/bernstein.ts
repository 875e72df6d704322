/** Polynomials in Bernstein form, as pieces of laws come. */
export interface Piece {
  begin: number; // where the local parameter is 0, in the master's unit
  end: number; // where it is 1
  bernstein: number[];
}

/** Returns the coefficients of a derivative by the local parameter. */
export function derivative(bernstein: number[], order: number): number[] {
  let list = bernstein;
  for (let r = 0; r < order; ++r) {
    const degree = list.length - 1;
    list = degree === 0 ? [0] : list.slice(1).map((each, k) => degree * (each - list[k]!));
  }
  return list;
}

/** Returns the value at a local parameter by de Casteljau's algorithm. */
export function bernsteinValue(bernstein: number[], x: number): number {
  const list = [...bernstein];
  for (let count = list.length - 1; count > 0; --count) for (let k = 0; k < count; ++k) list[k] = (1 - x) * list[k]! + x * list[k + 1]!;
  return list[0]!;
}

/** Returns a derivative by time along all pieces, as points of a line; `rate`: the master's units per second. */
export function lawLine(pieces: Piece[], order: number, rate: number, perPiece: number): { x: number[]; low: number[] } {
  const x: number[] = [], low: number[] = [];
  for (const { begin, end, bernstein } of pieces) {
    const list = derivative(bernstein, order), scale = Math.pow(rate / (end - begin), order);
    for (let k = 0; k <= perPiece; ++k) {
      x.push(begin + ((end - begin) * k) / perPiece);
      low.push(scale * bernsteinValue(list, k / perPiece));
    }
  }
  return { x, low };
}
