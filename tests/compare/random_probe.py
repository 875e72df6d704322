"""Random specs of kind probe_path: points of curves in the plane and in space, polygons, dense and uneven rows, every method."""
import math

from random_contour import decade


def walk(r, dimension, count, size):
    """A polygon that turns by any angle."""
    at, heading, points = [0.0] * dimension, r.uniform(-math.pi, math.pi), []
    for _ in range(count):
        points.append(list(at))
        heading += r.choice([r.gauss(0, 0.5), r.uniform(-2.5, 2.5)])
        step = size * decade(r, -0.7, 0.3)
        at[0] += step * math.cos(heading)
        at[1] += step * math.sin(heading)
        if dimension == 3:
            at[2] += step * r.uniform(-0.5, 0.5)
    return points


def curve(r, dimension, count, size):
    """Points of an ellipse with a wave on it, evenly spaced in its angle or not, measured with a small error."""
    a, b, lobes, wave = size * count / 6, size * count / 6 * r.uniform(0.3, 1), r.randint(2, 5), r.uniform(0, 0.1)
    end, error = r.uniform(0.3, 1) * 2 * math.pi, size * r.choice([0, 1e-4, 1e-3])
    turns = sorted(r.uniform(0, end) for _ in range(count)) if r.random() < 0.3 else [end * k / (count - 1) for k in range(count)]
    points = []
    for angle in turns:
        out = 1 + wave * math.sin(lobes * angle)
        point = [a * out * math.cos(angle), b * out * math.sin(angle)] + [size * angle * 0.2] * (dimension - 2)
        points.append([x + r.gauss(0, error) if error else x for x in point])
    return points


def row(r, dimension, count, size):
    """Points of a straight line, with a step aside somewhere."""
    aside = r.randint(1, count - 1)
    return [[k * size, r.choice([0, 0.5]) * size if k >= aside else 0.0] + [0.0] * (dimension - 2) for k in range(count)]


def spec(r):
    dimension, size = r.choice([2, 2, 3]), decade(r, -0.5, 1.5)
    count = r.choice([2, 3, r.randint(4, 12), r.randint(4, 12), r.randint(12, 60)])
    shape = r.choice([walk, walk, curve, row])
    limits = {}
    for axis in "xyz"[:dimension]:
        acceleration = decade(r, 1.5, 3.5)
        jerk = acceleration * decade(r, 0.8, 1.8)
        limits[axis] = {"acceleration": acceleration, "jerk": jerk, "snap": jerk * decade(r, 1, 2)}
    method = r.choice(["optimal", "optimal", "arcs", "spline"])
    made = {"points": shape(r, dimension, count, size), "tolerance": size * r.choice([0, 0.01, r.uniform(0.01, 0.2)]),
            "speed": size * decade(r, -0.5, 1), "limits": limits, "method": method, "cycle_time": r.choice([0.001, 0.002])}
    if method == "optimal" and r.random() < 0.3:
        made.update(objective="ripple", stretch=r.uniform(1, 1.5))
    return made
