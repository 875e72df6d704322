#!/usr/bin/env python3
"""What two processes that share a PostgreSQL server measure: the same queue, each its own work, and also while the server is away.

    tests/postgres/metrics.py BINARY

They run with the variables of deploy/compose.postgres.yaml, after `bahnwerk migrate` as there, as a user with a password in a file. Exit 77: there is no server.
"""
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/crash"))
from database import Database, programs, until  # noqa: E402
from service import Service, example  # noqa: E402


def expect(condition, what):
    if not condition:
        raise SystemExit(f"wrong: {what}")


def metrics(service):
    """The series by name and labels; those of histograms by their count."""
    status, _, body = service.ask("GET", "/metrics")
    expect(status == 200, f"/metrics answers {status}")
    return {name: float(value) for name, value in re.findall(r"^(\w+(?:\{.*\})?) (\S+)$", body.decode(), re.M)}


def state(service):
    found = metrics(service)
    return [each for each in ("up", "read_only", "away") if found[f'bahnwerk_store_state{{state="{each}"}}'] == 1]


def environment(part):
    """The variables of x-environment and of one of the other parts of the compose file."""
    text = (ROOT / "deploy/compose.postgres.yaml").read_text()
    found = {}
    for name in "x-environment", part:
        block = re.search(rf"^{name}:.*\n((?:  .*\n)+)", text, re.M)[1]
        found |= dict(re.findall(r"^ +(BAHNWERK_\w+): '?([^'\n]*)'?$", block, re.M))
    return found


binary = sys.argv[1]
if not programs():
    print("its server is not installed")
    sys.exit(77)
with Database() as database:
    database.make()
    hba = database.data / "pg_hba.conf"
    hba.write_text("local all bahnwerk scram-sha-256\n" + hba.read_text())
    database.start()
    database.ask("CREATE ROLE bahnwerk LOGIN PASSWORD 'so ge:heim'", "postgres")
    database.ask("CREATE DATABASE bahnwerk OWNER bahnwerk ENCODING UTF8 TEMPLATE template0", "postgres")
    password = database.folder / "password"
    password.write_text("so ge:heim")
    url = f"postgresql://bahnwerk@/bahnwerk?host={database.folder}"

    def variables(part):
        found = environment(part)
        expect(set(found) > {"BAHNWERK_STORE", "BAHNWERK_STORE_PASSWORD_FILE"}, f"{part} of the compose file: {found}")
        del found["BAHNWERK_INSECURE_LISTEN"]  # on loopback here
        return found | {"BAHNWERK_STORE": url, "BAHNWERK_STORE_PASSWORD_FILE": str(password)}

    made = subprocess.run([binary, "migrate"], env=os.environ | variables("x-api"), capture_output=True, text=True)
    expect(made.returncode == 0, f"migrate: {made.stderr}")
    services = []
    for part in "x-api", "x-worker":
        os.environ.update(variables(part))
        services.append(Service(binary, url=url))
        services[-1].__enter__()
    api, worker = services
    try:
        expect(state(api) == state(worker) == ["up"], "both reach the store")
        ids = [api.post(example("line")) for _ in range(3)]
        for id in ids:
            expect(api.wait(id)["state"] == "succeeded", f"{id} ends")
        ours, theirs = metrics(api), metrics(worker)
        for name in 'bahnwerk_jobs{state="succeeded"}', "bahnwerk_queue_length", "bahnwerk_queue_beyond_engine":
            expect(ours[name] == theirs[name] == (3 if "succeeded" in name else 0), f"both tell {name}: {ours[name]}, {theirs[name]}")
        expect((ours["bahnwerk_claim_seconds_count"], theirs["bahnwerk_claim_seconds_count"]) == (0, 3), "each tells its own claims")
        expect((ours["bahnwerk_workers"], theirs["bahnwerk_workers"]) == (0, 2), "each tells its own planners")
        expect((ours["bahnwerk_store_connections_max"], theirs["bahnwerk_store_connections_max"]) == (6, 2), "each has its own connections")
        expect(ours["bahnwerk_store_free_bytes"] == float("inf") and ours["bahnwerk_store_dead_rows"] >= 0, "what the server tells")
        first = metrics(api)["bahnwerk_feed_caught_up_timestamp_seconds"]
        until(lambda: metrics(api)["bahnwerk_feed_caught_up_timestamp_seconds"] > first, "the feed comes to its end again")
        expect(metrics(api)["bahnwerk_attempts_lost_total"] == metrics(worker)["bahnwerk_attempts_lost_total"] == 0, "no attempt is lost")

        database.stop()
        until(lambda: state(api) == state(worker) == ["away"], "both tell that the store is away")
        away = metrics(api)
        for name in 'bahnwerk_jobs{state="succeeded"}', "bahnwerk_queue_length", "bahnwerk_store_bytes", "bahnwerk_store_snapshot_transactions":
            expect(away[name] != away[name], f"{name} is no number while the store is away: {away[name]}")
        expect(away["bahnwerk_http_requests_total{method=\"POST\",route=\"/v1/jobs\",status=\"202\"}"] == 3, "what the process knows is told")
        database.start()
        until(lambda: state(api) == state(worker) == ["up"], "both tell that it is back")
        expect(metrics(api)['bahnwerk_jobs{state="succeeded"}'] == 3, "and count its jobs")

        # A standby, or what is set like one, can be read.
        database.ask("ALTER SYSTEM SET default_transaction_read_only = on", "postgres")
        database.ask("SELECT pg_reload_conf()", "postgres")
        until(lambda: state(api) == state(worker) == ["read_only"], "both tell that it can only be read")
        expect(metrics(api)['bahnwerk_jobs{state="succeeded"}'] == 3, "and count its jobs")
    finally:
        for each in services:
            each.__exit__()
print("metrics of two processes")
