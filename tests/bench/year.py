#!/usr/bin/env python3
"""Makes the store of a year and measures a service on it.

    tests/bench/year.py BINARY [--jobs 1000000] [--posts 300] [--keep FILE]

One job is planned, and its rows are copied by SQL: ids and times are spread over the last 365 days, 98 % succeeded, the others
failed or were cancelled; document, result and setpoints of each are those of the planned one (about 3 kB). FILE is used again
if it is there. Times are the median and the largest of 20 questions. The retention removes what is older than 364 days while 5
jobs per second are posted, and a backup is made beside them.
"""
import argparse
import os
import pathlib
import shutil
import sqlite3
import statistics
import subprocess
import sys
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "crash"))
from service import Service, example

YEAR = 365 * 86_400_000  # ms
NUMBERS = "WITH RECURSIVE n(k) AS (SELECT 1 UNION ALL SELECT k + 1 FROM n WHERE k < ?1)"


def make(binary, path, jobs):
    with Service(binary, "--workers", "1", "--worker-nice", "0", store=path) as service:
        service.wait(service.post({**example("line"), "name": "plate", "reference": "R0"}))
        service.stop()
    start, step = int(time.time() * 1000) - YEAR, YEAR / jobs
    with sqlite3.connect(path) as store:
        store.execute("PRAGMA synchronous = OFF")
        store.execute("PRAGMA cache_size = -200000")
        columns = [row[1] for row in store.execute("PRAGMA table_info(jobs)")]
        ms = f"({start} + CAST(k * {step} AS INTEGER))"
        own = {
            "seq": "old.seq + k",
            "id": f"printf('%08x-%04x-7%03x-8000-%012x', {ms} >> 16, {ms} & 65535, k & 4095, k)",
            "reference": "'R' || (k / 10)",
            "state": "CASE k % 100 WHEN 0 THEN 'failed' WHEN 1 THEN 'cancelled' ELSE 'succeeded' END",
            "error": "CASE WHEN k % 100 < 2 THEN '{\"type\":\"/problems/infeasible\"}' END",
            "changed": "old.changed + k",
            "created_at": ms, "started_at": f"{ms} + 5", "finished_at": f"{ms} + 25",
        }
        store.execute(f"{NUMBERS} INSERT INTO jobs ({', '.join(columns)}) SELECT "
                      f"{', '.join(own.get(name, 'old.' + name) for name in columns)} FROM n, jobs AS old WHERE old.seq = 1", (jobs,))
        for table in ("specs", "results", "chunks"):
            columns = [row[1] for row in store.execute(f"PRAGMA table_info({table})")]
            values = ["k + 1" if name == "seq" else "old." + name for name in columns]
            store.execute(f"{NUMBERS} INSERT INTO {table} ({', '.join(columns)}) SELECT {', '.join(values)} "
                          f"FROM {table} AS old, n WHERE old.seq = 1", (jobs,))


def asked(service, path):
    times = []
    for _ in range(20):
        begin = time.perf_counter()
        status, _, _ = service.ask("GET", path)
        times.append(1000 * (time.perf_counter() - begin))
        if status != 200:
            raise SystemExit(f"{path} answers {status}")
    print(f"{path}: {statistics.median(times):.1f} ms, at most {max(times):.1f} ms")


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("binary")
    arguments.add_argument("--jobs", type=int, default=1_000_000)
    arguments.add_argument("--posts", type=int, default=300)
    arguments.add_argument("--keep")
    options = arguments.parse_args()
    folder = pathlib.Path(options.keep).parent if options.keep else pathlib.Path("/tmp")
    path = folder / f"year-{os.getpid()}.db"
    if options.keep and os.path.exists(options.keep):
        shutil.copy(options.keep, path)
    else:
        begin = time.time()
        make(options.binary, path, options.jobs)
        print(f"{options.jobs} jobs made in {time.time() - begin:.0f} s, {path.stat().st_size >> 20} MiB")
        if options.keep:
            shutil.copy(path, options.keep)
    with Service(options.binary, "--workers", "1", "--worker-nice", "0", store=path) as service:
        service.kill()
        print(f"start: {service.start():.2f} s")
        page = service.json("/v1/jobs?limit=50")["next"]
        for question in ("limit=50", f"limit=50&cursor={page}", "kind=contour&limit=50", "state=failed&limit=50", "reference=R500",
                         "state=cancelled&kind=contour&limit=50", "created_before=2020-01-01T00:00:00Z"):
            asked(service, "/v1/jobs?" + question)
        asked(service, "/metrics")
        service.stop()
    with Service(options.binary, "--workers", "1", "--worker-nice", "0", "--keep-for", "364d", store=path) as service:
        def metric(name):
            lines = service.ask("GET", "/metrics")[2].decode().splitlines()
            return sum(float(line.split()[-1]) for line in lines if line.startswith(name))
        before, begin, slowest = metric("bahnwerk_jobs{"), time.monotonic(), [0.0]
        def posts():
            for k in range(options.posts):
                time.sleep(max(0.0, begin + 0.2 * k - time.monotonic()))
                at = time.monotonic()
                service.post(example("line"))
                slowest[0] = max(slowest[0], time.monotonic() - at)
        poster = threading.Thread(target=posts)
        poster.start()
        copied = subprocess.run([options.binary, "backup", str(path) + ".copy", "--store", f"sqlite:{path}"], capture_output=True, text=True)
        backup = time.monotonic() - begin
        poster.join()
        while metric("bahnwerk_retention_caught_up_timestamp_seconds") < time.time() - 15 and time.monotonic() - begin < 600:
            time.sleep(1)
        print(f"{options.posts} posts, the retention has caught up after {time.monotonic() - begin:.0f} s, slowest {1000 * slowest[0]:.0f} ms; jobs {before:.0f} -> {metric('bahnwerk_jobs{'):.0f}; "
              f"backup {'in %.1f s' % backup if copied.returncode == 0 else copied.stderr}; {service.resident():.0f} MB")
    for each in folder.glob(path.name + "*"):
        each.unlink()


if __name__ == "__main__":
    main()
