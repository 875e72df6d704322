#!/usr/bin/env python3
"""Random faults under load: two processes that serve and three that plan share a PostgreSQL server, which a synchronous standby follows.

    tests/postgres/random_faults.py BINARY [--faults 20] [--seed 1] [--only KIND,…] [--first KIND,…] [--short]

Clients post, ask and follow events all the time, from one process and the other in turn. After each fault: nothing that was acknowledged is lost, each job has
one result, of the attempt that ended it, no attempt outlasts its lease, no job is `worker-lost`, and each client has seen revisions and ids of events only grow.
The same seed gives the same faults. At the end a table of their kinds. Disks are filled as root alone, clocks are stepped where Debian's package libfaketime is.
Exit 77: there is no server.
"""
import argparse
import collections
import contextlib
import datetime
import http.client
import json
import pathlib
import random
import signal
import subprocess
import sys
import threading
import time
import uuid

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "crash"))
from database import Database, begin_with_own_mounts, programs, until  # noqa: E402
from service import Service, example, half_circles  # noqa: E402
from wire import Wire  # noqa: E402

LEASE = 30
FINAL = ("succeeded", "failed", "cancelled")
DOCUMENTS = (example("line"), half_circles(40), half_circles(150), half_circles(4_000))
WEIGHTS = (8, 8, 8, 1)
CLOCKS = ("-3600", "+0", "+3600")  # what is added to the clock of a process, s
FAKETIME = next(pathlib.Path("/usr/lib").glob("*/faketime/libfaketimeMT.so.1"), None)
# A log that is short, but long enough for a standby that stood still; a standby looks for its server again at once.
SETTINGS = "-c fsync=off -c max_connections=100 -c min_wal_size=32MB -c max_wal_size=96MB -c wal_keep_size=128MB -c wal_retrieve_retry_interval=100ms"
PATIENCE = 5  # of clients, s


class Failure(Exception):
    pass


def expect(condition, what):
    if not condition:
        raise Failure(what)


class Client(threading.Thread):
    """Does something again and again until the end; the first failure of any ends all."""

    def __init__(self, plant, seed):
        super().__init__(daemon=True)
        self.plant, self.choose = plant, random.Random(seed)
        self.start()

    def run(self):
        try:
            while not self.plant.over.is_set():
                self.step()
        except Exception as error:  # pylint: disable=broad-except
            self.plant.fail(f"{type(self).__name__}: {type(error).__name__}: {error}")

    def ask(self, method, path, document=None, headers=None):
        """The answer of some process that has one; None where it refuses for now."""
        service = self.choose.choice(self.plant.apis)
        try:
            code, head, body = service.ask(method, path, document, headers, timeout=PATIENCE)
        except OSError:
            self.plant.over.wait(0.05)
            return None
        if code == 503 or (code == 507 and method == "POST" and self.plant.full):
            expect(head["Retry-After"], f"{method} {path} answers {code} without Retry-After")
            self.plant.count(f"answers {code}")
            self.plant.over.wait(0.1)
            return None
        return code, head, body


class Poster(Client):
    def step(self):
        if self.plant.waiting() > 30:
            self.plant.over.wait(0.1)
            return
        key = str(uuid.UUID(int=self.choose.getrandbits(128)))
        document = dict(self.choose.choices(DOCUMENTS, WEIGHTS)[0])
        if self.choose.random() < 0.5:  # far enough for all of them, but not by every clock
            document["deadline"] = (datetime.datetime.utcnow() + datetime.timedelta(seconds=1200)).isoformat(timespec="seconds") + "Z"
        answer = None
        while answer is None and not self.plant.over.is_set():
            answer = self.ask("POST", "/v1/jobs", document, {"Idempotency-Key": key})
        if answer:
            expect(answer[0] == 202, f"POST answers {answer[0]}: {answer[2][:300]}")
            self.plant.accepted(json.loads(answer[2])["id"])
        self.plant.over.wait(0.05)


