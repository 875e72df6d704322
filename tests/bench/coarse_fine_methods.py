#!/usr/bin/env python3
"""Plans random part programs on machines with coarse and fine axes by every method, and counts how the plans ended.

    python3 tests/bench/coarse_fine_methods.py build/release/bahnwerk
    python3 tests/bench/coarse_fine_methods.py build/release/bahnwerk --programs 20 --variant joint+jerk iterative+jerk
    python3 tests/bench/coarse_fine_methods.py build/release/bahnwerk --variant joint --machine md1 md2 --gaps
    python3 tests/bench/coarse_fine_methods.py build/release/bahnwerk --smoother
    python3 tests/bench/coarse_fine_methods.py build/release/bahnwerk --first 17 --programs 1 --keep /tmp

Programs are numbered; each is the same every time: sheets of small shapes, circles with positioning moves of up to
0.4 m, and outlines of lines, arcs and polynomials with kinks, sizes over several decades, some of them in space. Odd
numbers are planned on MD1, even ones on MD2 (with --machine: all on each of those); every third has its corners rounded. With `+jerk` all axes have limits of
jerk, 30 to 500 1/s times their accelerations.

A plan is verified, or refused with the fields that cannot be met, or it failed: not verified, no split found, or no
answer in time. Failures are told, one line each, and are the exit status. With --gaps a plan whose gap to the bound is
above 0.2 %, or 2 % where a positioning move is longer than 0.1 m, is told and counts as failed, too.

With --smoother each program is planned by `iterative`, and by `joint` stretched to the same duration: its coarse axes
have to be the smoother ones, see coarse_fine.py. Plain Python 3, standard library only.
"""
import argparse
import collections
import json
import math
import pathlib
import random
import statistics
import sys

import planning
from smoother import HEAD, smoother

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "examples"))
sys.dont_write_bytecode = True

from generator import fine_sheet

VARIANTS = {
    "geometric": {"method": "geometric"},
    "geometric+reparametrise": {"method": "geometric", "reparametrise": True},
    "filter": {"method": "filter"},
    "filter+reparametrise": {"method": "filter", "reparametrise": True},
    "follow_up": {"method": "follow_up"},
    "lag_compensation": {"method": "lag_compensation"},
    "iterative": {"method": "iterative"},
    "iterative+any": {"method": "iterative"},  # any approximation, smoothing, degree, windows
    "iterative+reparametrise": {"method": "iterative", "reparametrise": True},
    "joint": {"method": "joint"},
    "joint+smooth": {"method": "joint", "smoothness": 0.5},
    "joint+reparametrise": {"method": "joint", "reparametrise": True},
    "joint+jerk": {"method": "joint"},
    "iterative+jerk": {"method": "iterative"},
    "iterative+any+jerk": {"method": "iterative"},
}
RELATIVE_JERKS = 30, 500  # 1/s
SHORT_GAP, LONG_GAP, LONG_MOVE = 2e-3, 2e-2, 100.0  # relative; mm


class Outline:
    """Segments end to end from a point on."""

    def __init__(self, rng, dimension):
        self.rng, self.dimension = rng, dimension
        self.start = self.at = [round(rng.uniform(-50, 50), 6) for _ in range(dimension)]
        self.blocks = []

    def block(self, mode, feed):
        self.blocks.append({"mode": mode, "feed": feed, "segments": []})

    def add(self, segment, end=None):
        self.blocks[-1]["segments"].append(segment)
        self.at = end or self.at

    def lifted(self, x, y, size):
        return [x, y] + [z + self.rng.uniform(-0.3, 0.3) * size for z in self.at[2:]]

    def line(self, length, heading):
        to = self.lifted(self.at[0] + length * math.cos(heading), self.at[1] + length * math.sin(heading), length)
        self.add({"line": to}, to)

    def arc(self, radius, heading, sweep):
        """Returns the heading at its end."""
        side = 1 if sweep > 0 else -1
        turn = heading + side * math.pi / 2
        centre = [self.at[0] + radius * math.cos(turn), self.at[1] + radius * math.sin(turn)]
        out = turn + math.pi + sweep
        x, y = centre[0] + radius * math.cos(out), centre[1] + radius * math.sin(out)
        to = list(self.at) if abs(sweep) >= 2 * math.pi else self.lifted(x, y, radius)
        self.add({"arc": {"to": to, "center": centre + self.at[2:], "direction": "ccw" if sweep > 0 else "cw"}}, to)
        return heading + sweep

    def polynomial(self, size, heading):
        """A cubic Bézier curve; returns the heading at its end."""
        points, w = [list(self.at)], heading
        for _ in range(3):
            step = self.rng.uniform(0.3, 1) * size
            z = [c + self.rng.uniform(-0.2, 0.2) * size for c in points[-1][2:]]
            points.append([points[-1][0] + step * math.cos(w), points[-1][1] + step * math.sin(w)] + z)
            last, w = w, w + self.rng.uniform(-1, 1)
        p, q, r, s = points
        rows = [[a, 3 * (b - a), 3 * (a - 2 * b + c), d - a + 3 * (b - c)] for a, b, c, d in zip(p, q, r, s)]
        self.add({"polynomial": {"coefficients": rows}}, [sum(row) for row in rows])
        return last

    def document(self):
        return {"start": self.start, "blocks": self.blocks}


