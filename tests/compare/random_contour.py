"""Random specs of kind contour: every form of geometry, 2 and 3 axes, every planning method, every treatment of corners."""
import math


def decade(r, low, high):
    return 10 ** r.uniform(low, high)


def ahead(at, size, heading):
    return [at[0] + size * math.cos(heading), at[1] + size * math.sin(heading)] + at[2:]


def turned(p, centre, angle):
    c, s, x, y = math.cos(angle), math.sin(angle), p[0] - centre[0], p[1] - centre[1]
    return [centre[0] + c * x - s * y, centre[1] + s * x + c * y] + p[2:]


def climbed(r, p, size):
    return p[:2] + [p[2] + r.uniform(-0.3, 0.3) * size] if len(p) == 3 else p


def control_points(r, at, size, heading, count):
    points = [at]
    for _ in range(count - 1):
        points.append(climbed(r, ahead(points[-1], r.uniform(0.3, 1) * size, heading), size))
        heading += r.uniform(-1, 1)
    return points, math.atan2(points[-1][1] - points[-2][1], points[-1][0] - points[-2][0])


def power_basis(points):
    """Rows of coefficients of a Bézier curve."""
    n = len(points) - 1
    return [[math.comb(n, j) * sum((-1) ** (i + j) * math.comb(j, i) * points[i][d] for i in range(j + 1))
             for j in range(n + 1)] for d in range(len(points[0]))]


def segment(r, at, size, heading):
    """A segment, where it ends and which way."""
    pick = r.random()
    if pick < 0.35:
        to = climbed(r, ahead(at, size, heading), size)
        return {"line": to}, to, heading
    if pick < 0.65:
        side = r.choice([1, -1])
        sweep = side * (2 * math.pi if r.random() < 0.1 else r.uniform(0.1, 5.5))
        centre = ahead(at, size, heading + side * math.pi / 2)
        to = climbed(r, at if abs(sweep) > 6 else turned(at, centre, sweep), size)
        return {"arc": {"to": to, "center": centre, "direction": "ccw" if side > 0 else "cw"}}, to, heading + sweep
    if pick < 0.82:
        points, end = control_points(r, at, size, heading, r.randint(3, 5))
        rows = power_basis(points)
        return {"polynomial": {"coefficients": rows}}, [math.fsum(row) for row in rows], end
    count = r.randint(4, 8)
    points, end = control_points(r, at, size, heading, count)
    inner = sorted(r.uniform(0.05, 0.95) for _ in range(count - 4))
    nurbs = {"degree": 3, "points": points, "knots": [0] * 4 + inner + [1] * 4}
    if r.random() < 0.5:
        nurbs["weights"] = [1 if r.random() < 0.5 else r.uniform(0.3, 3) for _ in points]
    return {"nurbs": nurbs}, points[-1], end


def kink(r):
    """Change of direction: most joints are tangential, some nearly, some reverse."""
    pick = r.random()
    if pick < 0.3:
        return r.uniform(-3, 3)
    if pick < 0.4:
        return r.uniform(-2e-3, 2e-3)
    return math.pi if pick < 0.43 else 0


def feed(r):
    return None if r.random() < 0.4 else decade(r, 0.7, 3)


def blocks(r, dimension, count):
    at = [r.uniform(-100, 100) for _ in range(2)] + [r.uniform(-5, 5)] * (dimension - 2)
    contour = {"start": at, "blocks": []}
    heading, scale = r.uniform(-3, 3), decade(r, -0.5, 1.7)
    while count > 0:
        segments = []
        for _ in range(min(count, r.randint(1, 5))):
            heading += kink(r)
            size = scale * decade(r, -1, 0.3) if r.random() < 0.95 else decade(r, -3, -2)
            piece, at, heading = segment(r, at, size, heading)
            segments.append(piece)
            count -= 1
            if r.random() < 0.07:
                segments.append({"dwell": r.choice([0, r.uniform(0.001, 0.3)])})
        contour["blocks"].append({"mode": r.choice(["cut", "cut", "position"]), "feed": feed(r), "segments": segments})
    return contour


