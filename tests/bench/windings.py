#!/usr/bin/env python3
"""Plans random windings with every feed and tells what came out and what it took.

    python3 tests/bench/windings.py build/release/bahnwerk
    python3 tests/bench/windings.py build/release/bahnwerk --check --count 100
    python3 tests/bench/windings.py build/release/bahnwerk --job examples/rotor_coil.json

A row per part: durations (s), gap of the optimised feed, processor time per turn. With --check: every part is planned
and verified, or refused by name with every feed alike, and optimised is no slower than critical_points, and that no
slower than constant. Exit 1 if any of that fails. Plain Python 3, standard library only.
"""
import argparse
import copy
import json
import pathlib
import random
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "compare"))
import planning
import random_winding

FEEDS = ("optimised", "critical_points", "constant", "natural")
ROUNDING = 1e-6  # relative
REFUSALS = {"semantic-violation", "infeasible", "unreachable-pose", "verification-failed"}


def plan(binary, document, feed):
    """The result or problem, and processor time, s."""
    document = copy.deepcopy(document)
    wanted = document["spec"].setdefault("feed", {})
    wanted["method"] = feed
    if feed == "constant" and not wanted.get("half_speed_curvature"):
        wanted["velocity"] = None  # it would be the feed itself; the largest one is looked for
    return planning.plan(binary, document)[:2]


def reason(answer):
    """Why nothing was planned, in a word, and the first sentence about it."""
    slug = answer.get("type", "?").rsplit("/", 1)[-1]
    texts = [f"{fault['pointer']} {fault['message']}" for fault in answer.get("errors", [])]
    return slug, " ".join([answer.get("detail", ""), *texts[:2]]).strip()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--count", type=int, default=20, help="random parts (20)")
    parser.add_argument("--first", type=int, default=0, help="the first of them (0)")
    parser.add_argument("--feeds", nargs="+", default=FEEDS)
    parser.add_argument("--job", nargs="*", help="these documents instead of random ones")
    parser.add_argument("--show", type=int, help="only print this random document")
    asked = parser.parse_args()

    def document(i):
        return {"kind": "winding", "spec": random_winding.spec(random.Random(f"winding/{i}"))}

    if asked.show is not None:
        print(json.dumps(document(asked.show), indent=1))
        return 0
    if asked.job:
        jobs = [(pathlib.Path(path).stem, json.loads(pathlib.Path(path).read_text())) for path in asked.job]
    else:
        jobs = [(str(i), document(i)) for i in range(asked.first, asked.first + asked.count)]
    print(f"{'part':16}{'machine':12}" + "".join(f"{feed:>17}" for feed in asked.feeds) + f"{'gap':>9}{'s/turn':>9}")
    failed = planned = 0
    gaps, refusals = [], {}
    for name, job in jobs:
        answers = {feed: plan(asked.binary, job, feed) for feed in asked.feeds}
        row = f"{name[:15]:16}{job['spec']['part']['type'][:1]}, {job['spec']['machine']['type'][:8]:9}"
        times = {}
        for feed, (answer, _) in answers.items():
            good = "summary" in answer and answer["verification"]["passed"]
            times[feed] = answer["summary"]["duration"] if good else None
            row += f"{times[feed]:17.4f}" if good else f"{reason(answer)[0][:16]:>17}"
        first, spent = answers[asked.feeds[0]]
        if times[asked.feeds[0]]:
            turns = len(first["details"].get("turns", [])) or (job["spec"]["coil"].get("turns") or 1) * job["spec"]["coil"].get("repeat", {"count": 1})["count"]
            gaps.append(first["bound"]["gap"])
            row += f"{gaps[-1]:9.2%}{spent / turns:9.3f}"
            planned += 1
        print(row, flush=True)
        faults = []
        for feed, (answer, _) in answers.items():
            if times[feed] is not None:
                continue
            slug, text = reason(answer)
            refusals[slug] = refusals.get(slug, 0) + 1
            if slug not in REFUSALS:
                faults.append(f"{feed}: {slug}: {text}")
            if feed == asked.feeds[0]:
                print(f"    {slug}: {text[:160]}")
            elif times[asked.feeds[0]] is not None:
                faults.append(f"{feed}: {slug}, but not {asked.feeds[0]}: {text[:200]}")
        order = [feed for feed in ("optimised", "critical_points", "constant") if times.get(feed)]
        for quick, slow in zip(order, order[1:]):
            if times[quick] > times[slow] * (1 + ROUNDING):
                faults.append(f"{quick} takes {times[quick] / times[slow] - 1:.3%} longer than {slow}")
        failed += bool(faults)
        for fault in faults:
            print(f"    FAILS  {fault}", flush=True)
    if gaps:
        gaps.sort()
        print(f"gap of {asked.feeds[0]}: median {gaps[len(gaps) // 2]:.2%}, worst {gaps[-1]:.2%}")
    print(f"{planned} of {len(jobs)} parts planned; refusals: {refusals}; {failed} parts fail")
    return 1 if asked.check and failed else 0


if __name__ == "__main__":
    sys.exit(main())
