#!/usr/bin/env python3
"""Plans the project's examples, its part files and random documents with two binaries and compares what they yield.

    tests/compare/compare.py OLD NEW [--random 500] [--each 0] [--seed 1] [--axes 100] [--jobs 2] [--only TEXT] [--table FILE]

Prints what differs, the largest difference of each kind of value in units of its tolerance's scale, per kind of document
how its figure changed (a duration, the wires of a slot, or J of a law), and processor time and peak memory of both. --table
writes a line per document: name, figures, verdicts, gaps, seconds and megabytes of old and new. Exit 0: nothing differs by
more than the tolerance, 1: something does, 2: usage.
"""
import argparse
import concurrent.futures
import csv
import json
import os
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile
import time

import difference
import documents


def plan(binary, job, out):
    """Exit code, processor time, s, and peak memory, MB. A process begins with that of the one it was forked from: none if it
    has not exceeded this."""
    floor = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    with open(out / "stdout", "wb") as output:
        process = subprocess.Popen([binary, "plan", str(job), "--out", str(out)], stdout=output, stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024 if usage.ru_maxrss > 1.05 * floor else None


def figures(out):
    """Figure of a plan, verdict and gap."""
    result = json.loads((out / "stdout").read_text())
    summary = result["summary"]
    name = next(name for name in ("duration", "count", "objective") if name in summary)
    return name, summary[name], result["verification"]["passed"], result["bound"]["gap"]


def both(binaries, name, document):
    """Plans one document with both; the result is a dictionary, because it crosses a process border."""
    with tempfile.TemporaryDirectory(prefix="compare.") as folder:
        work = pathlib.Path(folder)
        job = work / "job.json"
        job.write_text(json.dumps(document))
        outs, codes, seconds, memory = [], [], [], []
        for side, binary in zip(("old", "new"), binaries):
            out = work / side
            out.mkdir()
            code, spent, peak = plan(binary, job, out)
            outs.append(out)
            codes.append(code)
            seconds.append(spent)
            memory.append(peak)
        found = difference.of_runs(codes, outs)
        return {"name": name, "kind": document["kind"], "codes": codes, "seconds": seconds, "memory": memory, "found": found,
                "figures": [figures(out) if code == 0 else ("", None, None, None) for code, out in zip(codes, outs)]}


def show_figures(results):
    """Per kind: how many figures change by more than rounding, their median, and the largest losses. More wires are a gain."""
    print("\nhow figures change, by kind; a loss is a longer duration, fewer wires, a larger J:")
    for kind in sorted({run["kind"] for run in results}):
        planned = [run for run in results if run["kind"] == kind and run["codes"] == [0, 0]]
        verdicts = [sum(run["figures"][side][2] for run in planned) for side in (0, 1)]
        losses = []
        for run in planned:
            (name, old, *_), (_, new, *_) = run["figures"]
            loss = (new - old) / max(abs(old), abs(new), 1e-300) * (-1 if name == "count" else 1)
            if abs(loss) > 1e-9:
                losses.append((loss, run["name"]))
        losses.sort(reverse=True)
        print(f"  {kind}: {len(planned)} planned by both, passed {verdicts[0]} and {verdicts[1]}, {len(losses)} changed, "
              f"{sum(loss > 0 for loss, _ in losses)} lose" + (f", median {statistics.median(l for l, _ in losses):+.3g}" if losses else ""))
        for loss, name in losses[:8] + losses[8:][-3:]:
            print(f"    {loss:+11.3g}  {name}")


def show_cost(results):
    for name in ("seconds", "memory"):
        runs = [run for run in results if run["codes"] == [0, 0] and None not in run[name]
                and (name == "memory" or min(run["seconds"]) > 0.15)]
        ratios = sorted((run[name][1] / run[name][0], run["name"]) for run in runs)
        if ratios:
            print(f"{name}, new to old, {len(ratios)} plans" + (" above 0.15 s" if name == "seconds" else "") +
                  f": median {ratios[len(ratios) // 2][0]:.3f}, from {ratios[0][0]:.3f} ({ratios[0][1]}) to {ratios[-1][0]:.3f} ({ratios[-1][1]})")


def write_table(path, results):
    with open(path, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(["document", "figure"] + [f"{what}_{side}" for what in ("value", "passed", "gap", "seconds", "mb") for side in ("old", "new")])
        for run in results:
            (name, *old), (_, *new) = run["figures"]
            pairs = list(zip(old, new)) + [tuple(run["seconds"]), tuple(run["memory"])]
            table.writerow([run["name"], name] + [value for pair in pairs for value in pair])


def show(results, tolerance, elapsed):
    worst, differing = {}, []
    for run in results:
        for group, (size, where) in run["found"].items():
            if size > worst.get(group, (-1, "", ""))[0]:
                worst[group] = (size, run["name"], where)
        counted = {g: d for g, d in run["found"].items() if d[0] > tolerance}
        if counted:
            differing.append((run["name"], counted))
    failed = False
    if differing:
        print(f"{'document':32} {'value':14} {'difference':>11}  where")
    for name, counted in differing:
        for group, (size, where) in sorted(counted.items()):
            informative = group in difference.INFORMATIVE
            failed |= not informative
            print(f"{name:32} {group:14} {size:11.3g}  {where}{' (does not count)' if informative else ''}")
    print("\nlargest differences, relative to the scale of each value:")
    for group, (size, name, where) in sorted(worst.items()):
        print(f"  {group:14} {size:11.3g}" + (f"  {name}: {where}" if size > 0 else ""))
    planned = sum(run["codes"] == [0, 0] for run in results)
    refused = [sum(run["codes"][side] != 0 for run in results) for side in (0, 1)]
    print(f"\n{len(results)} documents, {planned} planned by both; not planned: {refused[0]} by old, {refused[1]} by new")
    old, new = (sum(run["seconds"][side] for run in results) for side in (0, 1))
    slowest = max(results, key=lambda run: max(run["seconds"]))
    print(f"slowest document: {slowest['name']}, {slowest['seconds'][0]:.1f} s and {slowest['seconds'][1]:.1f} s")
    print(f"processor time: old {old:.1f} s, new {new:.1f} s, ratio {new / old:.3f}; {elapsed:.0f} s elapsed")
    show_figures(results)
    show_cost(results)
    return failed


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old", nargs="?", default="")
    parser.add_argument("new", nargs="?", default="")
    parser.add_argument("--random", type=int, default=500, help="random documents (500)")
    parser.add_argument("--each", type=int, default=0, help="random documents of every kind (0)")
    parser.add_argument("--table", metavar="FILE", help="a line of CSV per document")
    parser.add_argument("--seed", type=int, default=1, help="of the random documents (1)")
    parser.add_argument("--axes", type=int, default=0, help="random moves and programs on coarse and fine axes (0)")
    parser.add_argument("--jobs", type=int, default=2, help="documents planned at once (2)")
    parser.add_argument("--tolerance", type=float, default=1e-12, help="relative (1e-12)")
    parser.add_argument("--only", default="", help="documents whose name contains this")
    parser.add_argument("--write", metavar="DIR", help="only write the documents there")
    asked = parser.parse_args()
    every = [*documents.examples(), *documents.part_files(), *documents.random_documents(asked.random, asked.seed),
             *documents.axes_documents(asked.axes), *documents.of_every_kind(asked.each, asked.seed)]
    every = [(name, document) for name, document in every if asked.only in name]
    if asked.write:
        for name, document in every:
            path = pathlib.Path(asked.write) / (name.replace("/", "_").replace(" ", "_") + ".json")
            path.write_text(json.dumps(document, indent=1))
        return 0
    for binary in (asked.old, asked.new):
        if not os.access(binary, os.X_OK):
            parser.error(f"{binary} is not a program")
    if not every:
        parser.error("no document has such a name")
    begin = time.monotonic()
    with concurrent.futures.ProcessPoolExecutor(asked.jobs) as pool:
        runs = [pool.submit(both, (asked.old, asked.new), name, document) for name, document in every]
        results = [run.result() for run in runs]
    if asked.table:
        write_table(asked.table, results)
    return 1 if show(results, asked.tolerance, time.monotonic() - begin) else 0


if __name__ == "__main__":
    sys.exit(main())
