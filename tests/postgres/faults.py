#!/usr/bin/env python3
"""Two processes that serve and two that plan share a PostgreSQL server, while each of them is killed, paused or restarted.

    tests/postgres/faults.py BINARY

Nothing that was acknowledged is lost, each job has one result, clients of one process see what others do. Exit 77: there is no server.
"""
import http.client
import json
import os
import pathlib
import random
import signal
import sys
import threading
import uuid

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "crash"))
from database import Database, programs, until  # noqa: E402
from service import Service, example, half_circles  # noqa: E402

DOCUMENTS = [json.dumps(example("line")), json.dumps(half_circles(40)), json.dumps(half_circles(150))]
LONG = half_circles(20_000)
FINAL = ("succeeded", "failed", "cancelled")


def expect(condition, what):
    if not condition:
        raise SystemExit(f"wrong: {what}")


def say(text):
    print(text, flush=True)


class Plant:
    """Two processes of each role on one database, which is away at first."""

    def __init__(self, binary, database, url=None, more=None):
        """`more` gives further arguments for the process of a number: 0 and 1 serve, 2 and 3 plan."""
        arguments = ("--workers", "1", "--worker-nice", "0")
        more = more or (lambda number: ("--store-notify", "off") if number == 1 else ())
        url = url or database.url
        self.binary, self.database = binary, database
        self.apis = [Service(binary, "--role", "api", *more(number), url=url) for number in range(2)]
        self.workers = [Service(binary, "--role", "worker", *arguments, *more(number), url=url) for number in (2, 3)]
        self.posted, self.lock = {}, threading.Lock()

    def all(self):
        return self.apis + self.workers

    def ready(self):
        until(lambda: all(status(each) == 200 for each in self.all()), "all processes are ready")

    def post(self, choose):
        """Posts with a key until one process has acknowledged it."""
        key, document = str(uuid.UUID(int=choose.getrandbits(128))), choose.choice(DOCUMENTS)
        while True:
            try:
                code, headers, body = choose.choice(self.apis).ask("POST", "/v1/jobs", document, {"Idempotency-Key": key})
            except OSError:
                continue
            if code == 202:
                with self.lock:
                    self.posted[key] = json.loads(body)["id"]
                return
            expect(code in (503,) and headers["Retry-After"], f"POST answers {code}: {body[:300]}")

    def load(self, fault):
        """Lets clients post while `fault` happens; then all that was acknowledged has to end as succeeded."""
        over = threading.Event()

        def client(seed):
            choose = random.Random(seed)
            while not over.is_set():
                self.post(choose)
                over.wait(0.02)

        before = len(self.posted)
        clients = [threading.Thread(target=client, args=(before * 10 + n,)) for n in range(2)]
        for each in clients:
            each.start()
        until(lambda: len(self.posted) >= before + 5, "jobs are posted before the fault")
        fault()
        after = len(self.posted)
        until(lambda: len(self.posted) >= after + 5, "jobs are posted after the fault")
        over.set()
        for each in clients:
            each.join()
        self.ready()
        for id in list(self.posted.values())[before:]:
            job = ended(self.apis[0], id)
            expect(job["state"] == "succeeded", f"{id}: {job}")

    def whole(self):
        """What holds at the end of each fault."""
        expect(self.database.ask("SELECT count(*) FROM bahnwerk.jobs AS j LEFT JOIN bahnwerk.results AS r USING (id) WHERE state = 'succeeded' AND "
                                 "r.token IS DISTINCT FROM j.token") == "0", "each job has the result of the attempt that ended it")
        checked = os.spawnv(os.P_WAIT, self.binary, [self.binary, "check", "--store", self.database.url])
        expect(checked == 0, "bahnwerk check finds nothing")
        expect(not any(b"worker-lost" in (each.folder / "log").read_bytes() for each in self.all()), "no job ends as worker-lost")


def status(service, path="/readyz"):
    try:
        return service.ask("GET", path)[0]
    except OSError:
        return None


