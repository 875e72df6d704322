#!/usr/bin/env python3
"""Plans random stators with several pivot limits and looks, by geometry of its own, where needle and wire go.

    tests/compare/needle_slots.py BINARY [--count 300] [--first 0] [--keep FOLDER] [--verbose]

Case i is the same every time: slots by their sizes or, every other one, as a polygon; a coil about one tooth in every third,
else over several; 1 to 3 turns. Each is planned without pivot limit and with three limits of 1 to 25 deg. Of every plan

    rows       each setpoint between the stack's faces: tip and axis of the needle outside the bore lie in the coil's slot of this
               stroke, the axis passes between its tooth tips, and strokes alternate down the first and up the second slot
    supports   support points of both slots lie in them
    wires      the places of the layout lie in the slot
    cause      where the needle has too little clearance from the stack, it has as little at the place that is named

and the verdict with a larger limit must be no worse. Prints what fails and a table. Exit 0: nothing failed. Plain Python 3.
"""
import argparse
import collections
import csv
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]


def rounded(x):
    return round(x, 4)


def outline(width, top, height, opening, land, r):
    """A slot from base to bore, counterclockwise: parallel land at the opening, rounded corners of the base."""
    arc = lambda cx, a, b: [(cx + r * math.cos(math.radians(t)), r + r * math.sin(math.radians(t))) for t in range(a, b + 1, 15)]
    points = arc(-width / 2 + r, 180, 270) + arc(width / 2 - r, 270, 360)
    points += [(top / 2, height - land), (opening / 2, height - land), (opening / 2, height), (-opening / 2, height),
               (-opening / 2, height - land), (-top / 2, height - land)]
    return [[rounded(x), rounded(y)] for x, y in points]


