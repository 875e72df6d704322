#!/usr/bin/env python3
"""All jobs of an SQLite store are moved to a PostgreSQL server and back, by a command that is killed again and again.

    tests/postgres/moves.py BINARY
    tests/postgres/moves.py BINARY --megabytes 1000     # measures instead: both ways with so much, on a server that waits for its disk
    tests/postgres/moves.py BINARY --megabytes 1000 --kills 2     # the command is killed so often on each way, after equal shares of the jobs

A service answers every question about ended jobs as before, and plans the others. Exit 77: there is no server.
"""
import argparse
import hashlib
import json
import os
import pathlib
import random
import sqlite3
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "crash"))
from database import Database, programs, until  # noqa: E402
from service import Service, example, half_circles  # noqa: E402

LONG = half_circles(20_000)


def expect(condition, what):
    if not condition:
        raise SystemExit(f"wrong: {what}")


def say(text):
    print(text, flush=True)


def command(binary, *arguments):
    return subprocess.run([binary, *arguments], capture_output=True, text=True)


def sizes(path):
    with sqlite3.connect(path) as store:
        return store.execute("SELECT (SELECT count(*) FROM jobs), (SELECT sum(length(data)) FROM chunks)").fetchone()


def multiply(path, megabytes, least, kinds=1):
    """Repeats the largest jobs that succeeded in turn, so many `kinds` of them, with new ids, until the copies have so many MB of setpoints, and are as many as
    `least`."""
    with sqlite3.connect(path) as store:
        largest = store.execute("SELECT seq, sum(length(data)) FROM chunks GROUP BY seq ORDER BY 2 DESC LIMIT ?", (kinds,)).fetchall()
        columns = [row[1] for row in store.execute("PRAGMA table_info(jobs)") if row[1] not in ("seq", "id", "changed")]
        names, number, left = ", ".join(columns), 0, megabytes * 1e6
        while number < least or left > 0:
            seq, size = largest[number % len(largest)]
            left -= size
            id = f"{int(time.time() * 1000):012x}"
            id = f"{id[:8]}-{id[8:]}-7000-8000-{number:012x}"
            row = store.execute(f"INSERT INTO jobs (id, {names}) SELECT ?, {names} FROM jobs WHERE seq = ?", (id, seq)).lastrowid
            for table, values in (("specs", "spec, whole"), ("results", "document, columns, row_count, chunk_rows, cycle_time, views"),
                                  ("chunks", "first_row, row_count, data"), ("views", "name, part, data")):
                store.execute(f"INSERT INTO {table} (seq, {values}) SELECT ?, {values} FROM {table} WHERE seq = ?", (row, seq))
            number += 1
            if number % 100 == 0 or size > 1e6:
                store.commit()
    store.close()


def answers(service, ids):
    """What the service says of these jobs."""
    found = {}
    for id in ids:
        texts = [service.ask("GET", f"/v1/jobs/{id}{path}", headers=headers) for path, headers in (
            ("", {}), ("/spec", {}), ("/result", {}), ("/setpoints", {"Accept": "application/octet-stream"}), ("/setpoints?points=50", {}))]
        found[id] = [(code, hashlib.sha256(body).hexdigest(), headers["ETag"]) for code, headers, body in texts]
    return found


def move_killed(binary, here, there, seed, seconds):
    """Moves, killed after random times until `seconds` have passed in all; returns the number of kills and the last output."""
    choose, kills, spent = random.Random(seed), 0, 0.0
    while True:
        with tempfile.TemporaryFile("w+") as out:
            process = subprocess.Popen([binary, "migrate-store", here, there], stdout=out, stderr=subprocess.STDOUT)
            patience = choose.uniform(0, seconds / 6)
            try:
                process.wait(patience if spent < seconds else None)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
                kills, spent = kills + 1, spent + patience
                continue
            out.seek(0)
            text = out.read()
            expect(process.returncode == 0, f"the move ends with {process.returncode}: {text}")
            return kills, json.loads(text[text.index("{"):])


def refused(binary, why, here, there, text):
    done = command(binary, "migrate-store", here, there)
    expect(done.returncode == 2 and text in done.stderr, f"{why}: {done.returncode} {done.stdout} {done.stderr}")


def fill(binary, folder):
    """Makes a store with jobs that have ended, that wait, and one that was running when the process was killed."""
    path = folder / "source.db"
    with Service(binary, "--workers", "1", "--worker-nice", "0", store=path) as service:
        keyed = {}
        for number in range(12):
            document = example("line") if number % 3 else half_circles(200)
            document["reference"], document["priority"] = f"WO-{number}", 9
            keyed[str(number)] = document
            expect(service.ask("POST", "/v1/jobs", document, {"Idempotency-Key": str(number)})[0] == 202, "a post")
        ended = [each["id"] for each in service.json("/v1/jobs?limit=100")["jobs"]]
        for id in ended:
            service.wait(id)
        bad = example("line")
        bad["time_budget"] = 1e-6
        ended.append(service.post(bad))
        service.wait(ended[-1])
        long = service.post(LONG)
        until(lambda: service.json(f"/v1/jobs/{long}")["state"] == "running", "the long job runs")
        waiting = [service.post(example("line")) for _ in range(5)]
        ended.append(service.post(example("line")))
        service.ask("POST", f"/v1/jobs/{ended[-1]}/cancel")
        before = answers(service, ended)
        refused(binary, "a service has the file", str(path), "postgresql://nobody@localhost:1/none", "stop the service")
        service.kill()
    return path, keyed, before, [long, *waiting]


def check_answers(service, before, keyed):
    for id, told in answers(service, before).items():
        expect(told == before[id], f"{id} is answered as before: {told} {before[id]}")
    for key, document in keyed.items():
        code, _, body = service.ask("POST", "/v1/jobs", document, {"Idempotency-Key": key})
        expect(code == 202 and json.loads(body)["id"] in before, f"a key is used once: {code} {body}")


