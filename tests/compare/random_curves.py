"""Random contours of difficult curves: handles retracted to the node, cusps, right angles, tiny and huge pieces; and the
same contour run backwards, which takes as long, for the limits of an axis do not know which way time runs."""
import copy
import math

from random_contour import decade, power_basis

METHODS = ["braking_reserve", "time_optimal", "jerk_limited"]


def moved(at, size, heading, points):
    """Points of a shape of size 1 with its start at the origin, turned, stretched, put where `at` is."""
    c, s = size * math.cos(heading), size * math.sin(heading)
    return [[at[0] + c * p[0] - s * p[1], at[1] + s * p[0] + c * p[1]]
            + [z + size * (p[2] if len(p) > 2 else 0) for z in at[2:]] for p in points]


def bezier(points, weights=None):
    degree = len(points) - 1
    nurbs = {"degree": degree, "points": points, "knots": [0] * (degree + 1) + [1] * (degree + 1)}
    if weights:
        nurbs["weights"] = weights
    return {"nurbs": nurbs}


def handles(r, degree, space):
    """Control points of a Bézier curve, some of which coincide with the node at their end."""
    pick = r.random()
    if pick < 0.12 and degree == 3:
        points = [[0, 0], [1, 0], [1, 1], [1, 1]]  # the handles make a right angle
    elif pick < 0.2:
        points = [[x, 0] for x in [0] + sorted(r.uniform(0, 1) for _ in range(degree - 1)) + [1]]
    elif pick < 0.28 and degree == 3:
        points = [[0, 0], [1, 1], [0, 1], [1, 0]]  # a cusp half-way
        points = [[x + 0.3 * y, y] for x, y in points]
    else:
        points, heading = [[0, 0]], 0
        for _ in range(degree):
            heading += r.uniform(-1.2, 1.2)
            step = r.uniform(0.2, 1)
            points.append([points[-1][0] + step * math.cos(heading), points[-1][1] + step * math.sin(heading)])
    if space:
        points = [p + [r.uniform(-0.3, 0.3) if i else 0] for i, p in enumerate(points)]
    which = r.random()
    begins = 1 if which < 0.4 else 2 if which < 0.45 and degree > 3 else 0
    ends = 1 if 0.25 < which < 0.75 else 2 if which > 0.95 and degree > 3 else 0
    for i in range(min(begins, degree - 1)):
        points[i + 1] = points[0]
    for i in range(min(ends, degree - 1 - begins)):
        points[degree - 1 - i] = points[degree]
    return points


def spline(r, degree, space):
    """A B-spline in whose inside control points coincide, as many as make its tangent vanish there, or one less."""
    points, heading = [[0, 0]], 0
    for _ in range(r.randint(degree + 1, degree + 5)):
        heading += r.uniform(-1.5, 1.5)
        points.append([points[-1][0] + 0.5 * math.cos(heading), points[-1][1] + 0.5 * math.sin(heading)])
        if space:
            points[-1].append(r.uniform(-0.2, 0.2))
    if space:
        points[0].append(0)
    inner = r.randint(1, len(points) - 2)
    points[inner:inner] = [points[inner]] * (degree - r.choice([1, 1, 2]))
    count = len(points)
    knots = [0] * (degree + 1) + sorted(r.choice([i + 1, r.uniform(0, count)]) for i in range(count - degree - 1))
    nurbs = {"degree": degree, "points": points, "knots": knots + [count] * (degree + 1)}
    if r.random() < 0.4:
        nurbs["weights"] = [r.choice([1, r.uniform(0.3, 3)]) for _ in points]
    return nurbs


def neil(r):
    """Coefficients of (t − m)^p, (t − m)^q: a cusp inside wherever p is even."""
    m, p = r.uniform(0.2, 0.8), r.choice([2, 2, 2, 3, 4])
    q = p + r.choice([1, 1, 2, 3])
    rows = []
    for power in (p, q):
        row = [math.comb(power, j) * (-m) ** (power - j) for j in range(power + 1)]
        row[0] = 0
        rows.append(row)
    return rows


def segment(r, at, size, heading):
    pick, space = r.random(), len(at) == 3
    if pick < 0.25:
        to = moved(at, size, heading, [[1, 0]])[0]
        return {"line": to}, to
    if pick < 0.4:
        side, sweep = r.choice([1, -1]), r.uniform(0.1, 5.5)
        centre, to = moved(at, size, heading, [[0, side], [math.sin(sweep), side * (1 - math.cos(sweep))]])
        return {"arc": {"to": to, "center": centre, "direction": "ccw" if side > 0 else "cw"}}, to
    if pick < 0.75:
        degree = r.choice([2, 3, 3, 3, 3, 4, 5])
        points = moved(at, size, heading, handles(r, degree, space))
        points[0] = at
        if r.random() < 0.2:  # the same as a polynomial
            rows = power_basis(points)
            return {"polynomial": {"coefficients": rows}}, [math.fsum(row) for row in rows]
        weights = [r.uniform(0.3, 3) for _ in points] if r.random() < 0.3 else None
        return bezier(points, weights), points[-1]
    if pick < 0.92:
        nurbs = spline(r, r.choice([2, 3, 3, 4, 5]), space)
        nurbs["points"] = moved(at, size, heading, nurbs["points"])
        nurbs["points"][0] = at
        return {"nurbs": nurbs}, nurbs["points"][-1]
    x, y = neil(r)
    c, s = size * math.cos(heading), size * math.sin(heading)
    length = max(len(x), len(y))
    x, y = x + [0] * (length - len(x)), y + [0] * (length - len(y))
    rows = [[c * a - s * b for a, b in zip(x, y)], [s * a + c * b for a, b in zip(x, y)]] + [[0.0] * length] * (len(at) - 2)
    for row, value in zip(rows, at):
        row[0] = value
    if len(at) == 3:
        rows[2] = [at[2], 0]
    return {"polynomial": {"coefficients": rows}}, [math.fsum(row) for row in rows]


