"""Random documents of kind motion_law, and what has to hold of their plans.

    random_law.py BAHNWERK GROUP [COUNT] [SEED]

GROUP: monotone (rows with equal neighbours), first_angle (periodic, the first point's angle in a range), drive (with
ranges of angles), lengths (sections from 1e-3 to 180 deg side by side), free_ends, nested (splines that contain each
other), strokes (the shortest cycle in closed form). Prints what fails, and a summary of processor time and memory.
"""
import json
import math
import os
import random
import subprocess
import sys
import tempfile

SECONDS, MEGABYTES = 10, 500


def document(spec):
    return {"kind": "motion_law", "spec": spec}


def rest(at, position, **more):
    return {"at": at, "position": position, "velocity": 0, "acceleration": 0, **more}


def objective(r):
    return {"velocity": 1, "acceleration": 10 ** r.uniform(-2, -0.5), "jerk": 10 ** r.uniform(-4, -1.5)}


def splits(r, count, length):
    inner = sorted(r.uniform(0.05, 0.95) for _ in range(count - 2))
    while any(b - a < 0.03 for a, b in zip(inner, inner[1:])):
        inner = sorted(r.uniform(0.05, 0.95) for _ in range(count - 2))
    return [0] + [round(length * x, 3) for x in inner] + [length]


def monotone(r):
    """A row of positions that rise or fall, or stay, with limits of velocity against overshoot."""
    count, sign, level = r.randint(3, 9), r.choice([1, -1]), r.choice([0, 5, -3, 100])
    length = r.choice([100, 360])
    points, position = [], level
    for at in splits(r, count, length):
        points.append({"at": at, "position": round(position, 3)})
        if r.random() < 0.6:
            position += sign * r.uniform(0.5, 20)
    for point in points[:-1]:
        point["section"] = {"velocity": {"min": 0} if sign > 0 else {"max": 0}}
        if r.random() < 0.2:
            low, high = sorted([point["position"], points[points.index(point) + 1]["position"]])
            point["section"]["position"] = {"min": low} if sign < 0 else {"max": high}
    for end in (points[0], points[-1]):
        if r.random() < 0.6:
            end.update(velocity=0, acceleration=0)
    spec = {"master": {"length": length, "cycle_duration": r.choice([0.5, 1, 2])}, "periodic": False, "points": points,
            "objective": objective(r), "degree": r.choice([None, None, 5, 7, 9])}
    if spec["degree"]:
        spec["pieces"] = r.choice([1, 2, 4])
    return spec


def first_angle(r):
    span, count = r.uniform(1, 60), r.randint(2, 5)
    points = [{"at": {"min": 0, "max": span}, "position": 0}]
    for k in range(1, count):
        points.append({"at": round(span + k * (350 - span) / count, 2), "position": round(r.uniform(2, 30), 2)})
    for point in points:
        if r.random() < 0.5:
            point.update(velocity=0, acceleration=0)
    return {"master": {"length": 360, "cycle_duration": r.choice([0.4, 1, 3])}, "periodic": True, "points": points,
            "objective": objective(r), "degree": r.choice([5, 7, None]), "samples": r.choice([360, 720, 777])}


def drive(r):
    count = r.randint(2, 4)
    points, position = [], 0
    ats = splits(r, count, 360)
    for k, at in enumerate(ats):
        point = {"at": at, "position": round(position, 2)}
        if 0 < k < count - 1 and r.random() < 0.6:
            point["at"] = {"min": round(max(0, at - r.uniform(5, 60)), 2), "max": round(min(360, at + r.uniform(5, 60)), 2)}
        points.append(point)
        position += r.uniform(5, 80) * r.choice([1, 1, -1])
    for end in (points[0], points[-1]):
        end.update(velocity=0, acceleration=0)
    limits = {"velocity": 10 ** r.uniform(2, 3.5), "acceleration": 10 ** r.uniform(3, 5), "jerk": 10 ** r.uniform(5, 7)}
    return {"master": {"length": 360, "cycle_duration": None}, "periodic": False, "points": points, "drive": limits}


def lengths(r):
    count = r.randint(3, 6)
    parts = [10 ** r.uniform(-3, math.log10(180)) for _ in range(count - 1)]
    length = sum(parts)
    amplitude, at, points = r.uniform(2, 50), 0.0, []
    for k in range(count):  # positions of a smooth motion, so that the short sections can be meant
        share = at / length
        points.append({"at": at, "position": amplitude * (share - math.sin(2 * math.pi * share) / (2 * math.pi))})
        if k < count - 1:
            at += parts[k]
    points[0].update(velocity=0, acceleration=0)
    points[-1].update(velocity=0, acceleration=0, at=length)
    for point in points[1:-1]:
        point["continuity"] = r.choice([2, 3])
    spec = {"master": {"length": length, "cycle_duration": 1}, "periodic": False, "points": points,
            "objective": objective(r), "degree": r.choice([None, 5, 7])}
    if spec["degree"]:
        spec["pieces"] = r.choice([1, 2, 4, 8, 16])
    return spec


def free_ends(r):
    """Often a straight line is the best law."""
    count, rise, points = r.randint(2, 5), r.uniform(-30, 30), []
    for at in splits(r, count, 360):
        on_line, room = rise * at / 360, r.uniform(0, 8)
        points.append({"at": at, "position": r.choice([on_line, {"min": on_line - room, "max": on_line + r.uniform(0, 8)}])})
    points[0]["position"], points[-1]["position"] = 0, rise
    return {"master": {"length": 360, "cycle_duration": r.choice([0.5, 1, 2])}, "periodic": False, "points": points,
            "objective": objective(r) if r.random() < 0.5 else {}, "degree": r.choice([None, 3, 5, 9])}