class Case:
    def __init__(self, number):
        r = random.Random(46000 + number)
        self.drawn = number % 2 == 1
        self.slots = r.choice([12, 18, 24, 30, 36, 48, 60, 72])
        self.height = rounded(r.uniform(8, 20))
        bore = max(1.3 * self.height, self.slots * r.uniform(5, 9) / (2 * math.pi), 14)
        self.base = rounded(bore + self.height)
        self.bore = self.base - self.height
        pitch = 2 * math.pi * self.bore / self.slots
        self.width = rounded(r.uniform(0.4, 0.65) * pitch)
        self.stack = r.choice([15, 30, 50, 80])
        land = rounded(r.uniform(0.4, 1.5))
        tip = rounded(r.uniform(90, 93.5))
        self.mouth = self.width - 2 * self.height * math.tan(math.radians(tip - 90))
        self.opening = rounded(r.uniform(0.5, 0.85) * min(self.width, self.mouth))
        corner = rounded(min(0.2, 0.2 * self.width))
        self.clear = self.opening
        if self.drawn:
            self.top = self.mouth
            self.land = land
            self.polygon = outline(self.width, self.mouth, self.height, self.opening, land, corner)
            slot = {"type": "polygon", "points": self.polygon, "liner": 0.2,
                    "opening": [[rounded(self.opening / 2), self.height], [rounded(-self.opening / 2), self.height]]}
        else:
            radius = rounded(r.uniform(0, 0.12) * self.opening)
            self.clear = self.opening - 2 * radius
            slot = {"base_width": self.width, "opening_width": self.opening, "height": self.height, "tip_angle": tip, "liner": 0.2,
                    "base_radius": self.base, "base_corner_radius": corner, "tip_corner_radius": radius,
                    "wedge_thickness": 0, "wedge_width": 0}
        self.radius = 0 if self.drawn else radius
        part = {"type": "stator", "slot": slot, "slots": self.slots, "stack": self.stack,
                "tool_shift": rounded(r.uniform(0, 0.25) * self.width)}
        if self.drawn or r.random() < 0.5:
            part["base_radius"] = self.base
        self.span = 1 if number % 3 == 0 else r.randint(2, max(2, self.slots // 4))
        first = r.randrange(self.slots)
        self.ends = [first, (first + self.span) % self.slots]
        if r.random() < 0.5:
            self.ends.reverse()
        wire = rounded(r.uniform(0.25, 0.5) * self.clear)
        self.needle = rounded(r.uniform(max(1.25 * 1.1 * wire, 0.45 * self.clear), 0.93 * self.clear))
        self.turns = r.choice([1, 1, 2, 3])
        machine = json.loads((ROOT / "examples" / "machines" / "robot.json").read_text())
        for axis in machine["axes"].values():
            axis["range"] = None
        machine.update(cycle_time=0.004, l_tool=rounded(min(50, 1.6 * self.bore)))
        tool = {"width": rounded(r.uniform(0.5, 0.9) * min(4, pitch / 2)), "thickness": 2}
        self.spec = {"part": part, "wire": {"copper": wire, "outer": rounded(1.1 * wire)},
                     "coil": {"slots": self.ends, "turns": self.turns}, "machine": machine, "tool": tool,
                     "needle": {"width": self.needle, "length": rounded(min(60, 1.6 * self.bore)), "pivot_limit": None},
                     "feed": {"method": "critical_points"}}
        self.limits = [None, r.randint(1, 9), *sorted(r.sample(range(10, 26), 2))]

    def azimuth(self, second):
        return 2 * math.pi * self.ends[1 if second else 0] / self.slots

    def beside(self, x, y, second):
        """Distance from the slot's middle line, and along it from the axis, mm."""
        a = self.azimuth(second)
        return y * math.cos(a) - x * math.sin(a), x * math.cos(a) + y * math.sin(a)

    def off(self, x, y, second):
        """Angle from the slot's middle as a share of half a pitch."""
        aside, ahead = self.beside(x, y, second)
        return abs(math.atan2(aside, ahead)) / (math.pi / self.slots)

    def iron(self, aside, ahead):
        """Signed distance, mm, of a point of the section from the iron about the slot whose middle line this is."""
        points = ([[-p[0], p[1]] for p in self.polygon] if self.drawn else
                  outline(self.width, self.mouth, self.height, self.opening, 0, min(0.2, 0.2 * self.width)))
        y = self.base - ahead
        inside, least = False, math.inf
        for (x1, y1), (x2, y2) in zip(points, points[1:] + points[:1]):
            if (y1 > y) != (y2 > y) and aside < x1 + (y - y1) / (y2 - y1) * (x2 - x1):
                inside = not inside
            if abs(y1 - self.height) < 1e-6 and abs(y2 - self.height) < 1e-6 and max(abs(x1), abs(x2)) <= self.opening / 2 + 1e-3:
                continue  # the opening is no iron
            u = max(0, min(1, ((aside - x1) * (x2 - x1) + (y - y1) * (y2 - y1)) / ((x2 - x1) ** 2 + (y2 - y1) ** 2)))
            least = min(least, math.hypot(aside - x1 - u * (x2 - x1), y - y1 - u * (y2 - y1)))
        return least if inside or math.hypot(aside, ahead) < self.bore else -least


def bad_rows(case, path):
    """Returns what is wrong with the rows between the stack's faces."""
    with open(path) as file:
        rows = csv.reader(file)
        names = next(rows)
        x_at, y_at, z_at, phi_at, psi_at = (names.index(n) for n in ("x", "y", "z", "phi", "psi"))
        strokes, inside, stay = 0, True, []
        faults = []

        def judge(second):
            worst = max((max(case.off(*tip, second) if math.hypot(*tip) > case.bore else 0,
                             abs(case.beside(*mouth, second)[0]) / (case.opening / 2) if mouth else 0) for tip, mouth in stay), default=0)
            return worst

        before = None
        for row in rows:
            x, y, z, phi, psi = (float(row[i]) for i in (x_at, y_at, z_at, phi_at, psi_at))
            now = 0 < z < case.stack
            if now:
                mouth = None
                c, s, level = math.cos(math.radians(phi)), math.sin(math.radians(phi)), math.cos(math.radians(psi))
                if math.hypot(x, y) > case.bore and level > 0.05:
                    half = x * c + y * s
                    root = half * half - (x * x + y * y - case.bore ** 2)
                    if root >= 0:
                        back = half - math.sqrt(root)  # along the needle's plan view to the bore
                        if 0 < back and z + back / level * math.sin(math.radians(psi)) < case.stack and back < level * case.spec["needle"]["length"]:
                            mouth = (x - back * c, y - back * s)
                stay.append(((x, y), mouth))
            elif inside and (before is not None):
                up = z >= case.stack
                wanted = strokes % 2 == 1
                if up == wanted:  # a whole stroke: the one before ended at the other face
                    if judge(wanted) > 1:
                        faults.append(f"stroke {strokes}: {judge(wanted):.2f} of half a pitch or an opening off")
                    strokes += 1
                elif min(judge(False), judge(True)) > 1:
                    faults.append(f"beside stroke {strokes}")
                stay = []
            inside, before = now, z
        if strokes != 2 * case.turns:
            faults.append(f"{strokes} strokes for {case.turns} turns")
    return faults


def bad_supports(case, result):
    faults = []
    for s in result["details"]["support_points"]:
        if s["region"] in ("slot", "slot_back"):
            share = case.off(s["position"][0], s["position"][1], s["region"] == "slot_back")
            if share > 1:
                faults.append(f"support point of turn {s['turn']} {s['region']} {s['end']}: {share:.2f} of half a pitch off")
    for name in ("slot", "slot_back"):
        for x, y in result["details"]["layout"]["regions"][name]["positions"][:case.turns]:
            if case.iron(x, case.base - y) < 0:
                faults.append(f"a wire in the iron of {name}")
    return faults


def false_cause(case, result):
    """Returns what is wrong with a clearance from the stack, by the place that is named."""
    clearance, path = result["details"]["clearance"], result["details"]["path"]
    if clearance["nearest"] != "stack":
        return None
    n, points, weights = path["degree"], path["points"], path["weights"]

    def at(piece, v):
        h = [[w * c for c in p] + [w] for p, w in zip(points[piece * n:piece * n + n + 1], weights[piece * n:piece * n + n + 1])]
        while len(h) > 1:
            h = [[(1 - v) * a + v * b for a, b in zip(p, q)] for p, q in zip(h, h[1:])]
        return [c / h[0][5] for c in h[0][:5]]

    length, parts, left = 0, 64, clearance["at"]
    for piece in range((len(points) - 1) // n):
        before = at(piece, 0)
        for k in range(1, parts + 1):
            here = at(piece, k / parts)
            length += math.dist(before[:3], here[:3])
            if length >= left - 1e-6 * left - 0.05:
                least = math.inf
                for v in (u / parts / 8 for u in range(8 * k - 12, 8 * k + 13)):
                    x, y, z, phi, psi = at(piece, min(1, max(0, v)))
                    phi, psi, a = math.radians(phi), math.radians(psi), clearance["along"]
                    px, py, pz = x - a * math.cos(phi) * math.cos(psi), y - a * math.sin(phi) * math.cos(psi), z + a * math.sin(psi)
                    second = case.off(px, py, True) < case.off(px, py, False)
                    gap = case.iron(*case.beside(px, py, second))
                    over = max(-pz, pz - case.stack)
                    gap = max(gap, over) if gap < 0 or over < 0 else math.hypot(gap, over)
                    least = min(least, gap - case.needle / 2)
                off = abs(least - clearance["minimum"])
                return None if off < 0.05 + case.radius else f"clearance {least:.3f} by own geometry, {clearance['minimum']:.3f} told"
            before = here
    return "the place is not on the path"


def run(binary, document, folder):
    path = folder / "document.json"
    path.write_text(json.dumps({"kind": "winding", "spec": document}))
    out = folder / "out"
    for name in ("result.json", "setpoints.csv"):
        (out / name).unlink(missing_ok=True)
    done = subprocess.run([binary, "plan", str(path), "--out", str(out)], capture_output=True, text=True, timeout=600)
    result = json.loads((out / "result.json").read_text()) if (out / "result.json").exists() else None
    return done.returncode, done.stdout + done.stderr, result, out / "setpoints.csv"


def cause(text):
    try:
        problem = json.loads(text)
    except ValueError:
        return "exit: " + text[:80]
    detail = problem.get("detail", "") or json.dumps(problem.get("errors", ""))
    if problem["type"].endswith("verification-failed"):
        near = "posts" if "nearest to: winding tool" in detail else "stack" if "nearest to: stack" in detail else ""
        return "verification: " + detail.split(":")[0] + (" from " + near if near else "")
    places = sorted({e.get("pointer", "") for e in problem.get("errors", [])})
    return problem["type"].split("/")[-1] + " " + " ".join(places)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary")
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("--verbose", action="store_true")
    options = parser.parse_args()
    table, failed, plans = collections.Counter(), collections.Counter(), 0
    if options.keep:
        options.keep.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        for number in range(options.first, options.first + options.count):
            case = Case(number)
            kind = ("drawn" if case.drawn else "sizes") + (" concentrated" if case.span == 1 else " distributed")
            verdicts = []
            for limit in case.limits:
                case.spec["needle"]["pivot_limit"] = limit
                plans += 1
                faults = collections.Counter()
                try:
                    code, text, result, setpoints = run(options.binary, case.spec, pathlib.Path(folder))
                except subprocess.TimeoutExpired:
                    code, text, result = 9, "timeout", None
                why = "planned" if code == 0 else cause(text)
                table[kind, "without" if limit is None else "with", why] += 1
                if result:
                    for fault in bad_supports(case, result):
                        faults["supports: " + fault] += 1
                    if code == 0:
                        for fault in bad_rows(case, setpoints):
                            faults["rows: " + fault] += 1
                    elif why.endswith("from stack"):
                        told = false_cause(case, result)
                        if told:
                            faults["cause: " + told] += 1
                        if (case.clear - case.needle) / 2 > 0.005:
                            faults[f"cause: a needle in the middle of the opening has {(case.clear - case.needle) / 2:.3f} mm"] += 1
                if verdicts and verdicts[-1] == 0 and code != 0:
                    faults[f"verdict: refused ({why}), planned with a smaller limit"] += 1
                verdicts.append(code if not (verdicts and verdicts[-1] == 0) else 0)
                for fault in faults:
                    print(f"case {number} ({kind}) limit {limit}: {fault}", flush=True)
                    failed[fault.split(":")[0]] += 1
                if options.verbose:
                    print(number, kind, limit, why, result and result["summary"]["clearance"], flush=True)
                if faults and options.keep:
                    (options.keep / f"{number}_{limit}.json").write_text(json.dumps({"kind": "winding", "spec": case.spec}))
    for (kind, limit, why), count in sorted(table.items()):
        print(f"{kind:20} {limit:8} {count:5} {why}")
    print(f"{plans} documents, {sum(n for (_, _, why), n in table.items() if why == 'planned')} planned; failed: {dict(failed)}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