class Poller(Client):
    """Asks for a job until it has ended."""

    def step(self):
        id, last, state, shown = self.plant.some(self.choose), 0, None, None
        while id and state not in FINAL and not self.plant.over.is_set():
            answer = self.ask("GET", f"/v1/jobs/{id}")
            if answer is None:
                continue
            expect(answer[0] == 200, f"{id}, which was acknowledged, answers {answer[0]}: {answer[2][:300]}")
            job, revision = json.loads(answer[2]), int(answer[1]["ETag"].strip('W/"'))
            expect(revision >= last, f"{id}: revision {revision} after {last}")
            job["progress"].pop("remaining", None)  # an estimate, which follows the clock
            expect(revision > last or shown in (None, job["progress"]) and state in (None, job["state"]), f"{id}: revision {revision} of {state}, {shown} and of {job}")
            last, state, shown = revision, job["state"], job["progress"]
            self.plant.count("polls")
            self.plant.over.wait(0.05)
        if state in FINAL:
            expect(state == "succeeded", f"{id}: {answer[2][:500]}")
            self.plant.ended(id)
        elif not id:
            self.plant.over.wait(0.05)


class Follower(Client):
    """Follows events, of a job or of all, and goes on at another process when the stream ends or after some events."""

    def __init__(self, plant, seed, whole):
        self.whole, self.last = whole, 0
        super().__init__(plant, seed)

    def step(self):
        id = None if self.whole else self.plant.some(self.choose)
        if not self.whole:
            self.last = 0
            if id is None:
                self.plant.over.wait(0.05)
                return
        while not self.plant.over.is_set() and not self.stream(id):
            self.plant.over.wait(0.05)

    def stream(self, id):
        """Whether the job has ended."""
        service = self.choose.choice(self.plant.apis)
        connection = http.client.HTTPConnection("127.0.0.1", service.port, timeout=PATIENCE)
        try:
            connection.request("GET", f"/v1/jobs/{id}/events" if id else "/v1/events", headers={"Last-Event-ID": str(self.last)} if self.last else {})
            answer = connection.getresponse()
            if answer.status == 204:
                return True
            if answer.status != 200:
                expect(answer.status == 503, f"events of {id} answer {answer.status}")
                return False
            number = 0
            for _ in range(self.choose.randrange(5, 200)):
                line = answer.readline().decode()
                if not line or self.plant.over.is_set():
                    return False
                if line.startswith("id: "):
                    number = int(line[4:])
                elif line.startswith("event: ") and line != "event: gap\n":
                    # Among all jobs' events progress bears the number of the change before it.
                    expect(number > self.last or not id and line == "event: progress\n" and number == self.last,
                           f"events of {id or 'all'}: {line} with id {number} after {self.last}")
                    self.last = number
                    self.plant.count("events")
                elif id and line.startswith("data: ") and json.loads(line[6:]).get("state") in FINAL:
                    return True
            return False
        except (OSError, http.client.HTTPException):
            return False
        finally:
            connection.close()


