#!/usr/bin/env python3
"""Plans random lone moves and programs on machines with coarse and fine axes by every method, and holds the plans to what must be so.

    tests/compare/coarse_fine_properties.py BINARY [--moves 500] [--programs 200] [--first 0] [--method NAME …] [--all] [--keep FOLDER]

Case i is the same every time: machine MD1, MD2 or a random one, a stroke of 0 to 500 mm (0, 0.001, 0.02 and 500 mm in
every tenth case each), one coordinate without a fine axis (z where there is one) in every seventh, with limited jerk every
other time (`joint` and `iterative`, which hold it), and a straight move of 0.01 to 3 000 mm or a program of
coarse_fine_methods.py. Each method plans it as it is, once more with one of the first three and once more in one of the other
ways, in turn (with --all in all of them)

    stroke, coarse, fine          with more stroke, more acceleration of the coarse or of the fine axes
    shift, mirror, turn, reverse  elsewhere, mirrored, turned by 90°, from its end to its begin

and has to end in a verified plan, no longer with more, as long elsewhere (1e-6; backwards 0.1 %). Methods whose document a
machine cannot have are left out. Prints what fails, the largest difference of each kind, and processor time per method.
Exit 0: nothing failed, 1: something did. Plain Python 3, standard library only.
"""
import argparse
import collections
import copy
import json
import math
import pathlib
import random
import sys

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests" / "bench"))

import coarse_fine_methods
import planning

METHODS = ("joint", "iterative", "geometric", "filter", "follow_up", "lag_compensation")
WITH_JERK = ("joint", "iterative")
MORE = ("stroke", "coarse", "fine")
FRAMES = {"shift": 1e-6, "mirror": 1e-6, "turn": 1e-6, "reverse": 1e-3}
LONGER_WITH_MORE = 1e-6  # of a duration, that counts as rounding
SECONDS = 600  # of one plan, however busy the machine is


def decade(r, low, high):
    return math.exp(r.uniform(math.log(low), math.log(high)))


