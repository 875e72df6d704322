#!/usr/bin/env python3
"""Plans part programs and tells what came out and what it took: the four kinds of examples/make_programs.py, or files.

    python3 tests/bench/programs.py build/release/bahnwerk
    python3 tests/bench/programs.py build/release/bahnwerk --kind scan --size 5000 --seeds 10
    python3 tests/bench/programs.py build/release/bahnwerk --jerk 1e6 1e7 --file *.gcode
    python3 tests/bench/programs.py build/release/bahnwerk --check --seeds 10
    python3 tests/bench/programs.py build/release/bahnwerk --check --cutter-radius 8=5 --file *.gcode

A row per program and method, with corners stopped at and rounded. With --check each program is planned at five limits
of jerk, and what must hold is looked at: rounding is never slower than stopping, a looser jerk never slower by more
than 0.1 %, the gaps to the bound (whole program, and sections longer than 1 mm), and at 1e9 mm/s³ within 1 % of
time_optimal. Exit 1 if any of that fails. A program that is refused is told once, with the reason: whether that is a
good one is for the reader to say. Plain Python 3, standard library only.
"""
import argparse
import pathlib
import subprocess
import sys

import planning

ROOT = pathlib.Path(__file__).resolve().parents[2]
KINDS = ("carving", "spiral", "scan", "clearing")
SIZES = {"carving": 40, "spiral": 300, "scan": 2000, "clearing": 1500}  # for --check: some hundred to 2 000 lines
JERKS = (1e5, 1e6, 1e7, 1e8, 1e9)  # mm/s³
MONOTONE, AT_LARGEST_JERK = 1e-3, 1e-2  # relative
MEDIAN_GAP, WORST_GAP = 2e-3, 3e-2
AXES = {"x": (1800, 16000), "y": (1800, 16000), "z": (1000, 8000)}  # mm/s, mm/s²


def program(kind, seed, size):
    words = [sys.executable, ROOT / "examples" / "make_programs.py", kind, "--seed", str(seed)]
    return subprocess.run(words + (["--size", str(size)] if size else []), check=True, capture_output=True, text=True).stdout


def document(text, jerk, tolerance, radii=None):
    axes = {name: {"velocity": v, "acceleration": a, "jerk": jerk} for name, (v, a) in AXES.items()}
    corner = {"mode": "blend", "tolerance": tolerance} if tolerance else {"mode": "stop"}
    return {"kind": "contour", "name": "program", "spec": {
        "contour": {"gcode": text, **({"cutter_radius": radii} if radii else {})},
        "machine": {"kinematics": "cartesian", "axes": axes, "cycle_time": 0.001},
        "planning": {"method": "jerk_limited" if jerk else "time_optimal", "corner": corner}}}


class Check:
    """What must hold of every program, and how many times it did not."""

    def __init__(self):
        self.failed, self.gaps, self.section_medians, self.worst_sections = 0, [], [], []

    def fail(self, what):
        self.failed += 1
        print(f"    FAILS  {what}", flush=True)

    def program(self, name, plans):
        """plans[jerk, rounded]: results; jerk None is time_optimal."""
        def duration(jerk, rounded):
            result = plans.get((jerk, rounded)) or {}
            return result.get("summary", {}).get("duration")

        def small(value):
            return "-" if value is None else f"{value:.6f}"

        for rounded in (False, True):
            row = [duration(jerk, rounded) for jerk in (*JERKS, None)]
            print(f"{name[:32]:32} {'round' if rounded else 'stop':5} " + " ".join(f"{small(t):>13}" for t in row), flush=True)
            for looser, t, tighter in zip(JERKS[1:], row[1:], row):
                if t and tighter and t > tighter * (1 + MONOTONE):
                    self.fail(f"{name} {'round' if rounded else 'stop'}: jerk {looser:g} takes {t / tighter - 1:.3%} longer than the jerk before")
            if row[-1] and row[-2] and row[-2] > row[-1] * (1 + AT_LARGEST_JERK):
                self.fail(f"{name} {'round' if rounded else 'stop'}: {row[-2] / row[-1] - 1:.3%} above time_optimal")
        for jerk in (*JERKS, None):
            stop, blended = duration(jerk, False), duration(jerk, True)
            if (stop is None) != (blended is None):
                self.fail(f"{name} jerk {jerk}: {'stop' if stop is None else 'round'}: not planned")
            if stop and blended and blended > stop * (1 + 1e-9):
                self.fail(f"{name} jerk {jerk}: rounded {blended / stop - 1:.4%} slower than with stops")
            for rounded in (False, True):
                result = plans.get((jerk, rounded)) or {}
                if jerk is None or "bound" not in result:
                    continue
                self.gaps.append(result["bound"]["gap"])
                sections = result["details"].get("sections")
                if sections and sections["count"]:
                    self.section_medians.append(sections["median_gap"])
                    self.worst_sections.append(sections["worst"]["gap"])
                    if sections["median_gap"] > MEDIAN_GAP or sections["worst"]["gap"] > WORST_GAP:
                        worst = sections["worst"]
                        self.fail(f"{name} jerk {jerk:g} {'round' if rounded else 'stop'}: {sections['count']} sections, "
                                  f"median gap {sections['median_gap']:.3%}, worst {worst['gap']:.2%} "
                                  f"({worst['length']:.4g} mm, {worst['time']:.4g} s, {worst.get('line')})")

    def summary(self):
        for what, gaps in (("gap of whole programs", self.gaps), ("medians of gaps of sections", self.section_medians),
                           ("worst gaps of sections", self.worst_sections)):
            if gaps:
                gaps = sorted(gaps)
                print(f"{what}: median {gaps[len(gaps) // 2]:.3%}, 90 % {gaps[int(0.9 * len(gaps))]:.3%}, worst {gaps[-1]:.3%}")
        print(f"{self.failed} failed")


