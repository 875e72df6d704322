#!/usr/bin/env python3
"""Measures processes that share a PostgreSQL store, whose server waits for the disk.

    tests/bench/shared_store.py BINARY [claims] [latency] [workers] [posts] [polls] [storing] [pauses]

All but `pauses` unless something is named. `claims` needs `ninja claims`. Each figure is printed with what it is of.
"""
import contextlib
import http.client
import json
import os
import pathlib
import socket
import statistics
import subprocess
import sys
import threading
import time

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS / "crash"), str(TESTS / "postgres")]
from database import Database, programs, until  # noqa: E402
from service import Service, example, half_circles  # noqa: E402

LONG_JOB = 120_000  # half circles; some 250 s on a core of its own
WORKER = ("--role", "worker", "--workers", "1", "--worker-nice", "0")


@contextlib.contextmanager
def server():
    with Database() as database:
        database.settings = "-c max_connections=100 -c shared_buffers=256MB"
        database.make()
        database.start()
        database.ask("CREATE DATABASE bahnwerk", "postgres")
        yield database


def median(times):
    times = sorted(times)
    return f"median {statistics.median(times) * 1e3:.1f} ms, 0.9 {times[int(0.9 * (len(times) - 1))] * 1e3:.1f} ms, longest {times[-1] * 1e3:.1f} ms, of {len(times)}"


def fill(database, jobs):
    """Puts copies of the one job into the queue."""
    database.ask(f"""
        SET search_path = bahnwerk;
        CREATE TEMP TABLE made AS SELECT (lpad(to_hex((extract(epoch FROM now()) * 1000)::bigint), 12, '0') || '7' || lpad(to_hex(k % 4096), 3, '0') || '8' ||
          lpad(to_hex(k), 15, '0'))::uuid AS id FROM generate_series(1, {jobs}) AS k;
        INSERT INTO jobs (id, kind, rank, turn, needs, state, created_at) SELECT made.id, kind, rank, turn, needs, 'queued', now() FROM made, (SELECT * FROM jobs LIMIT 1) AS j;
        INSERT INTO specs (id, document, checked) SELECT made.id, document, checked FROM made, (SELECT * FROM specs LIMIT 1) AS s;
        INSERT INTO count_deltas (state, owner, jobs) VALUES ('queued', '', {jobs});
        ANALYZE""")
    database.ask("CHECKPOINT")


def claims(binary):
    program = pathlib.Path(binary).parent / "tests" / "bench" / "claims"
    for setting in ("on", "off"):
        with server() as database:
            url = database.url + f"&options=-c%20synchronous_commit%3D{setting}"
            with Service(binary, "--role", "api", url=database.url) as service:
                service.post(example("line"))
                service.stop()
            fill(database, 100_000)
            run = lambda n, url=url: print(subprocess.run([program, url, str(n)], stdout=subprocess.PIPE, text=True, check=True).stdout, end="", flush=True)
            print(f"100 000 queued, synchronous_commit {setting}", flush=True)
            run(2_000)
            if setting == "on":
                continue
            old = subprocess.Popen([programs() / "psql", "-h", database.folder, "-U", "postgres", "-d", "bahnwerk", "-XAtqc",
                                    "BEGIN ISOLATION LEVEL REPEATABLE READ; SELECT count(*) FROM bahnwerk.jobs; SELECT pg_sleep(3600)"], **database.user)
            time.sleep(1)
            print("with a snapshot that is older than all of them", flush=True)
            run(20_000)
            old.kill()


