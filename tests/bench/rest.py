#!/usr/bin/env python3
"""Memory of a service: beside slow readers, a minute after planning all examples, a minute after documents that need too much.

    tests/bench/rest.py BINARY [--readers 100] [--wait 60] [--part readers|examples|bombs]

readers: READERS clients read 50 MB of setpoints slowly; limit: 64 MB above idle. examples: all examples are planned on two
workers; limit: 80 MB at rest. bombs: documents that take the memory, with a post of a neighbour beside each (limit: 100 ms in the
median of ten); limit: 80 MB at rest. Exit 1: a limit does not hold.
"""
import argparse
import json
import pathlib
import socket
import statistics
import sys
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "crash"))
from service import EXAMPLES, Service, example

faults = []


def tell(what, value, limit, unit="MB"):
    print(f"{what}: {value:.0f} {unit}, limit {limit} {unit}", flush=True)
    if value > limit:
        faults.append(what)


def readers(binary, count):
    with Service(binary, "--workers", "1", "--worker-nice", "0", "--max-connections-per-address", "0", "--write-timeout", "3600") as service:
        idle = service.resident()
        document = example("line")
        document["spec"]["contour"]["blocks"][0]["feed"] = 0.1  # some 10^6 rows
        job = service.wait(service.post(document))
        if job["state"] != "succeeded":
            raise SystemExit(job)
        time.sleep(3)  # the room of the plan is given back
        size, open_sockets = 0, []
        for _ in range(count):
            reader = socket.create_connection(("127.0.0.1", service.port))
            reader.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            reader.sendall(f"GET /v1/jobs/{job['id']}/setpoints HTTP/1.1\r\nHost: localhost\r\nAccept: text/csv\r\n\r\n".encode())
            open_sockets.append(reader)
        most, until = 0.0, time.monotonic() + 10
        while time.monotonic() < until:
            for reader in open_sockets:
                size += len(reader.recv(2000))
            most = max(most, service.resident())
            time.sleep(0.1)
        tell(f"{count} readers of {job['id'][:8]}, above {idle:.0f} MB", most - idle, 64)


def examples(binary, seconds):
    with Service(binary, "--workers", "2", "--worker-nice", "0") as service:
        jobs = []
        for path in sorted(EXAMPLES.glob("**/*.json")):
            document = json.loads(path.read_text())
            if "spec" in document:
                jobs.append(service.post(document))
        states = [service.wait(job)["state"] for job in jobs]
        time.sleep(seconds)
        tell(f"at rest after {states.count('succeeded')} of {len(jobs)} examples", service.resident(), 80)


def bomb_documents():
    axis = {"velocity": 1800, "acceleration": 16000, "jerk": 500000}

    def contour(what, axes="xy", method="time_optimal"):
        return {"kind": "contour", "spec": {"contour": what, "planning": {"method": method}, "machine": {
            "kinematics": "cartesian", "cycle_time": 0.001, "axes": {name: axis for name in axes}}}}

    loop = ("G21 G90 F60000\nG1 X0 Y0\n#1=0\no1 repeat [400000]\nG2 X[#1+2] Y0 I1 J0\nG3 X[#1+4] Y0 I1 J0\n#1=[#1+4]\no1 endrepeat\nM2\n")
    yield "dwell", contour({"start": [0, 0, 0], "blocks": [{"mode": "cut", "segments": [{"line": [10, 0, 0]}, {"dwell": 15000}]}]}, "xyz")
    yield "loop", contour({"gcode": loop})
    yield "loop, jerk", contour({"gcode": loop}, method="jerk_limited")
    yield "points", contour({"points": [[0.01 * k, (k * 7919) % 13] for k in range(900_000)]})


def bombs(binary, seconds):
    with Service(binary, "--workers", "2", "--worker-nice", "0", "--max-memory", "700MiB") as service:
        line = example("line")
        for name, document in bomb_documents():
            job = []
            poster = threading.Thread(target=lambda: job.append(service.ask("POST", "/v1/jobs", document)))
            poster.start()
            times = []
            for _ in range(10):
                begin = time.monotonic()
                service.post(line)
                times.append(1000 * (time.monotonic() - begin))
                time.sleep(0.2)
            poster.join()
            status, _, body = job[0]
            if status == 202:
                job = json.loads(body)["id"]
                ended = service.wait(job, 20)["state"]
                if ended == "running":
                    service.ask("POST", f"/v1/jobs/{job}/cancel")
                    service.wait(job)
            tell(f"post beside {name} ({status}), largest {max(times):.0f} ms, median", statistics.median(times), 100, "ms")
        time.sleep(seconds)
        tell("at rest after the documents", service.resident(), 80)


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("binary")
    arguments.add_argument("--readers", type=int, default=100)
    arguments.add_argument("--wait", type=float, default=60)
    arguments.add_argument("--part", choices=["readers", "examples", "bombs"])
    options = arguments.parse_args()
    if options.part in (None, "readers"):
        readers(options.binary, options.readers)
    if options.part in (None, "examples"):
        examples(options.binary, options.wait)
    if options.part in (None, "bombs"):
        bombs(options.binary, options.wait)
    sys.exit(bool(faults))


if __name__ == "__main__":
    main()