def polyline(r, dimension, count):
    """Half of them follow a curve in short chords, as programs of freeform shapes do."""
    size = decade(r, 0, 1.7)
    if r.random() < 0.5:
        phase, lobes = r.uniform(0, 6), r.randint(2, 5)
        at = [2 * math.pi * k / count for k in range(count)]
        points = [[round(size * (1 + 0.2 * math.sin(lobes * w + phase)) * f(w), 3) for f in (math.cos, math.sin)]
                  + [round(size * 0.1 * math.sin(w), 3)] * (dimension - 2) for w in at]
    else:
        points = [[round(r.uniform(-size, size), 3) for _ in range(dimension)] for _ in range(count // 3 + 2)]
    return {"points": points, "closed": r.random() < 0.5, "feed": feed(r)}


def program(r, dimension, count):
    """A part program with words G0 to G4, M3, M5, F, in millimetres."""
    x, y, z = 0.0, 0.0, 0.0
    scale, heading, cutting = decade(r, 0, 1.5), 0.0, False
    lines = ["G21 G90 G17", f"F{r.uniform(500, 20000):.1f}"]
    for _ in range(count):
        if r.random() < 0.15:
            cutting = not cutting
            lines.append("M3" if cutting else "M5")
        if r.random() < 0.05:
            lines.append(f"G4 P{r.uniform(0.01, 0.2):.3f}")
        if r.random() < 0.1:
            lines.append(f"F{decade(r, 2, 4.3):.1f}")
        heading += kink(r)
        size = scale * decade(r, -1, 0)
        if cutting and r.random() < 0.4:
            side, sweep = r.choice([1, -1]), r.uniform(0.3, 4)
            cx, cy = (round(v, 4) for v in ahead([x, y], size, heading + side * math.pi / 2))
            tx, ty = turned([x, y], [cx, cy], side * sweep)
            lines.append(f"G{3 if side > 0 else 2} X{tx:.4f} Y{ty:.4f} I{cx - x:.4f} J{cy - y:.4f}")
            heading += side * sweep
        else:
            tx, ty = ahead([x, y], size, heading)
            rise = ""
            if dimension == 3 and r.random() < 0.3:
                z = round(z + r.uniform(-0.5, 0.5) * size, 4)
                rise = f" Z{z:.4f}"
            lines.append(f"G{1 if cutting else 0} X{tx:.4f} Y{ty:.4f}{rise}")
        x, y = round(tx, 4), round(ty, 4)
    return {"gcode": "\n".join(lines + ["M2", ""]), "feed": feed(r)}


def drawing(r, count):
    """Lines, arcs and circles as entities of a DXF file."""
    text = ["0", "SECTION", "2", "ENTITIES"]

    def entity(name, *groups):
        text.extend(["0", name, "8", "0"])
        for code, value in groups:
            text.extend([str(code), f"{value:.4f}"])

    x, y = 0.0, 0.0
    for _ in range(count):
        size = decade(r, 0, 1.5)
        pick = r.random()
        if pick < 0.6:
            to = ahead([x, y], size, r.uniform(-3, 3))
            entity("LINE", (10, x), (20, y), (11, to[0]), (21, to[1]))
            x, y = to
        elif pick < 0.8:
            entity("CIRCLE", (10, r.uniform(-50, 50)), (20, r.uniform(-50, 50)), (40, size))
        else:
            entity("ARC", (10, x), (20, y), (40, size), (50, r.uniform(0, 360)), (51, r.uniform(0, 360)))
    return {"dxf": "\n".join(text + ["0", "ENDSEC", "0", "EOF", ""]), "unit": 1,
            "order": r.choice(["as_drawn", "nearest"]), "feed": feed(r)}


def planning(r, method):
    options = {"method": method, "mode_change": r.choice(["pass", "pass", "stop"])}
    if method == "braking_reserve" and r.random() < 0.5:
        options["braking_reserve"] = r.uniform(0.3, 1)
    corner = {"mode": r.choice(["stop", "blend", "blend"])}
    if corner["mode"] == "blend":
        corner["tolerance"] = decade(r, -2.5, -0.5)
    if r.random() < 0.3:
        corner["angle"] = r.choice([0, 0.5, 5, 20])
    options["corner"] = corner
    if method == "jerk_limited" and r.random() < 0.3:
        limits = {"velocity": decade(r, 1.5, 3), "acceleration": decade(r, 3, 4), "jerk": decade(r, 5, 6)}
        options["path"] = {name: value for name, value in limits.items() if r.random() < 0.6}
    return options


def machine(r, dimension, jerk):
    axes = {name: {"velocity": decade(r, 1.7, 3.3), "acceleration": decade(r, 3, 4.5)} for name in "xyz"[:dimension]}
    if r.random() < 0.4:
        axes = {name: dict(axes["x"]) for name in axes}
    if jerk:
        for axis in axes.values():
            axis["jerk"] = axis["acceleration"] * decade(r, 1.3, 2.3)
    return {"axes": axes, "cycle_time": r.choice([0.001, 0.002, 0.0007])}


def spec(r):
    method = r.choice(["braking_reserve", "time_optimal", "jerk_limited"])
    dimension = r.choice([2, 2, 3])
    form = r.choice(["blocks", "blocks", "blocks", "points", "gcode", "dxf"])
    count = r.randint(3, 20)
    if form == "blocks":
        contour = blocks(r, dimension, count)
    elif form == "points":
        contour = polyline(r, dimension, 4 * count)
    elif form == "gcode":
        contour = program(r, dimension, 2 * count)
    else:
        contour = drawing(r, count)
    axes = 3 if r.random() < 0.2 else dimension  # a plane contour's third axis stands still
    return {"contour": contour, "machine": machine(r, axes, method == "jerk_limited"), "planning": planning(r, method)}
