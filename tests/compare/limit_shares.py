#!/usr/bin/env python3
"""Counts over all rows which limit each belongs to and compares the shares of time with those of /limits.

    python3 tests/compare/limit_shares.py build/release/bahnwerk FILE… [--cycle 0.002] [--tolerance 1e-3]

A file is a part program or, with the suffix .json, a contour or a job with one. Each is planned with time_optimal and with jerk_limited. The limits come from the document that is posted, the
feeds from the list of blocks, the rows from format=f64; nothing of /limits is used but its times. Prints a line per plan
and exits with 1 if the share of some limit differs by more than the tolerance. Plain Python 3, standard library only.
"""
import argparse
import array
import json
import pathlib
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request

AXES = {"x": {"velocity": 500, "acceleration": 5000, "jerk": 250000}, "y": {"velocity": 500, "acceleration": 5000, "jerk": 250000},
        "z": {"velocity": 300, "acceleration": 3000, "jerk": 150000}}
REACHED, REST = 0.98, 1e-9


class Service:
    """A service of its own, on a free port with an empty store."""

    def __init__(self, binary, folder):
        log = open(folder / "log", "w+")
        self.process = subprocess.Popen([binary, "serve", "--listen", "127.0.0.1:0", "--store", f"sqlite:{folder}/store.db"],
                                        stderr=log)
        for _ in range(600):
            for line in (folder / "log").read_text().splitlines():
                record = json.loads(line)
                if record.get("event") == "listening":
                    self.url = "http://" + record["address"]
                    return
            time.sleep(0.1)
        raise RuntimeError("the service does not listen")

    def get(self, path, body=None):
        request = urllib.request.Request(self.url + path, data=body, headers={"Content-Type": "application/json"})
        with urllib.request.urlopen(request, timeout=600) as answer:
            return answer.read(), answer.headers

    def json(self, path, body=None):
        return json.loads(self.get(path, body)[0])

    def planned(self, document):
        id = self.json("/v1/jobs", json.dumps(document).encode())["id"]
        while True:
            job = self.json(f"/v1/jobs/{id}")
            if job["state"] not in ("queued", "running"):
                return job
            time.sleep(0.2)


def contour(file):
    text = file.read_text(errors="replace")
    if file.suffix != ".json":
        return {"gcode": text}
    read = json.loads(text)
    read = read.get("spec", read)
    return read.get("contour", read)


def document(contour, jerk, cycle):
    axes = {name: {**limits, "jerk": limits["jerk"] if jerk else None} for name, limits in AXES.items()}
    return {"kind": "contour", "spec": {
        "contour": contour,
        "machine": {"kinematics": "cartesian", "axes": axes, "cycle_time": cycle},
        "planning": {"method": "jerk_limited" if jerk else "time_optimal", "corner": {"mode": "blend", "tolerance": 0.02}}}}


def feeds(service, id):
    """The feed of each block; None: none."""
    found, first = {}, 0
    while True:
        page = service.json(f"/v1/jobs/{id}/blocks?by=block&first={first}&count=1000")
        found.update((block["block"], block["feed"]) for block in page["blocks"])
        first += len(page["blocks"])
        if first >= page["total"]:
            return found


def count(service, id, jerk, cycle):
    """Share of the time of each limit and state, by its name."""
    body, headers = service.get(f"/v1/jobs/{id}/setpoints?format=f64")
    names = headers["X-Columns"].split(",")
    flat = array.array("d", body)
    if sys.byteorder == "big":
        flat.byteswap()
    table = {name: flat[k::len(names)] for k, name in enumerate(names)}
    rows, feed_of = len(table["v"]), feeds(service, id)
    axes = [name for name in AXES if name in table]
    limits = []  # name, share of each row
    for order, prefix in (("velocity", "v"), ("acceleration", "a")):
        for axis in axes:
            scale = 1 / AXES[axis][order]
            limits.append((f"{order} {axis}", [abs(value) * scale for value in table[prefix + axis]]))
    if jerk:
        for axis in axes:
            values, scale = table["a" + axis], 1 / (cycle * AXES[axis]["jerk"])
            steps = [abs(after - now) * scale for now, after in zip(values, values[1:])]
            limits.append((f"jerk {axis}", steps + steps[-1:]))
    times = {}
    for k in range(rows - 1):
        best, name = 0.0, None
        feed = feed_of.get(int(table["block"][k]))
        if feed:
            best, name = abs(table["v"][k]) / feed, "feed"
        for each, shares in limits:
            if shares[k] > best:
                best, name = shares[k], each
        if best < REACHED:
            rest = abs(table["v"][k]) <= REST
            name = "ahead" if not rest else "dwell" if abs(table["v"][k + 1]) <= REST else "stop"
        times[name] = times.get(name, 0) + 1
    return {name: number / (rows - 1) for name, number in times.items()}, rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("binary")
    parser.add_argument("files", nargs="+", type=pathlib.Path)
    parser.add_argument("--cycle", type=float, default=0.002, help="s")
    parser.add_argument("--tolerance", type=float, default=1e-3, help="share of the time")
    options = parser.parse_args()
    wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        service = Service(options.binary, pathlib.Path(folder))
        try:
            for file in options.files:
                for jerk in (False, True):
                    label = f"{file.name:40} {'jerk_limited' if jerk else 'time_optimal':12}"
                    try:
                        job = service.planned(document(contour(file), jerk, options.cycle))
                    except urllib.error.HTTPError as error:
                        print(label, "refused:", json.load(error)["detail"][:100], flush=True)
                        continue
                    if job["state"] != "succeeded":
                        print(label, job["state"], flush=True)
                        continue
                    counted, rows = count(service, job["id"], jerk, options.cycle)
                    told = {each["name"]: each["share"] for each in service.json(f"/v1/jobs/{job['id']}/limits")["limits"]}
                    worst = max(set(counted) | set(told), key=lambda name: abs(counted.get(name, 0) - told.get(name, 0)))
                    apart = abs(counted.get(worst, 0) - told.get(worst, 0))
                    wrong += apart > options.tolerance
                    most = max(counted, key=counted.get)
                    print(label, f"{rows:8} rows, most: {most} {100 * counted[most]:.2f} %, largest difference: {worst} {100 * apart:.4f} %",
                          flush=True)
        finally:
            service.process.terminate()
            service.process.wait()
    sys.exit(1 if wrong else 0)


main()
