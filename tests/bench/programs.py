#!/usr/bin/env python3
"""Plans part programs and tells what came out and what it took: the four kinds of examples/make_programs.py, or files.

    python3 tests/bench/programs.py build/release/bahnwerk
    python3 tests/bench/programs.py build/release/bahnwerk --kind scan --size 5000 --seeds 10
    python3 tests/bench/programs.py build/release/bahnwerk --jerk 1e6 1e7 --file *.gcode

A row per program and method, with corners stopped at and rounded. Plain Python 3, standard library only.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
KINDS = ("carving", "spiral", "scan", "clearing")
AXES = {"x": (1800, 16000), "y": (1800, 16000), "z": (1000, 8000)}  # mm/s, mm/s²


def program(kind, seed, size):
    words = [sys.executable, ROOT / "examples" / "make_programs.py", kind, "--seed", str(seed)]
    return subprocess.run(words + (["--size", str(size)] if size else []), check=True, capture_output=True, text=True).stdout


def document(text, jerk, tolerance):
    axes = {name: {"velocity": v, "acceleration": a, "jerk": jerk} for name, (v, a) in AXES.items()}
    corner = {"mode": "blend", "tolerance": tolerance} if tolerance else {"mode": "stop"}
    return {"kind": "contour", "name": "program", "spec": {
        "contour": {"gcode": text},
        "machine": {"kinematics": "cartesian", "axes": axes, "cycle_time": 0.001},
        "planning": {"method": "jerk_limited" if jerk else "time_optimal", "corner": corner}}}


def run(binary, spec):
    """The result or the problem, processor time in s and the largest memory in MB."""
    with tempfile.NamedTemporaryFile("w", suffix=".json") as job:
        json.dump(spec, job)
        job.flush()
        child = subprocess.Popen([binary, "plan", job.name], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        output = child.stdout.read()
        _, _, usage = os.wait4(child.pid, 0)
    return json.loads(output), usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def main():
    parser = argparse.ArgumentParser(description="Plans part programs and times them.")
    parser.add_argument("binary")
    parser.add_argument("--kind", nargs="*", choices=KINDS, default=KINDS)
    parser.add_argument("--seeds", type=int, default=1, help="of each kind, from 1 on")
    parser.add_argument("--size", type=int, help="strokes, arcs or lines")
    parser.add_argument("--file", nargs="*", help="programs to be planned instead")
    parser.add_argument("--jerk", nargs="*", type=float, default=[], help="mm/s³ of every axis, besides time_optimal")
    parser.add_argument("--tolerance", type=float, default=0.02, help="mm, of rounding")
    options = parser.parse_args()
    if options.file:
        programs = [(pathlib.Path(name).name, pathlib.Path(name).read_text()) for name in options.file]
    else:
        programs = [(f"{kind} {seed}", program(kind, seed, options.size))
                    for kind in options.kind for seed in range(1, options.seeds + 1)]
    print(f"{'program':32} {'jerk':>8} {'corners':>8} {'time, s':>14} {'gap':>9} {'CPU, s':>8} {'MB':>6}")
    for name, text in programs:
        for jerk in [None, *options.jerk]:
            for tolerance in (0, options.tolerance):
                result, seconds, memory = run(options.binary, document(text, jerk, tolerance))
                head = f"{name[:32]:32} {jerk or '-':>8} {'round' if tolerance else 'stop':>8}"
                if "summary" not in result:
                    print(f"{head} {result.get('title')}: {result.get('detail', '')[:60]} {seconds:8.2f} {memory:6.0f}")
                    continue
                bound = result.get("bound") or {}
                print(f"{head} {result['summary']['duration']:14.6f} {bound.get('gap', float('nan')):9.2g} "
                      f"{seconds:8.2f} {memory:6.0f}", flush=True)


if __name__ == "__main__":
    main()
