"""Compares /scene of a job with its rows, by geometry of its own: python3 scene.py URL KIND ID"""
import json
import math
import sys
import urllib.request

url, kind, id = sys.argv[1:4]


def document(path):
    request = urllib.request.Request(url + "/v1/jobs/" + id + path, headers={"Accept": "application/json"})
    with urllib.request.urlopen(request) as answer:
        return json.load(answer)


def columns(names, more=""):
    return {column["name"]: column["values"] for column in document("/setpoints?columns=" + names + more)["columns"]}


def sub(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def from_segment(p, a, b):
    way = sub(b, a)
    length = dot(way, way)
    t = min(1, max(0, dot(sub(p, a), way) / length)) if length > 0 else 0
    return math.dist(p, [x + t * w for x, w in zip(a, way)])


class Loop:
    """A closed line in the plane."""

    def __init__(self, points):
        self.edges = [(a, b, math.dist(a, b)) for a, b in zip(points, points[1:] + points[:1])]
        assert all(length > 0 for _, _, length in self.edges), "a point is repeated"

    def area(self):
        return sum(a[0] * b[1] - a[1] * b[0] for a, b, _ in self.edges) / 2

    def distance(self, p):
        best, x, y = math.inf, p[0], p[1]
        for a, b, length in self.edges:
            reach = best + length
            if abs(a[0] - x) < reach and abs(a[1] - y) < reach:
                best = min(best, from_segment(p, a, b))
        return best

    def holds(self, p):
        inside, x, y = False, p[0], p[1]
        for (ax, ay), (bx, by), _ in self.edges:
            if (ay > y) != (by > y) and x < ax + (y - ay) / (by - ay) * (bx - ax):
                inside = not inside
        return inside


class Prism:
    def __init__(self, body):
        self.body = body
        self.outline = Loop(body["outline"])
        self.holes = [Loop(hole) for hole in body.get("holes", [])]
        self.frame = body.get("frame", {"origin": [0, 0, 0], "x": [1, 0, 0], "y": [0, 1, 0], "z": [0, 0, 1]})
        assert self.outline.area() > 0 and all(hole.area() < 0 for hole in self.holes), body["name"]
        axes = [self.frame[k] for k in "xyz"]
        assert all(abs(dot(a, b) - (a is b)) < 1e-9 for a in axes for b in axes), "orthonormal"
        x, y, z = axes
        assert math.dist(z, [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]]) < 1e-9

    def distance(self, p):
        """Of a point from the surface: negative inside."""
        way = sub(p, self.frame["origin"])
        flat, height = [dot(way, self.frame["x"]), dot(way, self.frame["y"])], dot(way, self.frame["z"])
        within = self.outline.holds(flat) and not any(hole.holds(flat) for hole in self.holes)
        section = min(loop.distance(flat) for loop in [self.outline] + self.holes) * (-1 if within else 1)
        beyond = max(self.body["from"] - height, height - self.body["to"])
        if section > 0 and beyond > 0:
            return math.hypot(section, beyond)
        return max(section, beyond)