class Plant:
    def __init__(self, binary, database, standby, stack, seed, short):
        self.database, self.standby, self.choose, self.short = database, standby, random.Random(seed), short
        self.over, self.lock, self.failure = threading.Event(), threading.Lock(), None
        self.jobs, self.open, self.last_ended, self.counts = [], set(), None, collections.Counter()
        self.wires, self.longest, self.snapshot, self.full, self.first_writes = {}, 0.0, None, False, []
        self.outage = time.monotonic()  # end of the last one of the server, or of anything between

        def made(*arguments):
            wire = stack.enter_context(Wire(database.folder, standby.folder))
            service = Service(binary, *arguments, url=wire.url())
            stack.callback(service.__exit__)
            if FAKETIME:
                self.set_clock(service, "+0")
                service.environment = {"LD_PRELOAD": str(FAKETIME), "FAKETIME_TIMESTAMP_FILE": str(service.folder / "clock"), "FAKETIME_CACHE_DURATION": "1",
                                       "FAKETIME_DONT_FAKE_MONOTONIC": "1", "DONT_FAKE_MONOTONIC": "1"}
            self.wires[service] = wire
            return service

        self.apis = [made("--role", "api", *more) for more in ((), ("--store-notify", "off"))]
        self.workers = [made("--role", "worker", "--workers", "1", "--worker-nice", "0") for _ in range(3)]
        for each in self.all():
            each.start(patience=600)

    def all(self):
        return self.apis + self.workers

    # What clients tell.

    def fail(self, why):
        with self.lock:
            self.failure = self.failure or why
        self.over.set()

    def count(self, what):
        with self.lock:
            self.counts[what] += 1

    def accepted(self, id):
        with self.lock:
            self.jobs.append(id)
            self.open.add(id)

    def ended(self, id):
        with self.lock:
            self.open.discard(id)
            self.last_ended = id

    def waiting(self):
        with self.lock:
            return len(self.open)

    def some(self, choose):
        with self.lock:
            return choose.choice(sorted(self.open)) if self.open else None

    # What happens.

    def rest(self, least, most):
        self.over.wait(self.choose.uniform(least, most))

    def kill(self, each):
        each.kill()
        self.rest(0, 2)
        launch(each)

    def kill_api(self):
        self.kill(self.choose.choice(self.apis))

    def kill_worker(self):
        self.kill(self.choose.choice(self.workers))

    def kill_all_workers(self):
        for each in self.workers:
            each.kill()
        self.rest(0, 1)
        for each in self.workers:
            launch(each)

    def restart_orderly(self):
        each = self.choose.choice(self.all())
        expect(each.stop() == 0, "an orderly end")
        launch(each)

    def stop_for(self, each, least, most):
        each.process.send_signal(signal.SIGSTOP)
        try:
            self.rest(least, most)
        finally:
            each.process.send_signal(signal.SIGCONT)

    def pause_api(self):
        self.stop_for(self.choose.choice(self.apis), 1, 8)

    def pause_worker(self):
        self.stop_for(self.choose.choice(self.workers), 1, 8)

    def pause_worker_beyond_its_lease(self):
        self.stop_for(self.choose.choice(self.workers), LEASE + 2, LEASE + 8)

    def pause_server(self):
        self.database.pause()
        self.rest(1, 8)
        self.database.resume()
        self.outage = time.monotonic()

    def pause_server_beyond_leases(self):
        self.database.pause()
        self.rest(LEASE + 2, LEASE + 8)
        self.database.resume()
        self.outage = time.monotonic()

    def restart_server(self, mode):
        self.database.stop(mode)
        self.rest(0, 3)
        self.database.start()
        self.outage = time.monotonic()

    def restart_server_orderly(self):
        self.restart_server("fast")

    def crash_server(self):
        self.restart_server("immediate")

    def end_sessions(self):
        self.database.ask("SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE application_name = 'bahnwerk' AND random() < 0.5")
        self.outage = time.monotonic()

    def on_wires(self, fault, least, most):
        some = self.choose.sample(self.all(), self.choose.choice((1, 1, 2, 5)))
        for each in some:
            fault(self.wires[each])
        self.rest(least, most)
        for each in some:
            self.wires[each].restore()
        self.outage = time.monotonic()

    def cut(self):
        self.on_wires(Wire.cut, 0, 0.5)

    def cut_off(self):
        self.on_wires(lambda wire: wire.cut(refuse=True), 1, 8)

    def hold_what_is_sent(self):
        self.on_wires(Wire.hold, 1, 8)

    def delay_what_is_sent(self):
        self.on_wires(lambda wire: wire.slow(self.choose.uniform(0.02, 0.3)), 2, 6)

    def part_commits_from_answers(self):
        self.on_wires(lambda wire: wire.part(self.choose.randrange(1, 6)), 2, 4)

    def hold_a_snapshot(self):
        """From here to the next but a few faults, unless the server ends it."""
        if self.snapshot and self.snapshot.poll() is None:
            self.snapshot.kill()
        self.snapshot = subprocess.Popen(
            [programs() / "psql", "-h", self.database.folder, "-U", "postgres", "-d", "bahnwerk", "-XAtqc",
             "BEGIN ISOLATION LEVEL REPEATABLE READ; SELECT count(*) FROM bahnwerk.jobs; SELECT pg_sleep(60)"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, **self.database.user)
        self.rest(0, 1)

    @staticmethod
    def set_clock(service, offset):
        """What the process takes for the time of day, at the latest a second later."""
        new = service.folder / "clock.new"
        new.write_text(offset + "\n")
        new.replace(service.folder / "clock")

    def step_clocks(self):
        for each in self.choose.sample(self.all(), self.choose.choice((1, 2, 5))):
            self.set_clock(each, self.choose.choice(CLOCKS))
        self.rest(2, 4)

    def begin_with_another_clock(self):
        each = self.choose.choice(self.all())
        each.kill()
        self.set_clock(each, self.choose.choice(CLOCKS))
        launch(each)

    def fill_disk(self):
        self.full = True
        self.database.disks[0].fill()
        until(lambda: self.failure or any(self.post(each) == 507 for each in self.apis), "a post is refused")
        self.rest(0, LEASE + 8 if self.choose.random() < 0.2 and not self.short else 8)
        self.end_of_full_disk(self.database.disks[0])

    def fill_disk_of_log(self):
        """The server ends when its log cannot grow."""
        self.full = True
        self.database.disks[1].fill()
        try:
            while True:
                self.database.ask("SELECT count(pg_logical_emit_message(false, 'filled', repeat('x', 1000000))) FROM generate_series(1, 4)")
        except SystemExit:
            self.rest(0, 4)
        self.end_of_full_disk(self.database.disks[1])

    def end_of_full_disk(self, disk):
        disk.free()
        until(self.begun, "the server is there again")
        self.outage = time.monotonic()

    def begun(self):
        """Whether the server answers; where it has ended, also while it tried to begin again, it is started."""
        try:
            if not self.database.lives():
                self.database.kill()
                self.database.start()
            return self.database.ask("SELECT 1") == "1"
        except SystemExit:
            return False

    def pause_standby(self):
        """Nothing is committed meanwhile."""
        self.standby.pause()
        self.rest(1, 8)
        self.standby.resume()
        self.outage = time.monotonic()

    def promote_standby(self):
        """The server ends, or stands still for good; meanwhile the standby serves what has ended. Then it takes the server's place, which is made its standby."""
        old, new = self.database, self.standby
        until(lambda: old.ask("SELECT count(*) FROM pg_stat_replication WHERE sync_state = 'sync'") == "1", "the standby follows")
        until(lambda: self.failure or self.last_ended, "a job has ended")
        self.choose.choice((lambda: old.stop("fast"), lambda: old.stop("immediate"), old.pause))()
        until(lambda: self.failure or any(self.read_only(each) for each in self.apis), "a job that has ended is read from the standby")
        self.rest(0, 6)
        new.promote()
        promoted = time.monotonic()
        self.database, self.standby = new, old
        until(lambda: self.failure or any(self.post(each) == 202 for each in self.apis), "a job is posted after the promotion")
        self.first_writes.append(time.monotonic() - promoted)
        old.kill()
        old.follow_synchronously(new)
        self.outage = time.monotonic()

    def read_only(self, service):
        try:
            code, headers, body = service.ask("GET", f"/v1/jobs/{self.last_ended}", timeout=PATIENCE)
        except OSError:
            return False
        return code == 200 and headers["Bahnwerk-Store"] == "read-only" and json.loads(body)["state"] == "succeeded"

    def post(self, service):
        try:
            code, _, body = service.ask("POST", "/v1/jobs", DOCUMENTS[0], timeout=PATIENCE)
        except OSError:
            return None
        if code == 202:
            self.accepted(json.loads(body)["id"])
        return code

    # What holds.

    def check(self):
        until(lambda: self.failure or all(status(each) == 200 for each in self.all()), "all processes are ready again")
        before = len(self.jobs), self.counts["polls"], self.counts["events"]
        until(lambda: self.failure or (len(self.jobs) >= before[0] + 3 and self.counts["polls"] > before[1] and self.counts["events"] > before[2]), "the load goes on")
        expect(not self.failure, self.failure)
        self.full = False
        with self.lock:
            known = list(self.jobs)
        ask = self.database.ask
        at_once = 2_000  # what the system takes as an argument
        for some in (known[k:k + at_once] for k in range(0, len(known), at_once)):
            expect(ask("SELECT count(*) FROM unnest('{" + ",".join(some) + "}'::uuid[]) AS known (id) LEFT JOIN bahnwerk.jobs USING (id) WHERE jobs.id IS NULL") == "0",
                   "nothing that was acknowledged is lost")
        expect(ask("SELECT count(*) FROM bahnwerk.jobs AS j LEFT JOIN bahnwerk.results AS r USING (id) WHERE (state = 'succeeded' AND r.token IS DISTINCT FROM j.token) "
                   "OR (state <> 'succeeded' AND r.id IS NOT NULL)") == "0", "each job has the result of the attempt that ended it")
        expect(ask("SELECT count(*) FROM bahnwerk.jobs WHERE error LIKE '%worker-lost%'") == "0", "no job ends as worker-lost")
        expect(ask("SELECT count(*) FROM bahnwerk.jobs AS j FULL JOIN bahnwerk.runs AS r USING (id) WHERE (coalesce(j.state, '') = 'running') <> (r.id IS NOT NULL) "
                   "OR r.token <> j.token") == "0", "what runs has one attempt")
        # After an outage leases are renewed before any is taken for run out.
        if time.monotonic() > self.outage + LEASE + 5:
            beyond = float(ask("SELECT coalesce(max(extract(epoch FROM clock_timestamp() - lease_until)), 0) FROM bahnwerk.runs"))
            self.longest = max(self.longest, beyond)
        until(lambda: ask(f"SELECT count(*) FROM bahnwerk.runs WHERE lease_until < clock_timestamp() - interval '{LEASE + 10} s'") == "0", "no attempt outlasts its lease")

    KINDS = (kill_api, kill_worker, kill_all_workers, restart_orderly, pause_api, pause_worker, pause_worker_beyond_its_lease, pause_server,
             pause_server_beyond_leases, restart_server_orderly, crash_server, end_sessions, cut, cut_off, hold_what_is_sent, delay_what_is_sent,
             part_commits_from_answers, hold_a_snapshot, pause_standby, promote_standby)
    OF_CLOCKS = (step_clocks, begin_with_another_clock)
    OF_DISKS = (fill_disk, fill_disk_of_log)
    OF_LEASES = (pause_worker_beyond_its_lease, pause_server_beyond_leases, kill_worker, kill_all_workers)
    SELDOM = (pause_worker_beyond_its_lease, pause_server_beyond_leases, kill_all_workers)


def status(service):
    try:
        return service.ask("GET", "/readyz", timeout=PATIENCE)[0]
    except OSError:
        return None


def launch(service):
    """Starts a process that need not become ready."""
    try:
        service.start(patience=0)
    except SystemExit:
        expect(service.process.poll() is None, "it lives: " + (service.folder / "log").read_text()[-1000:])


def main():
    words = argparse.ArgumentParser()
    words.add_argument("binary")
    words.add_argument("--faults", type=int, default=20)
    words.add_argument("--seed", type=int, default=1)
    words.add_argument("--only", default="", help="kinds, with commas between")
    words.add_argument("--first", default="", help="kinds that come once each before those that are drawn")
    words.add_argument("--short", action="store_true", help="without those after which a lease has to run out")
    words.add_argument("--load", type=int, default=2, help="clients of each sort")
    words = words.parse_args()
    if not programs():
        print("its server is not installed")
        sys.exit(77)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # what was started is ended
    mounts = begin_with_own_mounts()
    kinds = list(Plant.KINDS)
    for more, there, why in ((Plant.OF_CLOCKS, FAKETIME, "libfaketime is not installed"), (Plant.OF_DISKS, mounts, "nothing can be mounted")):
        if there:
            kinds += more
        else:
            print(f"without {', '.join(kind.__name__.replace('_', ' ') for kind in more)}: {why}", flush=True)
    first = [kind for kind in kinds if kind.__name__ in words.first.split(",")]
    kinds = [kind for kind in kinds if (not words.only or kind.__name__ in words.only.split(",")) and not (words.short and kind in Plant.OF_LEASES)]
    weights = [1 if kind in Plant.SELDOM else 3 for kind in kinds]
    done = collections.Counter()
    disks = {"megabytes": 2048} if mounts else {}
    with Database(**disks) as database, Database(**disks) as standby, contextlib.ExitStack() as stack:
        database.settings = standby.settings = SETTINGS
        database.make()
        database.start()
        database.ask("CREATE DATABASE bahnwerk", "postgres")
        standby.follow_synchronously(database)
        plant = Plant(words.binary, database, standby, stack, words.seed, words.short)
        clients = [made(plant, words.seed * 1000 + 10 * n + k) for n in range(words.load) for k, made in enumerate(
            (Poster, Poller, Poller, lambda *given: Follower(*given, False), lambda *given: Follower(*given, True)))]
        kind = None
        try:
            for number in range(words.faults):
                kind = first[number] if number < len(first) else plant.choose.choices(kinds, weights)[0]
                start = time.monotonic()
                kind(plant)
                plant.check()
                done[kind.__name__] += 1
                print(f"{number + 1} {kind.__name__.replace('_', ' ')}: {time.monotonic() - start:.1f} s, {len(plant.jobs)} jobs", flush=True)
            # Every job that was acknowledged ends; the clients that ask for it expect how.
            for client in clients[::5]:
                client.step = lambda plant=plant: plant.over.wait(0.5)
            until(lambda: plant.failure or plant.waiting() == 0, "all jobs end")
            expect(not plant.failure, plant.failure)
            plant.over.set()
            for client in clients:
                client.join()
            for each in plant.all():
                expect(each.stop() == 0, "an orderly end")
            expect(plant.all()[0].check() == "", "bahnwerk check finds nothing")
        except BaseException as error:
            print(f"wrong after {sum(done.values())} faults, seed {words.seed}, {kind and kind.__name__}: {error}", flush=True)
            for each in plant.all():
                print(each.folder, "".join(line for line in (each.folder / "log").read_text().splitlines(True) if '"info"' not in line)[-1500:])
            if isinstance(error, Failure):
                sys.exit(1)
            raise
        finally:
            plant.over.set()
            if plant.snapshot and plant.snapshot.poll() is None:
                plant.snapshot.kill()
    for name, times in sorted(done.items()):
        print(f"| {name.replace('_', ' ')} | {times} |")
    print(f"{sum(done.values())} faults, {len(plant.jobs)} jobs acknowledged and ended, {plant.counts['polls']} polls, {plant.counts['events']} events, "
          f"{sum(wire.parted for wire in plant.wires.values())} commits parted from their answers; {plant.counts['answers 503']} answers 503, {plant.counts['answers 507']} 507; "
          f"longest beyond a lease: {plant.longest:.1f} s; first writes after promotions: {', '.join(f'{each:.1f}' for each in plant.first_writes) or 'none'} s")


if __name__ == "__main__":
    main()
