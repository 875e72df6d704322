#!/usr/bin/env python3
"""Plans contours on machines with coarse and fine axes and tells what came out and what it took.

    python3 tests/bench/coarse_fine.py build/release/bahnwerk
    python3 tests/bench/coarse_fine.py build/release/bahnwerk --seeds 100 --check
    python3 tests/bench/coarse_fine.py build/release/bahnwerk --file parts/*.json --machine md2 --jerk
    python3 tests/bench/coarse_fine.py build/release/bahnwerk --size 45 --seeds 1 --machine md2
    python3 tests/bench/coarse_fine.py build/release/bahnwerk --method iterative --smoothing none --check
    python3 tests/bench/coarse_fine.py build/release/bahnwerk --smoother

A row per contour and machine of examples/machines. Contours are the project's own examples, made-up sheets of small
shapes, one per seed, and files: job documents, or anything with a member `contour`. With --check it is looked at that
every plan is verified and took no more processor time than 1/5 of the motion's duration (`iterative` without a second
phase of smoothing: 1/20), and that gaps of `joint` to the bound are no larger than 0.2 %, or 2 % where a positioning move
is longer than 0.1 m, their median at most 0.05 %. Exit 1 if any of that fails. Processor time is that of the whole program:
reading, the bound, verification, setpoints and drawings are in it.

With --method iterative the column `to first` is the duration over that of the first iteration, `passes` how many there
were, `window` of --window BLOCKS OVERLAP plans in windows.

With --smoother each contour is planned by `iterative`, and by `joint` stretched to the same duration, to twice its
shortest at most; a plan that is still shorter is slowed to that duration, which makes its ∫a² smaller by the cube of
the quotient. Told are the sums of ∫a_c² of the coarse axes; that of `joint` has to be the smaller one.
Plain Python 3, standard library only.
"""
import argparse
import json
import pathlib
import statistics
import sys

import planning
from smoother import HEAD, smoother

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "examples"))
sys.dont_write_bytecode = True

from generator import fine_sheet

EXAMPLES = ("parts/fine_sheet.json", "bracket.json", "circle.json", "polyline.json", "parts/blades.json")
PROGRAMS = ("bracket.ngc", "gear.ngc", "lettering.ngc", "sheet.ngc")
LEAST_TIME, MOST_TIME = 1 / 20, 1 / 5  # of the motion's duration: of `iterative` without smoothing, of all else
MEDIAN_GAP, SHORT_GAP, LONG_GAP, LONG_MOVE = 5e-4, 2e-3, 2e-2, 100.0  # relative; mm
JERK = {"coarse": 100, "fine": 100}  # 1/s: jerk by acceleration
FEEDS = {"md1": 250, "md2": 400}  # mm/s


def at(feed, contour):
    """The contour with that feed wherever it cuts."""
    contour = json.loads(json.dumps(contour))
    for block in contour.get("blocks", []):
        if block["mode"] == "cut":
            block["feed"] = feed
    if "blocks" not in contour:
        contour["feed"] = feed
    return contour


def machine(name, jerk, smoothness, trades):
    data = json.loads((ROOT / "examples" / "machines" / f"{name}.json").read_text())
    data["redundancy"] = {"method": "joint", "smoothness": smoothness, "trades": trades}
    if jerk:
        for stage, factor in JERK.items():
            for axis in data[stage].values():
                axis["jerk"] = factor * axis["acceleration"]
    return data


def contours(arguments):
    for path in arguments.file:
        data = json.loads(pathlib.Path(path).read_text())
        yield pathlib.Path(path).stem, data["spec"]["contour"] if "spec" in data else data["contour"]
    if arguments.file:
        return
    for name in EXAMPLES:
        yield name, json.loads((ROOT / "examples" / name).read_text())["spec"]["contour"]
    for name in PROGRAMS:
        yield name, {"gcode": (ROOT / "examples" / "parts" / name).read_text()}
    for seed in range(arguments.seeds):
        yield f"sheet {seed}", fine_sheet.contour(seed, arguments.size)


