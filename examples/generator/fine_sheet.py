"""A sheet 10 cm wide of small closed shapes, none larger than 9 mm: what a quick small stage on a slow gantry is for.

Rings, regular polygons, slots and free shapes (closed cardinal splines) in rows, cut back and forth, all at one feed,
with straight positioning moves between them. The same for the same seed and size.
"""
import json
import math
import pathlib
import random

from .text import rounded

SEED, SIZE, FEED = 1, 45, 400  # mm/s
COLUMNS, PITCH = 8, 12.0  # mm
SPANS = 8
MACHINE = pathlib.Path(__file__).resolve().parents[1] / "machines" / "md2.json"


def ring(cx, cy, r):
    start = (cx + r, cy)
    return start, [{"arc": {"to": start, "center": (cx, cy), "direction": "ccw"}}], 2 * math.pi * r


def polygon(cx, cy, r, corners, turn):
    at = [turn + 2 * math.pi * k / corners for k in range(corners)]
    points = [(cx + r * math.cos(a), cy + r * math.sin(a)) for a in at]
    return points[0], [{"line": p} for p in points[1:] + points[:1]], 2 * corners * r * math.sin(math.pi / corners)


def slot(cx, cy, r):
    h = r / 2
    start = (cx - h, cy - h)
    cut = [{"line": (cx + h, cy - h)},
           {"arc": {"to": (cx + h, cy + h), "center": (cx + h, cy), "direction": "ccw"}},
           {"line": (cx - h, cy + h)},
           {"arc": {"to": start, "center": (cx - h, cy), "direction": "ccw"}}]
    return start, cut, 4 * h + 2 * math.pi * h


def free(cx, cy, radii):
    """Cubic pieces through points at those radii; the tangent at each is half the chord of its neighbours."""
    n = len(radii)
    at = [2 * math.pi * k / n for k in range(n)]
    p = [(cx + r * math.cos(a), cy + r * math.sin(a)) for r, a in zip(radii, at)]
    v = [tuple((p[(k + 1) % n][d] - p[k - 1][d]) / 2 for d in (0, 1)) for k in range(n)]
    cut, length = [], 0
    for k in range(n):
        q, w = p[(k + 1) % n], v[(k + 1) % n]
        rows = [[p[k][d], v[k][d], 3 * (q[d] - p[k][d]) - 2 * v[k][d] - w[d], 2 * (p[k][d] - q[d]) + v[k][d] + w[d]] for d in (0, 1)]
        cut.append({"polynomial": {"coefficients": rows}})
        steps = 200
        for i in range(steps):
            u = (i + 0.5) / steps
            length += math.hypot(*(row[1] + u * (2 * row[2] + 3 * u * row[3]) for row in rows)) / steps
    return p[0], cut, length


def shapes(seed, size):
    """Start, segments and length of each."""
    rng = random.Random(f"fine sheet {seed}")
    for i in range(size):
        row, column = divmod(i, COLUMNS)
        column = COLUMNS - 1 - column if row % 2 else column
        cx, cy = column * PITCH + rng.uniform(-1, 1), row * PITCH + rng.uniform(-1, 1)
        kind, r = rng.choice(("ring", "polygon", "slot", "free")), rng.uniform(1, 4.5)
        if kind == "ring":
            yield ring(cx, cy, r)
        elif kind == "polygon":
            yield polygon(cx, cy, r, rng.randint(3, 8), rng.uniform(0, math.pi))
        elif kind == "slot":
            yield slot(cx, cy, r)
        else:
            yield free(cx, cy, [r * rng.uniform(0.6, 1) for _ in range(SPANS)])


def plain(value):
    """Numbers rounded, the same structure."""
    if isinstance(value, dict):
        return {key: plain(each) for key, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(each) for each in value]
    return value if isinstance(value, str) else rounded(value)


def contour(seed=SEED, size=SIZE, feed=FEED):
    blocks = []
    for start, cut, _ in shapes(seed, size):
        blocks.append({"mode": "position", "segments": [{"line": plain(start)}]})
        blocks.append({"mode": "cut", "feed": feed, "segments": plain(cut)})
    return {"start": [0, 0], "blocks": blocks}


def job():
    document = contour()
    lines = ",\n".join("        " + json.dumps(block) for block in document["blocks"])
    machine = json.dumps(json.loads(MACHINE.read_text()), indent=2).replace("\n", "\n    ")
    return (
        '{\n  "kind": "contour",\n  "name": "sheet of small shapes",\n  "reference": "fine sheet",\n'
        f'  "spec": {{\n    "contour": {{\n      "start": [0, 0],\n      "blocks": [\n{lines}\n      ]\n    }},\n'
        f'    "machine": {machine},\n'
        '    "planning": {"method": "time_optimal", "corner": {"mode": "stop"}}\n  }\n}\n'
    ), sum(length for _, _, length in shapes(SEED, SIZE))
