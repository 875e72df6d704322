#!/usr/bin/env python3
"""All jobs of an SQLite store are moved to a PostgreSQL server and back, by a command that is killed again and again.

    tests/postgres/moves.py BINARY
    tests/postgres/moves.py BINARY --megabytes 1000     # measures instead: both ways with so much, without kills

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


def multiply(path, megabytes, least):
    """Repeats the largest job that succeeded, with new ids, until its copies have so many MB of setpoints, and as many as `least`."""
    with sqlite3.connect(path) as store:
        seq, size = store.execute("SELECT seq, sum(length(data)) FROM chunks GROUP BY seq ORDER BY 2 DESC LIMIT 1").fetchone()
        columns = [row[1] for row in store.execute("PRAGMA table_info(jobs)") if row[1] not in ("seq", "id", "changed")]
        names = ", ".join(columns)
        for number in range(max(least, int(megabytes * 1e6 / size))):
            id = f"{int(time.time() * 1000):012x}"
            id = f"{id[:8]}-{id[8:]}-7000-8000-{number:012x}"
            row = store.execute(f"INSERT INTO jobs (id, {names}) SELECT ?, {names} FROM jobs WHERE seq = ?", (id, seq)).lastrowid
            for table, values in (("specs", "spec, whole"), ("results", "document, columns, row_count, chunk_rows, cycle_time, views"),
                                  ("chunks", "first_row, row_count, data"), ("views", "name, part, data")):
                store.execute(f"INSERT INTO {table} (seq, {values}) SELECT ?, {values} FROM {table} WHERE seq = ?", (row, seq))
            if number % 100 == 99:
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


def measure(binary, folder, database, megabytes):
    path = fill(binary, folder)[0]
    multiply(path, megabytes, 0)
    database.ask("CREATE DATABASE bahnwerk", "postgres")
    for here, there in ((str(path), database.url), (database.url, str(folder / "back.db"))):
        begin, load = time.monotonic(), os.getloadavg()[0]
        with tempfile.TemporaryFile("w+") as out:
            process = subprocess.Popen([binary, "migrate-store", here, there], stdout=out, stderr=subprocess.DEVNULL)
            _, status, used = os.wait4(process.pid, 0)
            expect(status == 0, "the move ends with 0")
            out.seek(0)
            told = json.load(out)
        seconds, size = time.monotonic() - begin, told["bytes"] / 1e6
        say(f"{told['jobs']} jobs, {size:.0f} MB in {seconds:.1f} s, {size / seconds:.1f} MB/s: moved in {told['seconds_moving']:.1f} s, compared in "
            f"{told['seconds_comparing']:.1f} s; the command took {used.ru_utime + used.ru_stime:.1f} s of the processor and {used.ru_maxrss / 1024:.0f} MB "
            f"of memory; load before {load:.1f}, after {os.getloadavg()[0]:.1f}")


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("binary")
    arguments.add_argument("--megabytes", type=float)
    given = arguments.parse_args()
    if not programs():
        print("its server is not installed")
        sys.exit(77)
    with tempfile.TemporaryDirectory(prefix="bahnwerk-moves-") as folder, Database() as database:
        database.make()
        database.start()
        if given.megabytes:
            measure(given.binary, pathlib.Path(folder), database, given.megabytes)
        else:
            killed(given.binary, pathlib.Path(folder), database)


if __name__ == "__main__":
    main()
