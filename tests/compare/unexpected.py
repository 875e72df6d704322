#!/usr/bin/env python3
"""Plans mutated documents of every kind in search of ends that nobody expected.

    tests/compare/unexpected.py BINARY [--count 1000] [--seed 1] [--limit 20] [--kind NAME] [--keep FOLDER]

Mutates the schemas' examples and random documents: numbers by decades or to the bounds of the schema, names to others of
their list, parts dropped, doubled, reversed, taken from other examples. What passes its checks is planned. Prints every
document that ended as `internal`, crashed, or took more than LIMIT seconds of processor time; keeps them in FOLDER.
Exit 0: none ended unexpectedly, 1: some did.
"""
import argparse
import collections
import copy
import json
import pathlib
import random
import resource
import subprocess
import sys

import random_contour
import random_curves
import random_slot
import random_winding

SCHEMAS = pathlib.Path(__file__).resolve().parents[2] / "schemas"


def properties():
    """Per name of a property: its schema, from all kinds."""
    found = collections.defaultdict(list)

    def walk(node):
        if isinstance(node, dict):
            for name, schema in node.get("properties", {}).items():
                if isinstance(schema, dict):
                    found[name].append(schema)
            for value in node.values():
                walk(value)
        elif isinstance(node, list):
            for value in node:
                walk(value)

    for path in SCHEMAS.glob("*.json"):
        if "result" not in path.name and path.name != "openapi.json":
            walk(json.loads(path.read_text()))
    return found


def seeds(kind):
    return [json.loads(path.read_text()) for path in sorted((SCHEMAS / "examples" / kind).glob("*.json"))]


def places(node, above=()):
    """Every value of a document with the keys that lead to it."""
    yield above
    if isinstance(node, dict):
        for key, value in node.items():
            yield from places(value, above + (key,))
    elif isinstance(node, list) and len(node) < 200:
        for i, value in enumerate(node):
            yield from places(value, above + (i,))


def at(document, place):
    for key in place:
        document = document[key]
    return document


def other_number(r, value, schemas):
    bounds = [s[k] for s in schemas for k in ("minimum", "maximum", "default") if isinstance(s.get(k), (int, float))]
    pick = r.random()
    if bounds and pick < 0.25:
        new = r.choice(bounds)
    elif pick < 0.5:
        new = value * r.uniform(0.5, 2)
    elif pick < 0.75:
        new = value * 10 ** r.uniform(-4, 4)
    elif pick < 0.85:
        new = -value
    else:
        new = r.choice([0, 1, 0.5, value + 1e-9, value * (1 + 1e-12), 1e-3, 1e3])
    return int(round(new)) if isinstance(value, int) and r.random() < 0.8 and abs(new) < 1e15 else new


def mutate(r, document, known, others):
    place = r.choice([p for p in places(document) if p])
    parent, key = at(document, place[:-1]), place[-1]
    value = parent[key]
    name = next((k for k in reversed(place) if isinstance(k, str)), "")
    schemas = known.get(name, [])
    choices = [c for s in schemas for c in s.get("enum", [])]
    pick = r.random()
    if isinstance(value, bool):
        parent[key] = not value
    elif isinstance(value, (int, float)):
        parent[key] = None if pick < 0.03 else other_number(r, value, schemas)
    elif isinstance(value, str):
        if choices:
            parent[key] = r.choice(choices)
    elif pick < 0.2 and isinstance(parent, dict):
        del parent[key]
    elif pick < 0.5:  # the same part of another example
        donors = [at(o, p) for o in others for p in places(o) if p and p[-1] == name]
        if donors and isinstance(key, str):
            parent[key] = copy.deepcopy(r.choice(donors))
    elif isinstance(value, list) and value:
        i = r.randrange(len(value))
        if pick < 0.65:
            value.insert(i, copy.deepcopy(value[i]))
        elif pick < 0.8:
            del value[i]
        elif pick < 0.9:
            value.reverse()
        else:
            j = r.randrange(len(value))
            value[i], value[j] = value[j], value[i]
    elif isinstance(value, dict) and schemas:  # an option that was not there
        options = [(n, s) for t in schemas for n, s in t.get("properties", {}).items() if n not in value and isinstance(s, dict)]
        donors = [at(o, p) for o in others for p in places(o) if p and p[-1] == name and isinstance(at(o, p), dict)]
        if donors and pick < 0.8:
            donor = r.choice(donors)
            if donor:
                n = r.choice(list(donor))
                value[n] = copy.deepcopy(donor[n])
        elif options:
            n, s = r.choice(options)
            value[n] = s.get("default", r.choice(s["enum"]) if "enum" in s else s.get("minimum", s.get("maximum", True)))


def document(r, kind, known, examples):
    pick = r.random()
    if pick < 0.6 or kind not in ("contour", "winding", "fill_factor"):
        spec = copy.deepcopy(r.choice(examples))
    elif kind == "contour":
        spec = (random_curves.spec(r, r.choice(random_curves.METHODS), count=3) if pick < 0.8 else random_contour.spec(r))
    else:
        spec = random_winding.spec(r) if kind == "winding" else random_slot.spec(r)
    for _ in range(r.choice([1, 1, 2, 3, 5])):
        mutate(r, spec, known, examples)
    return {"kind": kind, "spec": spec}


def end_of(binary, job, limit):
    def bound():
        resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 1))
        resource.setrlimit(resource.RLIMIT_AS, (3 << 30, 3 << 30))

    process = subprocess.run([binary, "plan", "-"], input=json.dumps(job), capture_output=True, text=True, preexec_fn=bound)
    if process.returncode == -24:
        return "slow", f"took more than {limit} s"
    try:
        result = json.loads(process.stdout)
    except ValueError:
        return "crash", f"exit {process.returncode} {process.stderr[-150:]}"
    if process.returncode == 0:
        return "planned", ""
    return result.get("type", "?").split("/")[-1], result.get("detail", "")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("binary")
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--limit", type=int, default=20)
    parser.add_argument("--kind")
    parser.add_argument("--keep", type=pathlib.Path)
    options = parser.parse_args()
    known = properties()
    kinds = [options.kind] if options.kind else sorted(p.name for p in (SCHEMAS / "examples").iterdir() if p.name != "job")
    examples = {kind: seeds(kind) for kind in kinds}
    ends, bad = collections.defaultdict(collections.Counter), False
    for i in range(options.count):
        r = random.Random(options.seed * 1000003 + i)
        kind = r.choice(kinds)
        job = document(r, kind, known, examples[kind])
        end, detail = end_of(options.binary, job, options.limit)
        ends[kind][end] += 1
        if end in ("internal", "crash", "slow", "verification-failed"):
            bad |= end in ("internal", "crash")
            print(f"{i} {kind} {end}: {detail[:200]}", flush=True)
            if options.keep:
                options.keep.mkdir(parents=True, exist_ok=True)
                (options.keep / f"{options.seed}_{i}_{kind}_{end}.json").write_text(json.dumps(job))
    for kind, counts in ends.items():
        print(kind, dict(counts))
    return bad


if __name__ == "__main__":
    sys.exit(main())
