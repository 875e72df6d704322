"""What differs between two plans of one document, in groups: {group: (largest difference, where)}.

A difference is relative to the scale of what is compared: a setpoint's to the largest magnitude in its column, a wire's
place to the largest coordinate of its layout, a check's value to its limit, other numbers to their own magnitude. Texts,
counts and verdicts that differ are infinitely different.
"""
import json
import math

# The verifier's figures and what accompanies the result: they are shown, but a better enclosure may change them.
INFORMATIVE = ("check values", "details", "drawings")


class Found(dict):
    def note(self, group, size, where):
        if size > self.get(group, (-1, ""))[0]:
            self[group] = (size, where)

    def number(self, group, old, new, scale, where):
        self.note(group, 0 if old == new else abs(old - new) / scale if scale > 0 else math.inf, where)

    def same(self, group, old, new, where):
        self.note(group, 0 if old == new else math.inf, f"{where}: {shorten(old)} became {shorten(new)}" if old != new else where)

    def tree(self, group, old, new, where, scale=None):
        """Every number to its own magnitude, or to `scale`; all else exactly."""
        if is_number(old) and is_number(new):
            own = scale or max(abs(old), abs(new))
            self.number(group, old, new, own, f"{where}: {old!r} became {new!r}" if old != new else where)
        elif isinstance(old, dict) and isinstance(new, dict):
            self.same(group, sorted(old), sorted(new), f"{where} members")
            for key in old.keys() & new.keys():
                self.tree(group, old[key], new[key], f"{where}/{key}", scale)
        elif isinstance(old, list) and isinstance(new, list):
            self.same(group, len(old), len(new), f"{where} length")
            for i, (a, b) in enumerate(zip(old, new)):
                self.tree(group, a, b, f"{where}/{i}", scale)
        else:
            self.same(group, old, new, where)


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def shorten(value):
    text = repr(value)
    return text if len(text) < 60 else text[:57] + "…"


def of_runs(codes, outs):
    found = Found()
    found.same("outcome", codes[0], codes[1], "exit code")
    texts = [(out / "stdout").read_text() for out in outs]
    if codes[0] != codes[1]:
        return found
    old, new = (json.loads(text) for text in texts)
    if codes[0] != 0:
        found.same("outcome", old.get("type"), new.get("type"), "problem")
        if texts[0] != texts[1]:
            found.tree("details", old, new, "problem")
        return found
    results(found, old, new)
    setpoints(found, *(out / "setpoints.csv" for out in outs))
    return found


def results(found, old, new):
    durations = [r["summary"].get("duration", 0) for r in (old, new)]
    found.tree("duration", durations[0], durations[1], "summary/duration")
    found.tree("summary", old["summary"], new["summary"], "summary")
    found.tree("bound", without(old["bound"], "gap"), without(new["bound"], "gap"), "bound")
    found.tree("bound", old["bound"]["gap"], new["bound"]["gap"], "bound/gap", 1)
    found.tree("setpoints", old.get("setpoints"), new.get("setpoints"), "setpoints")
    checks(found, old["verification"], new["verification"])
    details = [dict(r["details"]) for r in (old, new)]
    layouts(found, *(d.pop("layouts", []) for d in details))
    found.same("drawings", *(d.pop("drawings", None) for d in details), "drawings")
    found.tree("details", *details, "details", max(durations) or None)


def without(member, name):
    return {key: value for key, value in member.items() if key != name}


def checks(found, old, new):
    found.same("verdicts", old["passed"], new["passed"], "passed")
    names = [[check["name"] for check in v["checks"]] for v in (old, new)]
    found.same("verdicts", *names, "names of checks")
    for a, b in zip(old["checks"], new["checks"]):
        if a["name"] != b["name"]:
            continue
        for member in ("unit", "limit", "passed"):
            found.tree("verdicts", a[member], b[member], f"{a['name']}/{member}")
        found.tree("check values", a["value"], b["value"], a["name"], max(abs(a["limit"] or 0), abs(a["value"] or 0)) or None)
        found.tree("check values", a["at"], b["at"], f"{a['name']}, at")


def layouts(found, old, new):
    found.same("layouts", len(old), len(new), "layouts length")
    for i, (a, b) in enumerate(zip(old, new)):
        size = max((abs(c) for p in a["positions"] for c in p), default=1)
        for member in sorted(a.keys() | b.keys()):
            place = f"layouts/{i}/{member}"
            if member not in a or member not in b:
                found.same("layouts", member in a, member in b, place)
            elif member in ("positions", "regions"):
                found.tree("layouts", a[member], b[member], place, size)
            elif member in ("max_overlap", "allowed_overlap"):
                found.tree("layouts", a[member], b[member], place, a["wire"]["outer"])
            elif member == "total_overlap_area":
                found.tree("layouts", a[member], b[member], place, a["wire"]["outer"] ** 2)
            else:
                found.tree("layouts", a[member], b[member], place)


def setpoints(found, old, new):
    found.same("setpoints", old.exists(), new.exists(), "setpoints.csv")
    if not (old.exists() and new.exists()):
        return
    texts = [path.read_bytes() for path in (old, new)]
    if texts[0] == texts[1]:
        found.note("setpoints", 0, "every column")
        return
    rows = [text.split(b"\n") for text in texts]
    found.same("setpoints", rows[0][0], rows[1][0], "header")
    found.same("setpoints", len(rows[0]), len(rows[1]), "number of setpoints")
    names = rows[0][0].decode().strip().split(",")
    scale, worst = [0.0] * len(names), [(0.0, 0)] * len(names)
    for k in range(1, min(len(rows[0]), len(rows[1]))):
        if not (rows[0][k] and rows[1][k]):
            continue
        a, b = ([float(value) for value in side[k].split(b",")] for side in rows)
        for c, (x, y) in enumerate(zip(a, b)):
            scale[c] = max(scale[c], abs(x))
            if not abs(x - y) <= worst[c][0]:  # NaN counts
                worst[c] = (abs(x - y), k - 1)
    for c, (size, k) in enumerate(worst):
        found.number("setpoints", 0, size, scale[c], f"column {names[c]}, setpoint {k}")
