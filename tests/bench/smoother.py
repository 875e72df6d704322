"""Whether `joint` moves the coarse axes more smoothly than `iterative` in the same time."""
import planning

MOST_STRETCH = 2
CYCLE = 2e-3  # s; durations are rounded up to whole ones


def energy(result):
    """The sum of ∫a² of the coarse axes, mm²/s³."""
    return sum(result["summary"]["coarse_smoothness"].values())


HEAD = f"{'contour':24} {'machine':7} {'joint, s':>10} {'iterative':>10} {'stretched':>10} {'∫a² iterat.':>12} {'∫a² joint':>12} {'quotient':>8}"


def smoother(program, name, which, document):
    """Plans document(method=…, …) by both, and tells in a line; whether the joint planner's coarse axes are smoother."""
    iterative = planning.plan(program, document(method="iterative"))[0]
    joint = planning.plan(program, document(method="joint", stretch=1))[0]
    if any("summary" not in r for r in (iterative, joint)):
        print(f"{name[:24]:24} {which:7} FAILS, no plan", flush=True)
        return False
    duration, shortest = iterative["summary"]["duration"], joint["summary"]["duration"]
    if duration > shortest:
        for stretch in (duration / shortest, max(1, (duration - CYCLE) / shortest)):
            joint = planning.plan(program, document(method="joint", stretch=min(stretch, MOST_STRETCH)))[0]
            if joint["summary"]["duration"] <= duration * (1 + 1e-9):
                break
    # A plan that is still shorter is slowed to that duration.
    quotient = min(1, joint["summary"]["duration"] / duration)
    ours, theirs = energy(joint) * quotient ** 3, energy(iterative)
    same = iterative["details"]["redundancy"]["fallbacks"] > 0  # the joint planner's own plan
    # An axis whose acceleration is a thousandth of its limit in the mean square stands still but for the solver's tolerance.
    coarse = document(method="joint", stretch=1)["spec"]["machine"]["coarse"]
    still = 1e-6 * duration * sum(a["acceleration"] ** 2 for a in coarse.values())
    ok = ours < max(theirs, still) or same
    print(f"{name[:24]:24} {which:7} {shortest:10.4f} {duration:10.4f} {joint['summary']['duration']:10.4f} {theirs:12.5g} {ours:12.5g} {ours / theirs:8.3f}"
          f"{' fell back' if same else '' if ok else '  FAILS'}", flush=True)
    return ok