def ended(service, id):
    found = {}

    def over():
        nonlocal found
        try:
            code, _, body = service.ask("GET", f"/v1/jobs/{id}", headers={"Prefer": "wait=30"})
        except OSError:
            return False
        found = json.loads(body)
        expect(code in (200, 503), f"{id} answers {code}: {body[:300]}")
        return found.get("state") in FINAL

    until(over, f"{id} ends")
    return found


def launch(service):
    """Starts a process that need not become ready."""
    try:
        service.start(patience=0)
    except SystemExit:
        expect(service.process.poll() is None, "it lives: " + (service.folder / "log").read_text()[-1000:])


def launch_refused(service, why):
    """Starts a process that ends with 2."""
    try:
        service.start()
    except SystemExit:
        pass
    expect(service.process.wait(600) == 2, why)


def begins_without_its_server(plant):
    plant.database.make()
    plant.database.start()
    plant.database.ask("CREATE DATABASE bahnwerk", "postgres")
    plant.database.stop()
    for each in plant.all():
        launch(each)
        until(lambda each=each: status(each, "/healthz") == 200, "the process lives")
        expect(status(each) == 503, "/readyz is 503")
    code, headers, body = plant.apis[0].ask("POST", "/v1/jobs", DOCUMENTS[0])
    expect(code == 503 and headers["Retry-After"] and json.loads(body)["type"] == "/problems/store-unavailable", f"a post is answered {code} {body}")
    plant.database.start()
    plant.ready()
    plant.load(lambda: None)


def refusals(plant):
    for url in (plant.database.url.replace("/bahnwerk?", "/nowhere?"), plant.database.url.replace("postgres@", "nobody-here@")):
        refused = Service(plant.binary, "--role", "api", url=url)
        launch_refused(refused, url)
        refused.__exit__()


def shows_what_others_do(plant):
    one, other = plant.apis
    id = one.post(LONG)
    until(lambda: other.json(f"/v1/jobs/{id}")["state"] == "running", "the job runs")
    for path in (f"/v1/jobs/{id}/events", "/v1/events"):
        stream = http.client.HTTPConnection("127.0.0.1", other.port, timeout=600)
        stream.request("GET", path)
        answer = stream.getresponse()
        while b"event: progress" not in answer.readline():
            expect(other.json(f"/v1/jobs/{id}")["state"] == "running", f"progress comes on {path} while the job runs")
        stream.close()
    revisions = []
    for k in range(20):
        etag = plant.apis[k % 2].ask("GET", f"/v1/jobs/{id}")[1]["ETag"]
        revisions.append(int(etag.strip('"')))
    expect(revisions == sorted(revisions), f"revisions only grow, whichever process is asked: {revisions}")
    code, _, _ = other.ask("POST", f"/v1/jobs/{id}/cancel")
    expect(code == 202, "a cancel through another process")
    expect(ended(one, id)["state"] == "cancelled", "is seen by all")


def kills(plant):
    choose = random.Random(1)
    for each in plant.all():
        def kill(each=each):
            each.kill()
            launch(each)
        plant.load(kill)
    for _ in range(3):
        each = choose.choice(plant.all())
        plant.load(lambda each=each: (each.kill(), launch(each)))


def paused_worker(plant):
    """A worker that stands still for longer than its lease loses its job, and stores nothing when it wakes up."""
    id = plant.apis[0].post(LONG)
    database = plant.database
    until(lambda: database.ask(f"SELECT count(*) FROM bahnwerk.runs WHERE id = '{id}'") == "1", "the job runs")
    log = lambda each: (each.folder / "log").read_text()
    mine = lambda each: any(f'"{id}"' in line and "job_started" in line for line in log(each).splitlines())
    until(lambda: any(map(mine, plant.workers)), "a worker says so")
    sleeper = next(each for each in plant.workers if mine(each))
    other = next(each for each in plant.workers if each is not sleeper)
    sleeper.process.send_signal(signal.SIGSTOP)
    until(lambda: mine(other), "the other worker has the job")
    sleeper.process.send_signal(signal.SIGCONT)
    expect(ended(plant.apis[1], id)["state"] == "succeeded", "it succeeds")
    over = lambda line: f'"{id}"' in line and ("job_ended" in line and '"lost"' in line or "job_ending_ignored" in line)
    until(lambda: any(map(over, log(sleeper).splitlines())), "the first attempt stores nothing")
    expect(database.ask(f"SELECT attempt FROM bahnwerk.jobs WHERE id = '{id}'") == "2", "in its second attempt")