def document(contour, which, arguments, **redundancy):
    corner = {"mode": "blend", "tolerance": arguments.blend} if arguments.blend else {"mode": "stop"}
    data = machine(which, arguments.jerk, arguments.smoothness, arguments.trades)
    data["redundancy"].update(method=redundancy.get("method", arguments.method))
    if data["redundancy"]["method"] == "iterative":
        data["redundancy"].update(approximation=arguments.approximation, smoothing=arguments.smoothing)
        if arguments.window:
            data["redundancy"]["window"] = dict(zip(("blocks", "overlap"), arguments.window))
    data["redundancy"].update(redundancy)
    if data["redundancy"]["method"] != "joint" or "stretch" in redundancy:
        del data["redundancy"]["smoothness"]
    return {"kind": "contour", "spec": {"contour": at(FEEDS.get(which, 400), contour), "machine": data, "planning": {"corner": corner}}}


def longest_move(result):
    moves = [b["length"] for b in result["details"]["blocks"] if b["mode"] == "position"]
    return max(moves, default=0)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="the built bahnwerk")
    parser.add_argument("--file", nargs="+", default=[], help="documents to plan instead of the project's own")
    parser.add_argument("--method", choices=("joint", "iterative"), default="joint")
    parser.add_argument("--approximation", default="least_squares", help="of `iterative`")
    parser.add_argument("--smoothing", default="quadratic_program", help="of `iterative`")
    parser.add_argument("--window", nargs=2, type=int, metavar=("BLOCKS", "OVERLAP"), help="of `iterative`: in windows")
    parser.add_argument("--machine", nargs="+", default=["md1", "md2"])
    parser.add_argument("--seeds", type=int, default=5, help="how many sheets")
    parser.add_argument("--size", type=int, default=24, help="shapes of a sheet")
    parser.add_argument("--jerk", action="store_true", help="with limits of jerk")
    parser.add_argument("--blend", type=float, help="round corners, tolerance in mm")
    parser.add_argument("--smoothness", type=float, default=0)
    parser.add_argument("--trades", action="store_true", help="with the table of what longer durations bring")
    parser.add_argument("--smoother", action="store_true", help="compare the coarse axes' smoothness with that of `iterative`")
    parser.add_argument("--check", action="store_true", help="hold the figures to what they have to be")
    arguments = parser.parse_args()
    failed, gaps, shares = 0, [], []
    if arguments.smoother:
        print(HEAD)
        for name, contour in contours(arguments):
            for which in arguments.machine:
                failed += not smoother(arguments.program, name, which, lambda **redundancy: document(contour, which, arguments, **redundancy))
        print(f"{failed} failed")
        return 1 if failed else 0
    joint = arguments.method == "joint"
    most = LEAST_TIME if not joint and arguments.smoothing == "none" else MOST_TIME
    print(f"{'contour':24} {'machine':7} {'s':>10} {'gap, %':>8} {'slowed':>6} {'longest move':>12} {'of motion':>9}{'' if joint else '  to first passes gave way'}")
    for name, contour in contours(arguments):
        for which in arguments.machine:
            result, seconds, _ = planning.plan(arguments.program, document(contour, which, arguments))
            if "summary" not in result:
                failed += 1
                print(f"{name[:24]:24} {which:7} FAILS {result.get('detail')} {result.get('errors', '')}"[:400], flush=True)
                continue
            gap, move = result["bound"]["gap"], longest_move(result)
            gaps.append(gap)
            duration, redundancy = result["summary"]["duration"], result["details"]["redundancy"]
            shares.append(seconds / duration)
            row = f"{name[:24]:24} {which:7} {duration:10.4f} {100 * gap:8.4f} {redundancy['slowed_count']:6} {move:12.1f} {shares[-1]:9.3f}"
            if not joint:
                row += f" {duration / redundancy['fastest']:9.4f} {len(redundancy['passes']):6} {redundancy['fallbacks']:8}"
            print(row, flush=True)
            if not arguments.check:
                continue
            if not result["verification"]["passed"]:
                failed += 1
                print("    FAILS  not verified")
            if shares[-1] > most:
                failed += 1
                print("    FAILS  time")
            if joint and gap > (LONG_GAP if move > LONG_MOVE else SHORT_GAP):
                failed += 1
                print("    FAILS  gap")
    if gaps:
        print(f"median gap {statistics.median(gaps):.4%}, worst {max(gaps):.4%}, of motion at most {max(shares):.3f}, {len(gaps)} plans, {failed} failed")
        if joint and arguments.check and statistics.median(gaps) > MEDIAN_GAP:
            failed += 1
            print("    FAILS  median gap")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