def contour(r, dimension, count):
    at = [r.uniform(-100, 100) if r.random() < 0.7 else 0.0 for _ in range(dimension)]
    result = {"start": at, "blocks": []}
    scale = decade(r, -1, 2) if r.random() < 0.8 else decade(r, -3, 3.5)
    heading = r.uniform(-3, 3)
    while count > 0:
        segments = []
        for _ in range(min(count, r.randint(1, 3))):
            heading += r.choice([0, 0, r.uniform(-3, 3), math.pi])
            size = scale * (decade(r, -1, 0.3) if r.random() < 0.85 else decade(r, -5, -2))
            piece, at = segment(r, at, size, heading)
            segments.append(piece)
            count -= 1
        feed = None if r.random() < 0.3 else scale * decade(r, -1, 2)
        result["blocks"].append({"mode": r.choice(["cut", "cut", "position"]), "feed": feed and min(feed, 1e4), "segments": segments})
    return result, scale


def machine(r, dimension, scale):
    axes = {name: {"velocity": decade(r, 1.7, 3.3), "acceleration": decade(r, 3, 4.5)} for name in "xyz"[:dimension]}
    if r.random() < 0.5:
        axes = {name: dict(axes["x"]) for name in axes}
    for axis in axes.values():
        axis["jerk"] = axis["acceleration"] * decade(r, 1.3, 2.3)
    return {"axes": axes, "cycle_time": 0.01 if scale > 200 else 0.001}


def coarse_and_fine(axes):
    """A machine of the same coordinates: slower axes below, quicker ones of 5 mm stroke on them."""
    coarse = {n: {k: a[k] / 4 for k in ("velocity", "acceleration", "jerk") if k in a} for n, a in axes.items()}
    return {"coarse": coarse, "fine": {n: {"stroke": 5, **a} for n, a in axes.items()}}


def spec(r, method, dimension=None, count=None):
    dimension = dimension or r.choice([2, 2, 2, 3])
    shape, scale = contour(r, dimension, count or r.choice([1, 1, 2, 3, 5, 8]))
    corner = {"mode": "stop"}
    if r.random() < 0.25:
        corner = {"mode": "blend", "tolerance": max(1e-5, scale * decade(r, -4, -1.5))}
    return with_method({"contour": shape, "machine": machine(r, dimension, scale), "planning": {"corner": corner}}, method)


def with_method(spec, method):
    """Jerk is limited by one method alone."""
    spec = copy.deepcopy(spec)
    spec["planning"]["method"] = method
    for axis in spec["machine"]["axes"].values():
        if method != "jerk_limited":
            axis.pop("jerk", None)
    return spec


def turned_back(piece, begin):
    """The segment from its end to `begin`."""
    piece = copy.deepcopy(piece)
    if "line" in piece:
        piece["line"] = begin
    elif "arc" in piece:
        piece["arc"]["to"] = begin
        piece["arc"]["direction"] = "cw" if piece["arc"]["direction"] == "ccw" else "ccw"
    elif "nurbs" in piece:
        nurbs = piece["nurbs"]
        nurbs["points"].reverse()
        if "weights" in nurbs:
            nurbs["weights"].reverse()
        ends = nurbs["knots"][0] + nurbs["knots"][-1]
        nurbs["knots"] = [ends - k for k in reversed(nurbs["knots"])]
    elif "polynomial" in piece:  # in 1 − t
        piece["polynomial"]["coefficients"] = [
            [(-1) ** j * math.fsum(math.comb(k, j) * row[k] for k in range(j, len(row))) for j in range(len(row))]
            for row in piece["polynomial"]["coefficients"]]
    return piece


def end_of(piece):
    if "line" in piece:
        return piece["line"]
    if "arc" in piece:
        return piece["arc"]["to"]
    if "nurbs" in piece:
        return piece["nurbs"]["points"][-1]
    return [math.fsum(row) for row in piece["polynomial"]["coefficients"]]


def backwards(spec):
    spec = copy.deepcopy(spec)
    shape = spec["contour"]
    at, blocks = shape["start"], []
    for block in shape["blocks"]:
        segments = []
        for piece in block["segments"]:
            segments.insert(0, turned_back(piece, at))
            at = end_of(piece)
        blocks.insert(0, {**block, "segments": segments})
    shape["start"], shape["blocks"] = at, blocks
    return spec