def server_restarts(plant):
    for mode in ("fast", "immediate"):
        def restart(mode=mode):
            plant.database.stop(mode)
            until(lambda: all(status(each) == 503 for each in plant.all()), "all say that the store is away")
            plant.database.start()
        plant.load(restart)


def server_stands_still(plant):
    """A long job goes on while the server does not, in its first attempt."""
    id = plant.apis[0].post(LONG)
    until(lambda: plant.apis[1].json(f"/v1/jobs/{id}")["state"] == "running", "the job runs")
    plant.database.pause()
    until(lambda: all(status(each) == 503 for each in plant.all()), "all say that the store is away")
    plant.database.resume()
    plant.ready()
    expect(ended(plant.apis[1], id)["state"] == "succeeded", "the job succeeds")
    expect(plant.database.ask(f"SELECT attempt FROM bahnwerk.jobs WHERE id = '{id}'") == "1", "in its first attempt")


def serves_without_rights(plant):
    """Who may not change the schema serves what `bahnwerk migrate` has made."""
    database = plant.database
    database.ask("CREATE DATABASE apart", "postgres")
    database.ask("CREATE ROLE server LOGIN", "postgres")
    url, own = (database.url.replace("/bahnwerk?", "/apart?").replace("postgres@", user) for user in ("server@", "postgres@"))
    service = Service(plant.binary, "--workers", "1", url=url)
    try:
        launch_refused(service, "it does not start without a schema")
        for _ in range(2):
            expect(os.spawnv(os.P_WAIT, plant.binary, [plant.binary, "migrate", "--store", own]) == 0, "the schema is made, and made again")
        database.ask("GRANT USAGE ON SCHEMA bahnwerk TO server; GRANT SELECT, INSERT, UPDATE, DELETE ON ALL TABLES IN SCHEMA bahnwerk TO server", "apart")
        service.start()
        expect(service.wait(service.post(DOCUMENTS[0]))["state"] == "succeeded", "a job")
        expect(service.stop() == 0, "an orderly end")
    finally:
        service.__exit__()


# What a later version makes of the schema, which this one may still use.
LATER_SCHEMA = ("ALTER TABLE bahnwerk.jobs ADD COLUMN later text DEFAULT 'x'; ALTER TABLE bahnwerk.runs ADD COLUMN later text; CREATE TABLE bahnwerk.later (id uuid PRIMARY KEY); "
                "INSERT INTO bahnwerk.schema_version SELECT max(version) + 1, max(min_reader) FROM bahnwerk.schema_version")


def two_versions(plant):
    """A later version changes the schema while this one serves. What it has taken waits for its planners; a trigger plays it."""
    database, one = plant.database, plant.apis[0]
    plant.load(lambda: database.ask(LATER_SCHEMA))
    for each in plant.all():
        plant.load(lambda each=each: (expect(each.stop() == 0, "an orderly end"), launch(each)))
    beyond = lambda number: all(f"bahnwerk_queue_beyond_engine {number}\n" in each.ask("GET", "/metrics")[2].decode() for each in plant.all())
    database.ask("CREATE FUNCTION bahnwerk.later() RETURNS trigger LANGUAGE plpgsql AS 'BEGIN NEW.needs = 1000; NEW.kind = ''spiral''; RETURN NEW; END'; "
                 "CREATE TRIGGER later BEFORE INSERT ON bahnwerk.jobs FOR EACH ROW EXECUTE FUNCTION bahnwerk.later()")
    later, cancelled = one.post(DOCUMENTS[0]), one.post(DOCUMENTS[0])
    database.ask("DROP TRIGGER later ON bahnwerk.jobs; DROP FUNCTION bahnwerk.later")
    for _ in range(3):
        expect(ended(one, one.post(DOCUMENTS[0]))["state"] == "succeeded", "others are planned")
    expect(one.json(f"/v1/jobs/{later}")["state"] == "queued", "it waits")
    expect(beyond(2), "all processes tell of it")
    for path in (f"/v1/jobs/{later}", "/v1/jobs?kind=spiral", f"/jobs/{later}", "/"):
        code, _, body = plant.apis[1].ask("GET", path)
        expect(code == 200, f"{path}, where a job of a kind is that this version does not know, answers {code}: {body[:300]}")
    expect(one.ask("POST", f"/v1/jobs/{cancelled}/cancel")[0] == 202, "it can be cancelled")
    database.ask("UPDATE bahnwerk.jobs SET needs = 0, kind = 'contour' WHERE state = 'queued'")
    expect(ended(one, later)["state"] == "succeeded", "it is planned by one that can")
    expect(beyond(0), "none is left")