def check_winding(scene, bodies):
    spec, result = document("/spec")["spec"], document("/result?parts=details.clearance,details.turns,summary")
    needle = bodies["needle"][0]
    (back, _, _), (front, _, _) = needle["points"]
    assert needle["moves"] == "tool" and needle["round_end"] and front == -needle["radius"]
    assert scene["frame"] == "part" and set(scene["place"]) == {"x", "y", "z", "angle"}
    prisms = [Prism(body) for body in scene["bodies"] if body["kind"] == "extrusion"]
    table = columns("x,y,z,phi,psi,s", "&frame=part")
    count = len(table["x"])
    turns, coils = result["details"]["turns"], [turn["begins"] for turn in result["details"]["turns"] if turn["turn"] == 1]
    cycle = document("/result?parts=setpoints")["setpoints"]["cycle_time"]
    least = math.inf
    nearest = result["details"]["clearance"]
    there = min(range(count), key=lambda row: abs(table["s"][row] - nearest["at"]))
    places = [-nearest["along"]] + [front + (back - front) * k / 12 for k in range(13)]
    for row in [there] + list(range(0, count, max(1, count // 200))):
        tip = [table[name][row] for name in "xyz"]
        phi, psi = math.radians(table["phi"][row]), math.radians(table["psi"][row])
        ahead = [math.cos(phi) * math.cos(psi), math.sin(phi) * math.cos(psi), -math.sin(psi)]
        coil = sum(begin <= row * cycle for begin in coils)
        for along in places:
            at = [c + along * d for c, d in zip(tip, ahead)]
            for prism in prisms:
                if prism.body.get("coil", coil) == coil:
                    least = min(least, prism.distance(at) - needle["radius"])
    # The place that the result names is looked at in the row next to it; bodies are drawn with chords.
    assert nearest["minimum"] - scene["tolerance"] - 0.001 <= least <= nearest["minimum"] + 0.3, (least, nearest)
    # Wires lie beside the iron, their axes at least their radius from it but for what the layout permits.
    wires = bodies["wire"]
    assert sum(len(wire["points"]) for wire in wires) == 8 * len(turns) or scene["left_out"] > 0
    iron = next(prism for prism in prisms if prism.body["name"] in ("stack", "pole"))
    for wire in wires:
        assert len(wire["times"]) == len(wire["points"]) and wire["times"] == sorted(wire["times"])
        for point in wire["points"][:: max(1, len(wire["points"]) // 40)]:
            distance = iron.distance(point)
            assert distance > wire["radius"] - 0.1, (point, distance)
    if "slot" in bodies:
        asked = {int(slot) for slot in spec["coil"]["slots"]}
        assert asked <= {body["slot"] for body in bodies["slot"]}, asked
        assert bodies["stack"][0]["assumed"] == ["outline"]
    # The path in the frame of the part is the way of the needle's tip.
    path = document("/path?of=part&points=200&columns=phi,psi")["values"]
    for k, row in enumerate(path["row"]):
        for name in ("x", "y", "z", "phi", "psi"):
            assert abs(path[name][k] - table[name][row]) <= 1e-5 * max(1, abs(table[name][row])), (name, row)


def check_probe(scene, bodies):
    spec = document("/spec")["spec"]
    points = [(point + [0])[:3] for point in spec["points"]]
    assert bodies["points"][0]["points"] == points
    tube = bodies["tube"][0]
    assert tube["kind"] == "tube" and tube["radius"] == spec["tolerance"]
    mover = scene["movers"]["tool"]["position"]
    table = columns(",".join(mover))
    count = len(table[mover[0]])
    for row in range(0, count, max(1, count // 300)):
        at = ([table[name][row] for name in mover] + [0])[:3]
        apart = min(from_segment(at, a, b) for a, b in zip(tube["points"], tube["points"][1:]))
        assert apart <= tube["radius"] + scene["tolerance"] + 1e-9, (row, apart)


def check_fine_axes(scene, bodies):
    table = columns("x,y,z,xc,yc,zc")
    reach = bodies["fine range"][0]
    half = [max(point[k] for point in reach["outline"]) for k in range(2)] + [reach["to"]]
    assert reach["moves"] == "coarse" and scene["movers"]["coarse"]["position"] == ["xc", "yc", "zc"]
    lines = bodies.get("cut", []) + bodies.get("position", [])
    count = len(table["x"])
    for row in range(0, count, max(1, count // 300)):
        at = [table[name][row] for name in "xyz"]
        for k, name in enumerate("xyz"):
            assert abs(at[k] - table[name + "c"][row]) <= half[k] + 1e-9
        apart = min(from_segment(at, a, b) for line in lines for a, b in zip(line["points"], line["points"][1:]))
        assert apart <= scene["tolerance"] + 1e-6, (row, apart)


scene = document("/scene")
bodies = {}
for body in scene["bodies"]:
    bodies.setdefault(body["name"], []).append(body)
    assert body["moves"] == "none" or body["moves"] in scene["movers"]
vertices = sum(len(body.get("points", [])) + len(body.get("outline", [])) + sum(map(len, body.get("holes", [])))
               for body in scene["bodies"])
assert scene["vertices"] == vertices <= 5000, vertices
low, high = scene["box"]
assert all(a <= b for a, b in zip(low, high))
{"winding": check_winding, "probe_path": check_probe, "contour": check_fine_axes}[kind](scene, bodies)