def nested(r):
    count = r.randint(2, 5)
    points = [{"at": at, "position": round(r.uniform(0, 40), 2)} for at in splits(r, count, 360)]
    for end in (points[0], points[-1]):
        end.update(velocity=0, acceleration=0)
    return {"master": {"length": 360, "cycle_duration": 1}, "periodic": False, "points": points, "objective": objective(r)}


def strokes(r):
    stroke = 10 ** r.uniform(0, 2.5)
    v, a = 10 ** r.uniform(1.5, 3.5), 10 ** r.uniform(2.5, 5)
    limits = {"velocity": v, "acceleration": a, "jerk": 10 ** r.uniform(3.5, 7)}
    return {"master": {"length": 1, "cycle_duration": None}, "periodic": False, "drive": limits,
            "points": [rest(0, 18), rest(1, 18 + r.choice([1, -1]) * stroke)]}


def closed_form(stroke, v, a, j):
    """The shortest time from rest to rest, by the largest velocity and acceleration that are reached."""
    if v * j < a * a:
        a_at_v = math.sqrt(v * j)
    else:
        a_at_v = a
    if stroke >= v * (v / a_at_v + a_at_v / j):
        return stroke / v + v / a_at_v + a_at_v / j
    if stroke >= 2 * a ** 3 / j ** 2:
        return a / j + math.sqrt((a / j) ** 2 + 4 * stroke / a)
    return 4 * (stroke / (2 * j)) ** (1 / 3)


class Runner:
    def __init__(self, bahnwerk):
        self.bahnwerk, self.folder = bahnwerk, tempfile.mkdtemp()
        self.most_seconds = self.most_megabytes = 0

    def plan(self, spec):
        """Returns exit code, result (or {}) and text; checks time and memory."""
        path, out = os.path.join(self.folder, "job.json"), os.path.join(self.folder, "out")
        with open(path, "w") as file:
            json.dump(document({"drawings": True, **spec}), file)
        result = os.path.join(out, "result.json")
        if os.path.exists(result):
            os.remove(result)
        process = subprocess.Popen([self.bahnwerk, "plan", path, "--out", out], stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        text = process.stdout.read().decode()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        self.seconds, self.megabytes = usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024
        self.most_seconds = max(self.most_seconds, self.seconds)
        self.most_megabytes = max(self.most_megabytes, self.megabytes)
        found = json.load(open(result)) if os.path.exists(result) else {}
        return process.returncode, found, text


def check_nested(runner, spec):
    """J never grows with pieces that divide each other."""
    faults = []
    for degree in (5, 7, 9):
        last = None
        for pieces in (1, 2, 4, 8, 16):
            code, result, text = runner.plan({**spec, "degree": degree, "pieces": pieces})
            if code != 0:
                faults.append(f"degree {degree}, {pieces} pieces: exit {code}: {text[:200]}")
                continue
            j = result["summary"]["objective"]
            if last is not None and j > last * (1 + 1e-9):
                faults.append(f"degree {degree}: {pieces} pieces {j!r}, fewer {last!r}, {j / last - 1:.1e} worse")
            last = j if last is None else min(j, last)
    return faults


def check(runner, group, spec):
    if group == "nested":
        return check_nested(runner, spec)
    code, result, text = runner.plan(spec)
    faults = []
    if runner.seconds > SECONDS or runner.megabytes > MEGABYTES:
        faults.append(f"{runner.seconds:.1f} s, {runner.megabytes:.0f} MB")
    may_refuse = group == "lengths"
    if code != 0 and not (may_refuse and code == 2 and "is so close to point" in text):
        faults.append(f"exit {code}: {' '.join(text.split())[:300]}")
    if code == 0 and group == "drive" and result["bound"]["cycle_gap"] > 0.01:
        faults.append(f"cycle gap {result['bound']['cycle_gap']:.4f}")
    if code == 0 and group == "strokes":
        stroke = abs(spec["points"][1]["position"] - spec["points"][0]["position"])
        best = closed_form(stroke, *(spec["drive"][k] for k in ("velocity", "acceleration", "jerk")))
        if abs(result["summary"]["cycle_duration"] / best - 1) > 1e-9:
            faults.append(f"cycle {result['summary']['cycle_duration']!r}, closed form {best!r}")
    runner.refused += code == 2
    return faults


def main():
    bahnwerk, group = sys.argv[1:3]
    count, seed = (int(x) for x in (sys.argv[3:] + ["20", "1"][len(sys.argv) - 3:]))
    runner, failed = Runner(bahnwerk), 0
    runner.refused = 0
    for k in range(count):
        spec = globals()[group](random.Random(seed * 100003 + k))
        faults = check(runner, group, spec)
        failed += bool(faults)
        for fault in faults:
            print(f"{group} {k} degree {spec.get('degree')}: {fault}", flush=True)
        if faults and os.environ.get("KEEP"):
            json.dump(document(spec), open(os.path.join(os.environ["KEEP"], f"{group}_{k}.json"), "w"), indent=1)
    print(f"{group}: {count} documents, {failed} with faults, {runner.refused} refused; "
          f"at most {runner.most_seconds:.1f} s, {runner.most_megabytes:.0f} MB")
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
