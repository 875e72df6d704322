"""Floor of a freeform pocket, 80 x 50 mm, finished in 25 passes: polynomials in space.

The floor is z = −8 + 5 X² + 3 Y² + 1.5 X³ Y with X = x/40 mm, Y = y/25 mm. A pass along x is a polynomial of degree 3;
the turns between passes are of degree 5 with the passes' position, tangent and curvature at their ends. A helix of two
turns leads in, a curve of degree 5 leads from it into the first pass.
"""
import math

from .machines import MILL, MILL_CYCLE
from .text import blocks, job as job_document, rounded

WIDTH, HEIGHT = 40.0, 25.0
REACH, FIRST, STEP, PASSES = 32.0, -18.0, 1.5, 25
TURN = 4.0  # size of the turns' tangents, mm
HELIX_RADIUS, HELIX_PITCH, HELIX_TURNS = 3.0, 2.0, 2
FEED = 90


def pass_rows(y, forward):
    """Power basis on u ∈ [0, 1] of the pass at y."""
    begin, run = (-REACH, 2 * REACH) if forward else (REACH, -2 * REACH)
    a, b, v = begin / WIDTH, run / WIDTH, y / HEIGHT
    z = [
        -8 + 5 * a**2 + 3 * v**2 + 1.5 * a**3 * v,
        10 * a * b + 4.5 * a**2 * b * v,
        5 * b**2 + 4.5 * a * b**2 * v,
        1.5 * b**3 * v,
    ]
    return [[begin, run, 0.0, 0.0], [y, 0.0, 0.0, 0.0], z]


def jet(rows, u):
    """Value, first and second derivative at u."""
    values = []
    for order in range(3):
        terms = [[math.perm(k, order) * c * u ** (k - order) for k, c in enumerate(row) if k >= order] for row in rows]
        values.append(tuple(sum(each) for each in terms))
    return values


def slowed(state, speed):
    """The same curve over another parameter: first derivative of the given length."""
    p, d, dd = state
    f = speed / math.hypot(*d)
    return p, tuple(f * a for a in d), tuple(f * f * a for a in dd)


def hermite(begin, end):
    """Degree 5 with given value, first and second derivative at both ends, power basis."""
    rows = []
    for p, d, dd, q, e, ee in zip(*begin, *end):
        gap, slope, bend = q - p - d - dd / 2, e - d - dd, ee - dd
        high = [10 * gap - 4 * slope + bend / 2, -15 * gap + 7 * slope - bend, 6 * gap - 3 * slope + bend / 2]
        rows.append([p, d, dd / 2, *high])
    return rows


def passes_and_turns():
    curves = []
    for i in range(PASSES):
        rows = pass_rows(FIRST + i * STEP, i % 2 == 0)
        if curves:
            curves.append(hermite(slowed(jet(curves[-1], 1.0), TURN), slowed(jet(rows, 0.0), TURN)))
        curves.append(rows)
    return curves


def helix():
    """Start, arcs and the state at the end: a helix down, that ends below its start with the tangent in +x."""
    x, y, z = -REACH - 8.0, FIRST, pass_rows(FIRST, True)[2][0] + 1.0
    start = (x, y, z + HELIX_PITCH * HELIX_TURNS)
    arcs = []
    for i in reversed(range(HELIX_TURNS)):
        level = z + HELIX_PITCH * i
        arcs.append(((x, y, level), (x, y + HELIX_RADIUS, level + HELIX_PITCH)))
    around, fall = HELIX_RADIUS, -HELIX_PITCH / (2 * math.pi)  # derivatives by the angle
    return start, arcs, ((x, y, z), (around, 0.0, fall), (0.0, HELIX_RADIUS, 0.0))


def polynomial(rows):
    kept = [row[: max([2] + [k + 1 for k, c in enumerate(row) if c != 0])] for row in rounded(rows)]
    return {"polynomial": {"coefficients": kept}}


def length(rows, panels=400):
    def speed(u):
        return math.hypot(*jet(rows, u)[1])

    inner = sum((4 if i % 2 else 2) * speed(i / panels) for i in range(1, panels))
    return (speed(0.0) + inner + speed(1.0)) / (3 * panels)


def job():
    start, arcs, state = helix()
    curves = passes_and_turns()
    curves.insert(0, hermite(slowed(state, 6.0), slowed(jet(curves[0], 0.0), 6.0)))
    segments = [{"arc": {"to": rounded(to), "center": rounded(centre), "direction": "ccw"}} for to, centre in arcs]
    segments += [polynomial(rows) for rows in curves]
    last = tuple(sum(row) for row in curves[-1])
    sequence = [
        ("position", None, [{"line": rounded(start)}]),
        ("cut", FEED, segments),
        ("position", None, [{"line": rounded((last[0], last[1], 20.0))}]),
    ]
    total = HELIX_TURNS * math.hypot(2 * math.pi * HELIX_RADIUS, HELIX_PITCH) + sum(length(rows) for rows in curves)
    contour = blocks((*start[:2], 20.0), sequence)
    return job_document("freeform pocket floor, 25 passes", "pocket", contour, MILL, MILL_CYCLE), total