def circles(rng):
    """Positioning moves and circles of any size, some with a dwell."""
    o = Outline(rng, 2)
    longest = rng.choice((30, 60, 100, 400))
    for _ in range(rng.randint(3, 8)):
        o.block("position", None)
        o.line(longest * 10 ** rng.uniform(-2, 0), rng.uniform(0, 6.28))
        o.block("cut", rng.uniform(50, 500))
        o.arc(10 ** rng.uniform(-0.5, 1.7), rng.uniform(0, 6.28), rng.choice((-1, 1)) * 2 * math.pi)
        if rng.random() < 0.25:
            o.add({"dwell": rng.uniform(0, 0.2)})
    return o.document()


def outline(rng, dimension):
    """About half of the joints are tangential, some nearly, some reverse."""
    o = Outline(rng, dimension)
    heading, scale = rng.uniform(-3, 3), 10 ** rng.uniform(-0.5, 1.7)
    for i in range(rng.randint(3, 20)):
        if i == 0 or rng.random() < 0.3:
            mode = "position" if rng.random() < 0.3 else "cut"
            o.block(mode, None if mode == "position" or rng.random() < 0.2 else 10 ** rng.uniform(1, 2.8))
        kink = rng.random()
        heading += rng.uniform(-3, 3) if kink < 0.3 else rng.uniform(-2e-3, 2e-3) if kink < 0.4 else math.pi if kink < 0.43 else 0
        size = scale * 10 ** rng.uniform(-1, 0.5)
        if rng.random() < 0.05:
            size = 10 ** rng.uniform(-3, -1)
        pick = rng.random()
        if pick < 0.4:
            o.line(size, heading)
        elif pick < 0.75:
            heading = o.arc(size, heading, rng.choice((-1, 1)) * (2 * math.pi if rng.random() < 0.1 else rng.uniform(0.05, 6)))
        else:
            heading = o.polynomial(size, heading)
    return o.document()


def contour(number):
    rng = random.Random(f"coarse and fine {number}")
    kind = rng.choice(("sheet", "circles", "outline", "outline", "space"))
    if kind == "sheet":
        return kind, fine_sheet.contour(number, rng.randint(3, 12), rng.uniform(100, 500))
    if kind == "circles":
        return kind, circles(rng)
    return kind, outline(rng, 3 if kind == "space" else 2)


def document(number, variant, which=None):
    rng = random.Random(f"{variant} {number}")
    kind, program = contour(number)
    machine = json.loads((ROOT / "examples" / "machines" / f"{which or ('md1' if number % 2 else 'md2')}.json").read_text())
    if kind == "space":
        for stage in ("coarse", "fine"):
            machine[stage]["z"] = machine[stage]["x"]
    jerk = variant.endswith("+jerk")
    if jerk:
        for stage in ("coarse", "fine"):
            factor = math.exp(rng.uniform(*map(math.log, RELATIVE_JERKS)))
            for name, axis in machine[stage].items():
                machine[stage][name] = {**axis, "jerk": factor * axis["acceleration"]}
    options = dict(VARIANTS[variant])
    if "+any" in variant:
        options["approximation"] = rng.choice(("least_squares", "chebyshev", "schoenberg"))
        options["smoothing"] = rng.choice(("none", "smoothing_spline", "quadratic_program", "linear_program"))
        options["degree"] = rng.randint(3 if jerk else 2, 5)
        options["knot_multiplicity"] = rng.randint(1, options["degree"] - (2 if jerk else 1))
        options["window"] = rng.choice((None, {"blocks": 6, "overlap": 2}))
        options["thinning"] = rng.choice((1, 1, 2))
    options["trades"] = False
    machine["redundancy"] = options
    corner = {"mode": "blend", "tolerance": 10 ** rng.uniform(-2, -0.5)} if number % 3 == 0 else {"mode": "stop"}
    return {"kind": "contour", "name": f"{kind} {number}", "spec": {"contour": program, "machine": machine, "planning": {"corner": corner}}}