def latency(binary):
    for words in ((), ("--store-notify", "off")):
        with server() as database, contextlib.ExitStack() as stack:
            one, other = (stack.enter_context(Service(binary, "--role", "api", *words, url=database.url)) for _ in range(2))
            stack.enter_context(Service(binary, *WORKER, *words, url=database.url))
            begins, ends = [], []
            for k in range(70):
                id = one.post(example("line"))
                accepted = time.time()
                job = other.json(f"/v1/jobs/{id}", Prefer="wait=30")
                told = time.time()
                if job["state"] != "succeeded":
                    raise SystemExit(job)
                begun, ended = (float(t) for t in database.ask(
                    f"SELECT extract(epoch FROM started_at) || ' ' || extract(epoch FROM finished_at) FROM bahnwerk.jobs WHERE id = '{id}'").split())
                if k >= 10:
                    begins.append(begun - accepted)
                    ends.append(told - ended)
                time.sleep(0.05 + 0.007 * (k % 20))
            print(f"{' '.join(words) or 'with signals'}: from the 202 to the claim at another process: {median(begins)}")
            print(f"{' '.join(words) or 'with signals'}: from the end to a waiter at another process: {median(ends)}", flush=True)
            stops = []
            for _ in range(10):
                id = one.post(half_circles(40_000))
                until(lambda id=id: one.json(f"/v1/jobs/{id}")["state"] == "running", "it runs")
                time.sleep(0.5)
                asked = time.time()
                other.ask("POST", f"/v1/jobs/{id}/cancel")
                one.wait(id)
                stops.append(time.time() - asked)
            print(f"{' '.join(words) or 'with signals'}: from a cancel at another process to the end: {median(stops)}", flush=True)


def workers(binary):
    for count in (1, 2, 1, 2):
        with server() as database, contextlib.ExitStack() as stack:
            api = stack.enter_context(Service(binary, "--role", "api", url=database.url))
            ids = [api.post(half_circles(3_000)) for _ in range(40)]
            start = time.monotonic()
            for _ in range(count):
                stack.enter_context(Service(binary, *WORKER, url=database.url))
            for id in ids:
                api.wait(id)
            print(f"{count} workers: 40 jobs in {time.monotonic() - start:.1f} s", flush=True)


class Asker(threading.Thread):
    """Sends one request again and again on a connection of its own, until the event."""

    def __init__(self, port, request, over, status):
        super().__init__(daemon=True)
        self.socket = socket.create_connection(("127.0.0.1", port))
        self.request, self.over, self.status, self.answers = request, over, status, 0
        self.start()

    def run(self):
        rest = b""
        while not self.over.is_set():
            self.socket.sendall(self.request)
            while b"\r\n\r\n" not in rest:
                rest += self.socket.recv(65536)
            head, rest = rest.split(b"\r\n\r\n", 1)
            size = int(next(line for line in head.lower().split(b"\r\n") if line.startswith(b"content-length")).split(b":")[1])
            while len(rest) < size:
                rest += self.socket.recv(65536)
            rest = rest[size:]
            if int(head.split()[1]) != self.status:
                raise SystemExit(head)
            self.answers += 1
        self.socket.close()


def rate(port, request, status, seconds=4):
    over = threading.Event()
    askers = [Asker(port, request, over, status) for _ in range(8)]
    time.sleep(seconds)
    over.set()
    for each in askers:
        each.join()
    return sum(each.answers for each in askers) / seconds


@contextlib.contextmanager
def both(binary):
    """A service with a store of each kind; nothing is planned. Each has `processes`, which gives those that work for it."""
    with server() as database, Service(binary, "--workers", "0", "--max-queued", "10000000") as own, \
            Service(binary, "--role", "api", "--max-queued", "10000000", url=database.url) as shared:
        own.processes = lambda: [own.process.pid]
        shared.processes = lambda: [shared.process.pid, *database.processes()]
        yield {"SQLite": own, "PostgreSQL": shared}


def processor_time(processes):
    """Seconds that these have used."""
    ticks = 0
    for process in processes:
        with contextlib.suppress(OSError):
            ticks += sum(map(int, pathlib.Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()[11:13]))
    return ticks / os.sysconf("SC_CLK_TCK")


def compare(services, what, requests, status, rounds=5, seconds=4):
    rates, costs = ({name: [] for name in services} for _ in range(2))
    for _ in range(rounds):
        for name, service in services.items():
            before = processor_time(service.processes())
            rates[name].append(rate(service.port, requests[name], status, seconds))
            costs[name].append((processor_time(service.processes()) - before) / (rates[name][-1] * seconds))
    (own, shared), (own_cost, shared_cost) = ([statistics.median(each[name]) for name in ("SQLite", "PostgreSQL")] for each in (rates, costs))
    print(f"{what}: SQLite {own:.0f}, PostgreSQL {shared:.0f} per s, {shared / own:.2f}; processor time of each {own_cost * 1e3:.3f} and {shared_cost * 1e3:.3f} ms, "
          f"{own_cost / shared_cost:.2f}; 8 connections, medians of {rounds} alternating turns of {seconds} s; load {os.getloadavg()[0]:.0f}", flush=True)


