/** Polynomial B-splines in the plane, as a cam's curves come. */
export interface BSpline {
  degree: number;
  points: number[][]; // [x, y]
  knots: number[];
}

/** Returns a point of a spline by de Boor's algorithm [de Boor 1972]; outside of its knots that of the nearer end. */
export function splinePoint({ degree, points, knots }: BSpline, parameter: number): [number, number] {
  const least = knots[degree]!, most = knots[points.length]!, u = Math.min(most, Math.max(least, parameter));
  let low = degree, high = points.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (knots[middle]! <= u) low = middle;
    else high = middle - 1;
  }
  const x: number[] = [], y: number[] = [];
  for (let j = 0; j <= degree; ++j) {
    x.push(points[low - degree + j]![0]!);
    y.push(points[low - degree + j]![1]!);
  }
  for (let r = 1; r <= degree; ++r)
    for (let j = degree; j >= r; --j) {
      const i = low - degree + j, from = knots[i]!, to = knots[i + degree - r + 1]!;
      const share = to > from ? (u - from) / (to - from) : 0;
      x[j] = x[j - 1]! + share * (x[j]! - x[j - 1]!);
      y[j] = y[j - 1]! + share * (y[j]! - y[j - 1]!);
    }
  return [x[degree]!, y[degree]!];
}

/** Returns a polyline along a spline with `count` steps of its parameter. */
export function splineLine(spline: BSpline, count: number): [number, number][] {
  const from = spline.knots[spline.degree]!, to = spline.knots[spline.points.length]!;
  return Array.from({ length: count + 1 }, (_, k) => splinePoint(spline, from + ((to - from) * k) / count));
}