def outcome(result):
    """verified, refused or failed; why."""
    if "summary" in result:
        redundancy = result["details"]["redundancy"]
        if not result["verification"]["passed"]:
            bad = [f"{c['name']} {c['value']:.9g} > {c['limit']:.9g}" for c in result["verification"]["checks"] if not c["passed"]]
            return "failed", "; ".join(bad), redundancy["fallbacks"]
        return "verified", "", redundancy["fallbacks"]
    fields = [f"{e['pointer']} {e.get('message', e.get('detail', ''))}" for e in result.get("errors", [])]
    return ("refused" if fields else "failed"), result.get("detail", "") + " " + "; ".join(fields), 0


def gap_of(result):
    """The gap and what it may be."""
    moves = [b["length"] for b in result["details"]["blocks"] if b["mode"] == "position"]
    return result["bound"]["gap"], LONG_GAP if max(moves, default=0) > LONG_MOVE else SHORT_GAP


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="the built bahnwerk")
    parser.add_argument("--first", type=int, default=0, help="number of the first program")
    parser.add_argument("--programs", type=int, default=200, help="how many")
    parser.add_argument("--variant", nargs="+", choices=VARIANTS, default=list(VARIANTS))
    parser.add_argument("--machine", nargs="+", choices=("md1", "md2"), default=[None])
    parser.add_argument("--numbers", nargs="+", type=int, help="only these programs")
    parser.add_argument("--gaps", action="store_true", help="hold the gaps to what they have to be")
    parser.add_argument("--smoother", action="store_true", help="compare the coarse axes' smoothness with that of `iterative`")
    parser.add_argument("--seconds", type=float, default=300, help="within which a plan has to be there")
    parser.add_argument("--keep", help="folder for the documents of plans that failed or were refused")
    arguments = parser.parse_args()
    failed = 0
    numbers = arguments.numbers or range(arguments.first, arguments.first + arguments.programs)
    if arguments.smoother:
        print(HEAD)
        for number, which in ((n, m) for m in arguments.machine for n in numbers):

            def chosen(**redundancy):
                job = document(number, "joint", which)
                job["spec"]["machine"]["redundancy"] = {**redundancy, "trades": False}
                return job

            failed += not smoother(arguments.program, f"{contour(number)[0]} {number}", which or ("md1" if number % 2 else "md2"), chosen)
        print(f"{failed} failed")
        return 1 if failed else 0
    print(f"{'variant':24} {'verified':>8} {'refused':>8} {'failed':>8} {'fell back':>9} {'CPU, s':>8}", flush=True)
    for variant in arguments.variant:
        counts, spent, fell_back, lines, gaps = collections.Counter(), 0.0, 0, [], []
        for number, which in ((n, m) for m in arguments.machine for n in numbers):
            job = document(number, variant, which)
            result, seconds, _ = planning.plan(arguments.program, job, arguments.seconds)
            end, why, fallbacks = outcome(result)
            spent += seconds
            fell_back += fallbacks > 0
            if end == "verified":
                gap, most = gap_of(result)
                gaps.append(gap)
                if arguments.gaps and gap > most:
                    end, why = "failed", f"gap {gap:.3%} > {most:.1%}"
            counts[end] += 1
            if end != "verified":
                lines.append(f"    {end:8} {job['name']}{' ' + which if which else ''}: {why}")
                if arguments.keep:
                    (pathlib.Path(arguments.keep) / f"{variant}_{number}{'_' + which if which else ''}.json").write_text(json.dumps(job))
        print(f"{variant:24} {counts['verified']:8} {counts['refused']:8} {counts['failed']:8} {fell_back:9} {spent:8.1f}", flush=True)
        if arguments.gaps and gaps:
            print(f"    gaps: median {statistics.median(gaps):.2g}, largest {max(gaps):.2%}, sum {sum(gaps):.2%}")
        for line in lines:
            print(line[:400], flush=True)
        failed += counts["failed"]
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