def stroke_of(number, r):
    """Of every twenty cases two each have none, one far below what is split, the least that is, and the largest one; mm."""
    special = {2: 0, 3: 0.001, 4: 0.02, 5: 500}.get(number // 2 % 10)
    return special if special is not None else decade(r, 0.001, 500) if number // 2 % 10 > 6 else None


def machine(r, jerk, axes, stroke, alone):
    """A stroke of None is the machine's own; `alone`: one coordinate, z where there is one, has a coarse axis only."""
    pick = r.random()
    if pick < 0.6:
        found = json.loads((ROOT / "examples" / "machines" / ("md1.json" if pick < 0.3 else "md2.json")).read_text())
    else:
        found = {"kinematics": "coarse_fine", "coarse": {}, "fine": {}, "cycle_time": 0.001}
        same = r.random() < 0.5
        for name in "xy":
            if name == "y" and same:
                found["coarse"][name], found["fine"][name] = dict(found["coarse"]["x"]), dict(found["fine"]["x"])
                continue
            coarse = {"velocity": decade(r, 300, 3000), "acceleration": decade(r, 2000, 20000)}
            found["coarse"][name] = coarse
            found["fine"][name] = {"velocity": coarse["velocity"] * decade(r, 0.5, 3), "acceleration": coarse["acceleration"] * decade(r, 1.2, 15)}
    for fine in found["fine"].values():
        if stroke is not None or "stroke" not in fine:
            fine["stroke"] = 20 if stroke is None else stroke
    if axes == 3:
        found["coarse"]["z"] = dict(found["coarse"]["x"])
        if not alone:
            found["fine"]["z"] = dict(found["fine"]["x"])
    elif alone:
        del found["fine"][r.choice("xy")]
    for stage in ("coarse", "fine"):
        if jerk:
            factor = decade(r, 30, 500)
            for axis in found[stage].values():
                axis["jerk"] = factor * axis["acceleration"]
    return found


def lone_move(r):
    length, heading = decade(r, 0.01, 3000), r.choice([0, math.pi / 2, math.pi / 4, r.uniform(-math.pi, math.pi)])
    start = [round(r.uniform(-50, 50), 3) for _ in range(2)]
    to = [round(start[0] + length * math.cos(heading), 4), round(start[1] + length * math.sin(heading), 4)]
    feed = decade(r, 10, 1000) if r.random() < 0.3 else None
    return {"start": start, "blocks": [{"mode": "cut" if feed else "position", "feed": feed, "segments": [{"line": to}]}]}


def redundancy(r, method, jerk):
    options = {"method": method, "trades": False}
    if method == "iterative" and r.random() < 0.5:
        options["approximation"] = r.choice(("least_squares", "chebyshev", "schoenberg"))
        options["smoothing"] = r.choice(("none", "smoothing_spline", "quadratic_program", "linear_program"))
        options["degree"] = r.randint(3 if jerk else 2, 5)
    if method == "joint" and r.random() < 0.2:
        options["smoothness"] = r.choice((0.25, 0.5, 0.75, 1))
    return options


def case(number, method, programs):
    r = random.Random(f"{'program' if programs else 'move'} {number}")
    jerk = number % 2 == 1
    kind, contour = coarse_fine_methods.contour(10000 + number) if programs else ("move", lone_move(r))
    spec = {"contour": contour, "machine": machine(r, jerk, 3 if kind == "space" else 2, stroke_of(number, r), number // 2 % 7 == 3), "planning": {"corner": {"mode": "stop"}}}
    if programs and number % 3 == 0:
        spec["planning"]["corner"] = {"mode": "blend", "tolerance": decade(r, 0.01, 0.3)}
    more = {name: decade(r, 1.02, 3) for name in MORE}
    spec["machine"]["redundancy"] = redundancy(random.Random(f"{method} {number}"), method, jerk)
    return {"kind": "contour", "name": f"{kind} {number}", "spec": spec}, jerk, more


def increased(job, which, factor):
    job = copy.deepcopy(job)
    for axis in job["spec"]["machine"]["fine" if which == "stroke" else which].values():
        axis["stroke" if which == "stroke" else "acceleration"] *= factor
    return job


def moved(job, place, turned_over):
    """Every point p becomes place(p); arcs turn the other way where `turned_over`."""
    job = copy.deepcopy(job)
    contour = job["spec"]["contour"]
    contour["start"] = place(contour["start"])
    for block in contour["blocks"]:
        for segment in block["segments"]:
            if "line" in segment:
                segment["line"] = place(segment["line"])
            elif "arc" in segment:
                arc = segment["arc"]
                arc["to"], arc["center"] = place(arc["to"]), place(arc["center"])
                if turned_over:
                    arc["direction"] = "cw" if arc.get("direction", "ccw") == "ccw" else "ccw"
            elif "polynomial" in segment:  # the constant is a point, the others are vectors
                origin = place([0.0] * len(contour["start"]))
                columns = list(zip(*segment["polynomial"]["coefficients"]))
                columns = [place(list(columns[0]))] + [[a - o for a, o in zip(place(list(c)), origin)] for c in columns[1:]]
                segment["polynomial"]["coefficients"] = [list(row) for row in zip(*columns)]
    return job


def reversed_(job):
    job = copy.deepcopy(job)
    contour = job["spec"]["contour"]
    at, blocks = contour["start"], []
    for block in contour["blocks"]:
        segments = []
        for segment in block["segments"]:
            if "dwell" in segment:
                segments.append(segment)
                continue
            begin = at
            if "line" in segment:
                at = segment["line"]
                segments.append({"line": begin})
            elif "arc" in segment:
                at = segment["arc"]["to"]
                other = "cw" if segment["arc"].get("direction", "ccw") == "ccw" else "ccw"
                segments.append({"arc": {**segment["arc"], "to": begin, "center": reversed_centre(segment["arc"]["center"], begin), "direction": other}})
            else:
                rows = segment["polynomial"]["coefficients"]
                at = [math.fsum(row) for row in rows]
                segments.append({"polynomial": {"coefficients": [[sum(math.comb(i, j) * (-1) ** j * row[i] for i in range(j, len(row))) for j in range(len(row))] for row in rows]}})
        blocks.append({**block, "segments": segments[::-1]})
    contour["start"], contour["blocks"] = at, blocks[::-1]
    return job


def reversed_centre(centre, begin):
    return centre[:2] + begin[2:]


def in_frame(job, frame):
    if frame == "shift":
        return moved(job, lambda p: [p[0] + 31.25, p[1] - 17.5] + p[2:], False)
    if frame == "mirror":
        return moved(job, lambda p: [-p[0]] + p[1:], True)
    if frame == "turn":
        job = moved(job, lambda p: [-p[1], p[0]] + p[2:], False)
        for stage in ("coarse", "fine"):
            axes = job["spec"]["machine"][stage]
            job["spec"]["machine"][stage] = {{"x": "y", "y": "x"}.get(name, name): axis for name, axis in axes.items()}
        return job
    return reversed_(job)


class Run:
    def __init__(self, options):
        self.options = options
        self.seconds, self.plans = collections.Counter(), collections.Counter()
        self.gave_way = collections.Counter()
        self.failed = collections.Counter()
        self.largest = collections.defaultdict(float)

    def fail(self, method, what, job, why, other=None):
        self.failed[method, what] += 1
        print(f"{job['name']} {method} {what}: {why}"[:300], flush=True)
        if self.options.keep:
            folder = self.options.keep
            folder.mkdir(parents=True, exist_ok=True)
            name = f"{job['name'].replace(' ', '_')}_{method}_{what}"
            (folder / f"{name}.json").write_text(json.dumps(job))
            if other:
                (folder / f"{name}.other.json").write_text(json.dumps(other))

    def duration(self, method, what, job):
        """Of the verified plan; none where it was refused or failed."""
        result, seconds, _ = planning.plan(self.options.binary, job, SECONDS)
        self.seconds[method] += seconds
        self.plans[method] += 1
        end, why, fallbacks = coarse_fine_methods.outcome(result)
        if end != "verified":
            self.fail(method, f"{end} {what}", job, why)
            return None
        self.gave_way[method] += what == "as it is" and fallbacks > 0
        return result["summary"]["duration"]

    def case(self, number, method, programs):
        job, jerk, more = case(number, method, programs)
        if jerk and method not in WITH_JERK:
            return
        base = self.duration(method, "as it is", job)
        if base is None:
            return
        of_more, of_frames = MORE, tuple(FRAMES)
        if not self.options.all:
            of_more, of_frames = (MORE[number // 2 % 3],), (("reverse", "shift", "reverse", "mirror", "reverse", "turn")[number // 2 % 6],)
        for which, factor in more.items():
            if which not in of_more:
                continue
            other = increased(job, which, factor)
            if (found := self.duration(method, which, other)) is not None:
                self.compare(method, which, job, other, found / base - 1, f"× {factor:.4g}: {base:.8g} became {found:.8g}", LONGER_WITH_MORE)
        for frame in of_frames:
            tolerance = FRAMES[frame]
            other = in_frame(job, frame)
            if (found := self.duration(method, frame, other)) is not None:
                self.compare(method, frame, job, other, abs(found / base - 1), f"{base:.8g} became {found:.8g}", tolerance)

    def compare(self, method, what, job, other, difference, text, tolerance):
        self.largest[method, what] = max(self.largest[method, what], difference)
        if difference > tolerance:
            self.fail(method, what, job, f"{difference:.2e}, {text}", other)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary")
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--moves", type=int, default=500)
    parser.add_argument("--programs", type=int, default=200)
    parser.add_argument("--method", nargs="+", choices=METHODS, default=METHODS)
    parser.add_argument("--all", action="store_true", help="with more of everything and in every frame")
    parser.add_argument("--keep", type=pathlib.Path)
    options = parser.parse_args()
    run = Run(options)
    for programs, count in ((False, options.moves), (True, options.programs)):
        for number in range(options.first, options.first + count):
            for method in options.method:
                run.case(number, method, programs)
    for method in options.method:
        worst = ", ".join(f"{what} {run.largest[method, what]:.1e}" for what in (*MORE, *FRAMES))
        print(f"{method}: {run.plans[method]} plans, {run.gave_way[method]} gave way, {run.seconds[method]:.1f} s; most: {worst}")
        for (name, what), count in sorted(run.failed.items()):
            if name == method:
                print(f"    {what}: {count} failed")
    return 1 if run.failed else 0


if __name__ == "__main__":
    sys.exit(main())
