"""Job documents to plan with two binaries: those of the project, and random ones, the same in every run."""
import json
import pathlib
import random

import coarse_fine_properties
import random_contour
import random_curves
import random_law
import random_probe
import random_slot
import random_winding

ROOT = pathlib.Path(__file__).resolve().parents[2]
JERK = {"method": "jerk_limited", "corner": {"mode": "blend", "tolerance": 0.02}}


def read(path):
    return json.loads(path.read_text())


def examples():
    """Name and document of every example of the project that a binary accepts."""
    for path in sorted(ROOT.glob("examples/*.json")):
        yield path.stem, read(path)
    for path in sorted(ROOT.glob("schemas/examples/*/*.json")):
        document = read(path)
        kind = path.parent.name
        if kind == "job":
            document.pop("deadline", None)  # may have passed
        else:
            document = {"kind": kind, "spec": document}
        if "robustness" in document["spec"]:  # every wire, each sampled 20 times, takes minutes
            document["spec"].update(robustness={"samples": 2, "slot_tolerance": 0.03}, wire_range={"least": 1.25, "most": 1.4})
        yield f"{kind}/{path.stem}", document


def part_files():
    """The part files, each on the machine that cuts it; those of moderate length once more, rounded and with limited jerk."""
    parts = ROOT / "examples" / "parts"
    laser, mill = read(parts / "laser.json"), read(parts / "mill.json")
    for path in sorted(parts.iterdir()):
        if path.suffix == ".json":
            yield f"parts/{path.name}", read(path)
            continue
        job = json.loads(json.dumps(mill if path.stem == "thread" else laser))
        form = "dxf" if path.suffix == ".dxf" else "gcode"
        job["spec"]["contour"] = {form: path.read_text(), "feed": 100}
        if path.stem == "sheet":
            job["spec"]["machine"]["cycle_time"] = 0.004
        yield f"parts/{path.name}", job
        if path.stem in ("bracket", "gear", "lettering"):
            job = json.loads(json.dumps(job))
            for axis in job["spec"]["machine"]["axes"].values():
                axis["jerk"] = 1e6
            job["spec"]["planning"] = JERK
            yield f"parts/{path.name}, jerk", job


def random_winding_spec(r):
    """A winding with any feed."""
    spec = random_winding.spec(r)
    spec["feed"].update(method=r.choice(["optimised", "critical_points", "constant", "natural"]),
                        profile=r.choice(["double_s", "trapezoid", "trigonometric"]))
    return spec


LAWS = [random_law.monotone, random_law.first_angle, random_law.drive, random_law.lengths, random_law.free_ends, random_law.nested,
        random_law.strokes]
OF_KINDS = {
    "contour": lambda r, i: random_curves.spec(r, random_curves.METHODS[i // 4 % 3]) if i % 4 == 3 else random_contour.spec(r),
    "fill_factor": lambda r, i: random_slot.spec(r),
    "motion_law": lambda r, i: LAWS[i % len(LAWS)](r),
    "probe_path": lambda r, i: random_probe.spec(r),
    "winding": lambda r, i: random_winding_spec(r),
}


def of_every_kind(count, seed):
    """`count` documents of each kind, of any form that a generator has."""
    for kind, spec in OF_KINDS.items():
        for i in range(count):
            yield f"{kind} #{i}", {"kind": kind, "spec": spec(random.Random(f"{seed}/{kind}/{i}"), i)}


def random_documents(count, seed):
    """`count` documents, one in five a slot; and for one in ten a winding more, with any feed. Each has a generator of its
    own: one more does not change the others."""
    for i in range(count):
        if i % 10 == 3:
            yield f"winding {i}", {"kind": "winding", "spec": random_winding_spec(random.Random(f"{seed}/winding/{i}"))}
        generator = random.Random(f"{seed}/{i}")
        if i % 5 == 4:
            yield f"slot {i}", {"kind": "fill_factor", "spec": random_slot.spec(generator)}
        else:
            yield f"contour {i}", {"kind": "contour", "spec": random_contour.spec(generator)}


def axes_documents(count):
    """`count` lone moves and programs on machines with coarse and fine axes, each by one of the methods."""
    for i in range(count):
        document, jerk, _ = coarse_fine_properties.case(i // 2, coarse_fine_properties.METHODS[i % len(coarse_fine_properties.METHODS)], i % 2 == 1)
        if not jerk or document["spec"]["machine"]["redundancy"]["method"] in coarse_fine_properties.WITH_JERK:
            yield f"axes {i}", document