def posts(binary):
    for size in (400, 10_000):
        document = example("line")
        points = 1
        while len(json.dumps(document)) < size and size > 400:
            points += 20
            document["spec"]["contour"] = {"points": [[k % 97 / 10 + k, k % 89 / 10] for k in range(points)]}
        body = json.dumps(document, separators=(",", ":")).encode()
        request = b"POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: %d\r\n\r\n%b" % (len(body), body)
        with both(binary) as services:
            compare(services, f"posts of {len(body)} bytes", {name: request for name in services}, 202)


def polls(binary):
    with both(binary) as services:
        requests = {name: f"GET /v1/jobs/{service.post(example('line'))} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode() for name, service in services.items()}
        compare(services, "polls of a queued job", requests, 200)


def storing(binary):
    """A plan of some 100 MB beside posts of a neighbour."""
    with server() as database, contextlib.ExitStack() as stack:
        api = stack.enter_context(Service(binary, "--role", "api", url=database.url))
        stack.enter_context(Service(binary, *WORKER, url=database.url))
        id = api.post(large())
        times, began = [], None
        while True:
            job = api.json(f"/v1/jobs/{id}")
            if job["state"] not in ("queued", "running"):
                break
            if job.get("progress", {}).get("stage") == "storing" or began:
                began = began or time.monotonic()
                start = time.perf_counter()
                api.post(example("line"))
                times.append(time.perf_counter() - start)
            time.sleep(0.02)
        seconds = time.monotonic() - (began or time.monotonic())
        size = float(database.ask("SELECT sum(octet_length(data)) FROM bahnwerk.chunks")) / 1e6
        print(f"{job['state']}: {size:.0f} MB of chunks stored in {seconds:.1f} s, {size / max(seconds, 1e-3):.0f} MB/s; posts beside it: {median(times or [0])}", flush=True)


def large():
    """A document whose setpoints take some 100 MB: 628 mm at 0.13 mm/s, a row each ms."""
    document = half_circles(200)
    for axis in document["spec"]["machine"]["axes"].values():
        axis["velocity"] = 0.13
    return document


def pauses(binary):
    """The server stands still for 60 s, three times within one long job."""
    with server() as database, contextlib.ExitStack() as stack:
        apis = [stack.enter_context(Service(binary, "--role", "api", url=database.url)) for _ in range(2)]
        for _ in range(2):
            stack.enter_context(Service(binary, *WORKER, "--max-planning-time", "3600", url=database.url))
        document = half_circles(LONG_JOB)
        document["spec"]["planning"] = {"method": "jerk_limited"}
        for axis in document["spec"]["machine"]["axes"].values():
            axis["jerk"] = 200_000
        id = apis[0].post(document)
        until(lambda: apis[1].json(f"/v1/jobs/{id}")["state"] == "running", "it runs")
        start = time.monotonic()
        for _ in range(3):
            database.pause()
            time.sleep(60)
            database.resume()
            until(lambda: all(each.ask("GET", "/readyz")[0] == 200 for each in apis), "all are ready")
            print(f"a pause; {apis[0].json(f'/v1/jobs/{id}')['state']} in attempt " + database.ask(f"SELECT attempt FROM bahnwerk.jobs WHERE id = '{id}'"), flush=True)
            time.sleep(2)
        job = apis[1].wait(id, 3600)
        print(f"{job['state']} {(job['error'] or {}).get('type', '')} after {time.monotonic() - start:.0f} s in attempt " + database.ask(f"SELECT attempt FROM bahnwerk.jobs WHERE id = '{id}'"), flush=True)


def main():
    parts = {each.__name__: each for each in (claims, latency, workers, posts, polls, storing, pauses)}
    for name in sys.argv[2:] or [name for name in parts if name != "pauses"]:
        parts[name](sys.argv[1])


if __name__ == "__main__":
    main()