def check(binary, programs, tolerance, radii):
    checks = Check()
    print(f"{'program':32} {'mode':5} " + " ".join(f"{f'{jerk:g}' if jerk else 'optimal':>13}" for jerk in (*JERKS, None)))
    for name, text in programs:
        plans = {}
        reasons = set()
        for jerk in (*JERKS, None):
            for rounded in (False, True):
                result, _, _ = planning.plan(binary, document(text, jerk, tolerance if rounded else 0, radii))
                plans[jerk, rounded] = result
                if "summary" not in result:
                    reasons.add(f"{result.get('title')}: {result.get('detail', '')}")
        for reason in sorted(reasons):
            print(f"{name[:32]:32} {reason}", flush=True)
        if any("summary" in result for result in plans.values()):
            checks.program(name, plans)
    checks.summary()
    return 1 if checks.failed else 0


def main():
    parser = argparse.ArgumentParser(description="Plans part programs and times them.")
    parser.add_argument("binary")
    parser.add_argument("--kind", nargs="*", choices=KINDS, default=KINDS)
    parser.add_argument("--seeds", type=int, default=1, help="of each kind, from 1 on")
    parser.add_argument("--size", type=int, help="strokes, arcs or lines")
    parser.add_argument("--file", nargs="*", help="programs to be planned instead")
    parser.add_argument("--jerk", nargs="*", type=float, default=[], help="mm/s³ of every axis, besides time_optimal")
    parser.add_argument("--tolerance", type=float, default=0.02, help="mm, of rounding")
    parser.add_argument("--cutter-radius", nargs="*", default=[], metavar="D=MM", help="of the D words of the programs")
    parser.add_argument("--check", action="store_true", help="what must hold, at five limits of jerk")
    options = parser.parse_args()
    if options.file:
        programs = [(pathlib.Path(name).name, pathlib.Path(name).read_text()) for name in options.file]
    else:
        sizes = SIZES if options.check else {}
        programs = [(f"{kind} {seed}", program(kind, seed, options.size or sizes.get(kind)))
                    for kind in options.kind for seed in range(1, options.seeds + 1)]
    radii = {number: float(radius) for number, radius in (pair.split("=") for pair in options.cutter_radius)}
    if options.check:
        return check(options.binary, programs, options.tolerance, radii)
    print(f"{'program':32} {'jerk':>8} {'corners':>8} {'time, s':>14} {'gap':>9} {'CPU, s':>8} {'MB':>6}")
    for name, text in programs:
        for jerk in [None, *options.jerk]:
            for tolerance in (0, options.tolerance):
                result, seconds, memory = planning.plan(options.binary, document(text, jerk, tolerance, radii))
                head = f"{name[:32]:32} {jerk or '-':>8} {'round' if tolerance else 'stop':>8}"
                if "summary" not in result:
                    print(f"{head} {result.get('title')}: {result.get('detail', '')[:60]} {seconds:8.2f} {memory:6.0f}")
                    continue
                bound = result.get("bound") or {}
                print(f"{head} {result['summary']['duration']:14.6f} {bound.get('gap', float('nan')):9.2g} "
                      f"{seconds:8.2f} {memory:6.0f}", flush=True)


if __name__ == "__main__":
    sys.exit(main())
