"""Blade ring of an impeller, 200 mm across: 12 blades, 12 splitters between them, a wavy hub, the rim.

Blades: NACA four-digit profiles [Jacobs, Ward, Pinkerton: NACA Report 460, 1933] with a blunt trailing edge, given as
one cubic spline from trailing edge around the leading edge to trailing edge. The hub's wave is of degree 5 with exact
position, tangent and curvature every 15 deg. As a job document with NURBS, and as G-code in chords of even length, the
way a CAM system without splines writes it.
"""
import cmath
import math

from .gcode import Program
from .machines import LASER, LASER_CYCLE
from .shapes import Arc, Shape, length, polar
from .splines import through
from .text import blocks, job as job_document, rounded

COUNT, STAGGER = 12, math.radians(-35)
BLADE = {"chord": 60.0, "radius": 42.0, "thickness": 0.12, "turn": 0.0}
SPLITTER = {"chord": 34.0, "radius": 66.0, "thickness": 0.14, "turn": math.radians(15 - 13.6)}
CAMBER, CAMBER_AT = 0.06, 0.4
EDGE = 1.2  # thickness of the trailing edge, mm
SPANS = 16  # per side
HUB, WAVE, HUB_SPANS = 30.0, 2.0, 24
RIM = 100.0
STEP = 0.255  # length of a chord, mm
FEED = 6000


def profile(chord, thickness):
    """Points in the blade's frame (leading edge at 0, chord along x): over the back to the front, below to the end."""

    def point(x, side):
        half = 0.2969 * math.sqrt(x) - 0.126 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4
        half = 5 * thickness * chord * half + x * EDGE / 2
        ahead = x < CAMBER_AT
        scale = CAMBER / (CAMBER_AT**2 if ahead else (1 - CAMBER_AT) ** 2)
        y = chord * scale * ((0 if ahead else 1 - 2 * CAMBER_AT) + 2 * CAMBER_AT * x - x**2)
        slope = math.atan(2 * scale * (CAMBER_AT - x))
        return complex(chord * x - side * half * math.sin(slope), y + side * half * math.cos(slope))

    stations = [(1 - math.cos(math.pi * i / SPANS)) / 2 for i in range(SPANS + 1)]
    return [point(x, 1) for x in reversed(stations)] + [point(x, -1) for x in stations[1:]]


def blade(kind, index):
    """The spline of one blade; a straight line closes its trailing edge."""
    angle = 2 * math.pi * index / COUNT + kind["turn"]
    origin, turn = cmath.rect(kind["radius"], angle), cmath.rect(1, angle + STAGGER)
    points = [origin + turn * p for p in profile(kind["chord"], kind["thickness"])]
    return through([(p.real, p.imag) for p in points])


def ring():
    return [blade(kind, i) for i in range(COUNT) for kind in (BLADE, SPLITTER)]


def hub_point(angle):
    """Position, first and second derivative by the angle of r(angle) · e^(i angle)."""
    e, waves = cmath.rect(1, angle), COUNT * angle
    r, d, dd = HUB + WAVE * math.cos(waves), -WAVE * COUNT * math.sin(waves), -WAVE * COUNT**2 * math.cos(waves)
    return [r * e, (d + 1j * r) * e, (dd + 2j * d - r) * e]


def hub():
    """Control points of the spans, 6 each, as Bezier curves of degree 5 from Hermite data."""
    h = 2 * math.pi / HUB_SPANS
    nodes = [hub_point(h * (i % HUB_SPANS)) for i in range(HUB_SPANS + 1)]
    spans = []
    for (p, p1, p2), (q, q1, q2) in zip(nodes, nodes[1:]):
        ahead = [p, p + h / 5 * p1, p + 2 * h / 5 * p1 + h * h / 20 * p2]
        back = [q - 2 * h / 5 * q1 + h * h / 20 * q2, q - h / 5 * q1, q]
        spans.append([(c.real, c.imag) for c in ahead + back])
    return spans


def rim():
    start, across = (RIM, 0.0), (-RIM, 0.0)
    return Shape(start, [Arc(across, (0.0, 0.0), True), Arc(start, (0.0, 0.0), True)])


def nurbs(degree, points, knots):
    return {"nurbs": {"degree": degree, "points": rounded(points, 6), "knots": rounded(knots, 6)}}


def job():
    parts = [[nurbs(3, b.control_points(), b.knots()), {"line": rounded(b.points[0], 6)}] for b in ring()]
    spans = hub()
    knots = [0] * 6 + [i for i in range(1, HUB_SPANS) for _ in range(5)] + [HUB_SPANS] * 6
    parts.append([nurbs(5, [spans[0][0]] + [p for span in spans for p in span[1:]], knots)])
    circle = rim()
    parts.append([{"arc": {"to": c.end, "center": c.centre, "direction": "ccw"}} for c in circle.curves])
    begins = [b.points[0] for b in ring()] + [spans[0][0], circle.start]
    sequence = []
    for begin, segments in zip(begins, parts):
        sequence.append(("position", None, [{"line": rounded(begin, 6)}]))
        sequence.append(("cut", FEED / 60, segments))
    total = sum(_measured(lambda u, b=b: b.at(u), b.u) + math.dist(b.points[0], b.points[-1]) for b in ring())
    total += sum(_measured(lambda u, s=s: _bezier(s, u), [0.0, 1.0]) for s in spans) + length(circle)
    contour = blocks((0, 0), sequence)
    return job_document("blade ring, 12 blades and 12 splitters", "blades", contour, LASER, LASER_CYCLE), total


def _bezier(points, u):
    while len(points) > 1:
        points = [tuple((1 - u) * a + u * b for a, b in zip(p, q)) for p, q in zip(points, points[1:])]
    return points[0]


def _measured(at, borders, parts=64):
    """Length between borders as chords of two widths, extrapolated (error of fourth order)."""
    total = 0.0
    for a, b in zip(borders, borders[1:]):
        points = [at(a + (b - a) * i / parts) for i in range(parts + 1)]
        fine = sum(math.dist(p, q) for p, q in zip(points, points[1:]))
        coarse = sum(math.dist(p, q) for p, q in zip(points[::2], points[2::2]))
        total += fine + (fine - coarse) / 3
    return total


def gcode():
    program = Program(["BLADE RING D200", f"CHORDS OF {STEP:g} MM"], ["G21 G17 G90 G40 G94"])
    for b in ring():
        count = math.ceil(b.u[-1] / STEP)
        _cut(program, [b.at(b.u[-1] * i / count) for i in range(count + 1)] + [b.points[0]])
    points = [polar(HUB + WAVE, 0.0)]
    for span in hub():
        count = math.ceil(math.dist(span[0], span[-1]) / STEP)
        points += [_bezier(span, i / count) for i in range(1, count + 1)]
    _cut(program, points)
    circle = rim()
    program.rapid(*circle.start)
    program.tool(True)
    program.follow(circle, feed=FEED)
    program.tool(False)
    program.word("M30")
    return program.text(), program.cut


def _cut(program, points):
    program.rapid(*points[0])
    program.tool(True)
    for point in points[1:]:
        program.line(*point, feed=FEED)
    program.tool(False)