def killed(binary, folder, database):
    path, keyed, before, others = fill(binary, folder)
    multiply(path, 150, 700)
    jobs, size = sizes(path)
    database.ask("CREATE DATABASE bahnwerk", "postgres")
    say(f"{jobs} jobs, {size / 1e6:.0f} MB of setpoints to PostgreSQL")
    kills, told = move_killed(binary, str(path), database.url, 1, 6)
    expect(told["jobs"] == jobs and told["equal"], f"all jobs are there: {told}")
    say(f"moved after {kills} kills; a service on it")
    refused(binary, "it has jobs", str(path), database.url, "jobs already")
    with Service(binary, "--workers", "1", "--worker-nice", "0", url=database.url) as service:
        check_answers(service, before, keyed)
        for id in others:
            expect(service.wait(id)["state"] == "succeeded", f"{id} is planned")
        refused(binary, "a service has the database", database.url, str(folder / "none.db"), "stop all of them")
        expect(service.check() == "", f"the store is whole: {service.check()}")
        before |= answers(service, others)
        expect(service.stop() == 0, "an orderly end")
    say("and back")
    back = folder / "back.db"
    kills, told = move_killed(binary, database.url, str(back), 2, 6)
    expect(told["jobs"] == jobs and told["equal"], f"all jobs are back: {told}")
    say(f"moved after {kills} kills; a service on it")
    with Service(binary, "--workers", "1", "--worker-nice", "0", store=back) as service:
        check_answers(service, before, keyed)
        expect(service.wait(service.post(example("line")))["state"] == "succeeded", "a new job")
        expect(service.check() == "", f"the store is whole: {service.check()}")
        expect(service.stop() == 0, "an orderly end")


def slow(rows):
    """A document of so many rows of setpoints, one each ms: half circles of 6.28 mm in all at the same slow speed."""
    document = half_circles(2)
    for axis in document["spec"]["machine"]["axes"].values():
        axis["velocity"] = 6283 / rows
    return document


def resident(process):
    """Resident memory, MB."""
    with open(f"/proc/{process.pid}/status") as status:
        return next((int(line.split()[1]) / 1024 for line in status if line.startswith("VmRSS")), 0)


def move_measured(binary, here, there, shares):
    """Moves, killed when these shares of the jobs are there; returns what the command says at the end, and for each run: jobs at its end, seconds, processor
    time, and the resident memory after a tenth of its time and at most."""
    runs = []
    for share in [*shares, None]:
        begin, memory, jobs = time.monotonic(), [], "0"
        with tempfile.TemporaryFile("w+") as out:
            process = subprocess.Popen([binary, "migrate-store", here, there], stdout=out, stderr=subprocess.PIPE, text=True)
            os.set_blocking(process.stderr.fileno(), False)
            while os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is None:
                memory.append(resident(process))
                time.sleep(0.2)
                line = process.stderr.readline() or ""
                if " jobs, " in line:
                    jobs, _, of = line.split(": ")[2].split()[:3]
                    if share is not None and ("comparing" in line or int(jobs) >= share * int(of)):
                        process.kill()
            _, status, used = os.wait4(process.pid, 0)
            runs.append((jobs, time.monotonic() - begin, used.ru_utime + used.ru_stime, max(memory[:max(1, len(memory) // 10)]), used.ru_maxrss / 1024))
            if status == 0:
                out.seek(0)
                return json.load(out), runs
            expect(share is not None and os.WIFSIGNALED(status), f"the move ends with {status}")


def measure(binary, folder, database, megabytes, kills):
    path = fill(binary, folder)[0]
    with Service(binary, "--workers", "1", "--worker-nice", "0", store=path) as service:
        for rows in (4_000_000, 400_000, 40_000):
            job = service.wait(service.post(slow(rows)))
            expect(job["state"] == "succeeded", job)
        service.stop()
    multiply(path, megabytes, 0, kinds=3)
    database.ask("CREATE DATABASE bahnwerk", "postgres")
    for here, there in ((str(path), database.url), (database.url, str(folder / "back.db"))):
        load = os.getloadavg()[0]
        told, runs = move_measured(binary, here, there, [(k + 1) / (kills + 1) for k in range(kills)])
        size = told["bytes"] / 1e6
        moving = sum(run[1] for run in runs) - told["seconds_comparing"]
        seconds = moving + told["seconds_comparing"]
        say(f"{told['jobs']} jobs, {size:.0f} MB in {seconds:.1f} s, {size / seconds:.1f} MB/s: moved in {moving:.1f} s, {size / moving:.1f} MB/s, compared in "
            f"{told['seconds_comparing']:.1f} s; equal: {told['equal']}; load before {load:.1f}, after {os.getloadavg()[0]:.1f}")
        for jobs, spent, processor, early, most in runs:
            say(f"    a run of {spent:.1f} s up to job {jobs}: {processor:.1f} s of the processor, {early:.0f} MB of memory in its first tenth, {most:.0f} MB at most")


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("binary")
    arguments.add_argument("--megabytes", type=float)
    arguments.add_argument("--kills", type=int, default=0)
    given = arguments.parse_args()
    if not programs():
        print("its server is not installed")
        sys.exit(77)
    with tempfile.TemporaryDirectory(prefix="bahnwerk-moves-") as folder, Database() as database:
        if given.megabytes:
            database.settings = "-c max_connections=100"
        database.make()
        database.start()
        if given.megabytes:
            measure(given.binary, pathlib.Path(folder), database, given.megabytes, given.kills)
        else:
            killed(given.binary, pathlib.Path(folder), database)


if __name__ == "__main__":
    main()
