#!/usr/bin/env python3
"""Lets a service work for a time and tells its memory at the begin and at the end, which has to be flat.

    tests/bench/soak.py BINARY [--seconds 600] [--growth 8]

Three clients post small contours, laws and slots, poll, read results, cancel and delete; the retention keeps 500 jobs. The
memory at the begin is the largest at rest after a tenth of the time. Exit 1: it has grown by more than GROWTH MB, or jobs failed.
"""
import argparse
import pathlib
import random
import sys
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "crash"))
from service import Service, example, half_circles

NAMES = ["line", "circle", "bracket", "pick_and_place", "rotor_slot"]


def client(service, seed, until, failed):
    choose = random.Random(seed)
    documents = [example(name) for name in NAMES] + [half_circles(60)]
    while time.monotonic() < until():
        status, _, body = service.ask("POST", "/v1/jobs", choose.choice(documents), {"Prefer": "wait=20"})
        if status != 202:
            time.sleep(1)
            continue
        job = service.json("/v1/jobs?limit=1")["jobs"][0]["id"]
        action = choose.random()
        if action < 0.1:
            service.ask("POST", f"/v1/jobs/{job}/cancel")
        elif action < 0.2:
            service.ask("DELETE", f"/v1/jobs/{job}")
        elif action < 0.6:
            service.ask("GET", f"/v1/jobs/{job}/setpoints", headers={"Accept": "text/csv"})
            service.ask("GET", f"/v1/jobs/{job}/result", headers={"Accept-Encoding": "gzip"})
        failed.extend(each["id"] for each in service.json("/v1/jobs?state=failed&limit=3")["jobs"])


def at_rest(service):
    """Memory once nothing is planned and its room was given back, MB."""
    while service.json("/v1/jobs?state=queued&limit=1")["jobs"] or service.json("/v1/jobs?state=running&limit=1")["jobs"]:
        time.sleep(0.2)
    time.sleep(3)
    return service.resident()


def work(service, seconds, seed, failed):
    end = time.monotonic() + seconds
    clients = [threading.Thread(target=client, args=(service, seed + n, lambda: end, failed)) for n in range(3)]
    for each in clients:
        each.start()
    for each in clients:
        each.join()
    return at_rest(service)


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("binary")
    arguments.add_argument("--seconds", type=float, default=600)
    arguments.add_argument("--growth", type=float, default=8)
    options = arguments.parse_args()
    failed = []
    with Service(options.binary, "--workers", "2", "--keep-jobs", "500", "--worker-nice", "0") as service:
        idle = service.resident()
        begin = work(service, options.seconds / 10, 1, failed)
        end = work(service, options.seconds * 9 / 10, 1000, failed)
        plans = service.planned()
    print(f"{options.seconds:.0f} s, {plans:.0f} plans: {idle:.1f} MB before the first request, {begin:.1f} MB at the begin, "
          f"{end:.1f} MB at the end, {len(failed)} failed")
    sys.exit(end > begin + options.growth or bool(failed))


if __name__ == "__main__":
    main()
