"""Plane curves end to end: what the writers of G-code and DXF share.

A shape is a start point and a list of curves, each of which begins where the one before ends. Points are tuples (x, y),
mm.
"""
import math
from typing import NamedTuple


class Line(NamedTuple):
    end: tuple


class Arc(NamedTuple):
    """end == start: a full circle."""

    end: tuple
    centre: tuple
    ccw: bool


class Bezier(NamedTuple):
    """Of degree 2 or 3: one or two inner control points."""

    inner: tuple
    end: tuple


class Shape(NamedTuple):
    start: tuple
    curves: list

    def pieces(self):
        """(start, curve) of every curve."""
        at = self.start
        for curve in self.curves:
            yield at, curve
            at = curve.end


def polar(radius, angle, centre=(0.0, 0.0)):
    return (centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle))


def sweep(start, arc):
    """Signed angle of an arc, rad: positive counter-clockwise; a full turn if it ends where it starts."""
    if arc.end == start:
        return 2 * math.pi if arc.ccw else -2 * math.pi
    a = math.atan2(start[1] - arc.centre[1], start[0] - arc.centre[0])
    b = math.atan2(arc.end[1] - arc.centre[1], arc.end[0] - arc.centre[0])
    turn = (b - a) % (2 * math.pi)
    return turn if arc.ccw else turn - 2 * math.pi


def simpson(f, panels=200):
    """Integral of f over [0, 1]."""
    inner = sum((4 if i % 2 else 2) * f(i / panels) for i in range(1, panels))
    return (f(0.0) + inner + f(1.0)) / (3 * panels)


def bezier_speed(controls):
    """|dh/du| of a Bezier curve, as a function of u in [0, 1]."""
    n = len(controls) - 1
    steps = [tuple(n * (b - a) for a, b in zip(p, q)) for p, q in zip(controls, controls[1:])]

    def speed(u):
        d = steps
        while len(d) > 1:
            d = [tuple((1 - u) * a + u * b for a, b in zip(p, q)) for p, q in zip(d, d[1:])]
        return math.hypot(*d[0])

    return speed


def curve_length(start, curve):
    if isinstance(curve, Line):
        return math.dist(start, curve.end)
    if isinstance(curve, Arc):
        return math.dist(start, curve.centre) * abs(sweep(start, curve))
    return simpson(bezier_speed([start, *curve.inner, curve.end]))


def length(shape):
    return sum(curve_length(start, curve) for start, curve in shape.pieces())


def circle(centre, radius, ccw=True):
    """A full circle from its rightmost point."""
    start = (centre[0] + radius, centre[1])
    return Shape(start, [Arc(start, centre, ccw)])


def slot(centre, distance, radius):
    """Two half circles `distance` apart in x, counter-clockwise from the lower line's begin."""
    (x, y), half = centre, distance / 2
    a, b, c, d = (x - half, y - radius), (x + half, y - radius), (x + half, y + radius), (x - half, y + radius)
    return Shape(a, [Line(b), Arc(c, (x + half, y), True), Line(d), Arc(a, (x - half, y), True)])


def rounded_polygon(corners):
    """Closed, from corners (x, y, radius of the rounding or 0), beginning behind the first one's rounding."""
    count = len(corners)
    roundings = [_rounding(corners[i - 1], corners[i], corners[(i + 1) % count]) for i in range(count)]
    curves = []
    for i in range(1, count + 1):
        before, arc = roundings[i % count]
        curves.append(Line(before))
        if arc:
            curves.append(arc)
    return Shape(curves[-1].end, curves)


def _rounding(previous, corner, following):
    """Where the rounding of a corner begins, and its arc."""
    (x, y, radius), point = corner, corner[:2]
    if radius == 0:
        return point, None
    back, ahead = _direction(point, previous[:2]), _direction(point, following[:2])
    inside = math.acos(back[0] * ahead[0] + back[1] * ahead[1])
    reach = radius / math.tan(inside / 2)
    begin = (x + reach * back[0], y + reach * back[1])
    end = (x + reach * ahead[0], y + reach * ahead[1])
    left = back[0] * ahead[1] - back[1] * ahead[0] < 0
    side = 1 if left else -1
    centre = (begin[0] + side * radius * back[1], begin[1] - side * radius * back[0])
    return begin, Arc(end, centre, left)


def _direction(a, b):
    distance = math.dist(a, b)
    return ((b[0] - a[0]) / distance, (b[1] - a[1]) / distance)
