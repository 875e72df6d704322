"""Cubic splines with continuous curvature through given points, and their B-spline form.

[de Boor: A Practical Guide to Splines, chapter IV; Piegl, Tiller: The NURBS Book, section 9.2]
"""
import math
from typing import NamedTuple


class Spline(NamedTuple):
    """Knots u_i, points there and slopes there (by u), in any dimension."""

    u: list
    points: list
    slopes: list

    def bezier(self, i):
        """Control points of span i."""
        h, p, q = self.u[i + 1] - self.u[i], self.points[i], self.points[i + 1]
        m, n = self.slopes[i], self.slopes[i + 1]
        return [
            p,
            tuple(a + h * b / 3 for a, b in zip(p, m)),
            tuple(a - h * b / 3 for a, b in zip(q, n)),
            q,
        ]

    def at(self, u):
        i = max(0, min(len(self.u) - 2, next((k for k, v in enumerate(self.u) if v > u), len(self.u)) - 1))
        t = (u - self.u[i]) / (self.u[i + 1] - self.u[i])
        d = self.bezier(i)
        while len(d) > 1:
            d = [tuple((1 - t) * a + t * b for a, b in zip(p, q)) for p, q in zip(d, d[1:])]
        return d[0]

    def control_points(self):
        """The points + 2 control points of the clamped cubic B-spline over knots()."""
        u, spans = self.u, len(self.u) - 1
        controls = [self.points[0], self.bezier(0)[1]]
        for i in range(1, spans):
            _, b, c, _ = self.bezier(i)
            h, back = u[i + 1] - u[i], u[i] - u[i - 1]
            controls.append(tuple((p * (h + back) - q * back) / h for p, q in zip(b, c)))
        return controls + [self.bezier(spans - 1)[2], self.points[-1]]

    def knots(self):
        return [self.u[0]] * 3 + list(self.u) + [self.u[-1]] * 3


def through(points, start=None, end=None):
    """Over the length of the chords; ends with the given unit tangents, or straight (natural)."""
    u = [0.0]
    for p, q in zip(points, points[1:]):
        u.append(u[-1] + math.dist(p, q))
    columns = [_slopes(u, [p[k] for p in points], start and start[k], end and end[k]) for k in range(len(points[0]))]
    return Spline(u, list(points), list(zip(*columns)))


def _slopes(u, x, start, end):
    """Thomas' algorithm on the conditions for a continuous second derivative, one coordinate."""
    n = len(u) - 1
    h = [b - a for a, b in zip(u, u[1:])]
    rise = [(b - a) / each for a, b, each in zip(x, x[1:], h)]
    below, at, above, right = [0.0] * (n + 1), [1.0] * (n + 1), [0.0] * (n + 1), [0.0] * (n + 1)
    at[0], above[0], right[0] = (2.0, 1.0, 3 * rise[0]) if start is None else (1.0, 0.0, start)
    at[n], below[n], right[n] = (2.0, 1.0, 3 * rise[-1]) if end is None else (1.0, 0.0, end)
    for i in range(1, n):
        below[i], at[i], above[i] = h[i], 2 * (h[i - 1] + h[i]), h[i - 1]
        right[i] = 3 * (h[i] * rise[i - 1] + h[i - 1] * rise[i])
    for i in range(1, n + 1):
        factor = below[i] / at[i - 1]
        at[i] -= factor * above[i - 1]
        right[i] -= factor * right[i - 1]
    slopes = [right[n] / at[n]]
    for i in reversed(range(n)):
        slopes.append((right[i] - above[i] * slopes[-1]) / at[i])
    return slopes[::-1]