def begun_by_a_later_version(plant):
    """The later version was there first. When it needs what this one does not know, this one does not start any more, and what runs goes on."""
    database = plant.database
    database.ask("CREATE DATABASE later", "postgres")
    url = database.url.replace("/bahnwerk?", "/later?")
    expect(os.spawnv(os.P_WAIT, plant.binary, [plant.binary, "migrate", "--store", url]) == 0, "the schema is made")
    database.ask(LATER_SCHEMA, "later")
    with Service(plant.binary, "--workers", "1", url=url) as service, Service(plant.binary, "--workers", "1", url=url) as refused:
        expect(service.wait(service.post(DOCUMENTS[0]))["state"] == "succeeded", "a job")
        expect(refused.stop() == 0, "an orderly end")
        database.ask("UPDATE bahnwerk.schema_version SET min_reader = version", "later")
        launch_refused(refused, "it does not know the schema")
        expect(service.wait(service.post(DOCUMENTS[0]))["state"] == "succeeded", "another job")


def standby(plant):
    """A process on a standby serves what has ended, and everything after the promotion."""
    id = list(plant.posted.values())[0]
    with Database() as copy:
        copy.copy(plant.database)
        copy.start()
        with Service(plant.binary, "--workers", "1", url=copy.url) as service:
            until(lambda: status(service) == 200, "the standby is ready for reading")
            code, headers, body = service.ask("GET", "/readyz")
            expect(json.loads(body)["store"] == "read-only", "/readyz says so")
            for path in (f"/v1/jobs/{id}", f"/v1/jobs/{id}/result", f"/v1/jobs/{id}/setpoints"):
                code, headers, _ = service.ask("GET", path)
                expect(code == 200 and headers["Bahnwerk-Store"] == "read-only", f"{path} is served from the standby: {code} {headers}")
            code, headers, body = service.ask("POST", "/v1/jobs", DOCUMENTS[0])
            expect(code == 503 and headers["Retry-After"], f"a post is answered {code} {body}")
            copy.promote()
            until(lambda: service.ask("POST", "/v1/jobs", DOCUMENTS[0])[0] == 202, "posts are taken after the promotion")
            expect(service.ask("GET", f"/v1/jobs/{id}")[1]["Bahnwerk-Store"] is None, "the header is gone")


def main():
    if not programs():
        print("its server is not installed")
        sys.exit(77)
    with Database() as database:
        plant = Plant(sys.argv[1], database)
        try:
            for fault in (begins_without_its_server, refusals, shows_what_others_do, kills, server_restarts, server_stands_still, paused_worker, two_versions, begun_by_a_later_version, serves_without_rights, standby):
                say(fault.__name__.replace("_", " "))
                fault(plant)
                plant.ready()
                plant.whole()
            for each in plant.all():
                expect(each.stop() == 0, "an orderly end")
        except BaseException:
            for each in plant.all():
                print(each.folder, "".join(line for line in (each.folder / "log").read_text().splitlines(True) if '"info"' not in line)[-1500:])
            raise
        finally:
            for each in plant.all():
                each.__exit__()
        say(f"{len(plant.posted)} jobs acknowledged, none lost")


if __name__ == "__main__":
    main()
