#!/usr/bin/env python3
"""Plans random contours of difficult curves, forwards and backwards, by every method.

    tests/compare/curves.py BINARY [--random 100] [--seed 1] [--jobs 1] [--method NAME] [--keep FOLDER] [--coarse-fine]

Prints every plan that failed and every pair whose durations differ: by more than 1e-6, or 1e-3 where jerk is limited or
corners are rounded. Documents of these are kept in FOLDER. Exit 0: none, 1: some.
"""
import argparse
import collections
import concurrent.futures
import json
import pathlib
import random
import subprocess
import sys
import time

import random_curves


def plan(binary, spec, limit=300):
    document = json.dumps({"kind": "contour", "spec": spec})
    start = time.monotonic()
    try:
        process = subprocess.run([binary, "plan", "-"], input=document, capture_output=True, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return None, f"took more than {limit} s", limit
    spent = time.monotonic() - start
    try:
        result = json.loads(process.stdout)
    except ValueError:
        return None, f"exit {process.returncode}: {process.stderr[-200:]}", spent
    if process.returncode:
        return None, f"{result.get('type')}: {result.get('detail')} {result.get('errors', '')}"[:160], spent
    return result, None, spent


def run(task):
    binary, number, seed, method, coarse_fine = task
    spec = random_curves.spec(random.Random(seed * 1000003 + number), method)
    if coarse_fine:
        spec["machine"] = {"kinematics": "coarse_fine", "cycle_time": spec["machine"]["cycle_time"],
                           **random_curves.coarse_and_fine(spec["machine"]["axes"])}
    faults, specs = [], {"forward": spec, "backward": random_curves.backwards(spec)}
    results, spent = {}, 0
    for way, one in specs.items():
        results[way], fault, seconds = plan(binary, one)
        spent = max(spent, seconds)
        if fault:
            faults.append(f"{way}: {fault}")
    if all(results.values()):
        durations = [results[way]["summary"]["duration"] for way in specs]
        tolerance = 1e-3 if method == "jerk_limited" or spec["planning"]["corner"]["mode"] == "blend" or coarse_fine else 1e-6
        apart = abs(durations[0] - durations[1]) / max(durations)
        if apart > tolerance:
            faults.append(f"durations {durations[0]} and {durations[1]} are {apart:.2e} apart")
    return number, method, specs, faults, spent


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("binary")
    parser.add_argument("--random", type=int, default=100)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--method", choices=random_curves.METHODS)
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("--coarse-fine", action="store_true")
    options = parser.parse_args()
    methods = [options.method] if options.method else random_curves.METHODS
    tasks = [(options.binary, i, options.seed, m, options.coarse_fine)
             for i in range(options.first, options.first + options.random) for m in methods]
    failed, times = collections.Counter(), collections.Counter()
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for number, method, specs, faults, spent in pool.map(run, tasks):
            times[method] += spent
            if spent > 20:
                print(f"{number} {method}: {spent:.0f} s", flush=True)
            for fault in faults:
                print(f"{number} {method}: {fault}", flush=True)
            if faults:
                failed[method] += 1
                if options.keep:
                    options.keep.mkdir(parents=True, exist_ok=True)
                    for way, spec in specs.items():
                        (options.keep / f"{number}_{method}_{way}.json").write_text(json.dumps({"kind": "contour", "spec": spec}))
    for method in methods:
        print(f"{method}: {failed[method]} of {options.random} contours failed or differ, {times[method]:.0f} s")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
