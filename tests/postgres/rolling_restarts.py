#!/usr/bin/env python3
"""Processes that share a PostgreSQL server are restarted one after the other under load: no request fails.

    tests/postgres/rolling_restarts.py BINARY [--restarts 8] [--through nginx|caddy|both] [--hard]

Two processes serve and two plan. Clients are those of examples/clients, which repeat what got no answer or one that names a time to come again. They come through
nginx or Caddy as deploy/proxy has them, or know both processes (`both`). `--hard`: processes are killed instead of ended in order. Exit 77: there is no server.
"""
import argparse
import collections
import contextlib
import json
import pathlib
import random
import sys
import threading
import time
import urllib.parse

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS / "crash"), str(TESTS / "deploy"), str(TESTS.parent / "examples/clients/python")]
import bahnwerk  # noqa: E402
import proxies  # noqa: E402
from database import Database, programs, until  # noqa: E402
from service import Service, example, half_circles  # noqa: E402

DOCUMENTS = (example("line"), half_circles(40), half_circles(150))
LONG = half_circles(3_000)  # some restarts come while it is planned


def expect(condition, what):
    if not condition:
        raise SystemExit(f"wrong: {what}")


class Client(bahnwerk.Client):
    """Asks these addresses in turn, so that what is repeated comes to another one, and counts."""

    def __init__(self, addresses, counts):
        super().__init__(addresses[0])
        self.addresses, self.next, self.counts = [urllib.parse.urlsplit(each) for each in addresses], random.randrange(len(addresses)), counts

    def _open(self, *given):
        self._parts = self.addresses[self.next % len(self.addresses)]
        self.next += 1
        self.counts["requests"] += 1
        try:
            connection, answer = super()._open(*given)
        except Exception:
            self.counts["without an answer"] += 1
            raise
        if answer.status >= 400:
            self.counts[f"answered {answer.status}"] += 1
        return connection, answer


class Load:
    """Clients in threads until stop(); what any of them raises is a failure."""

    def __init__(self, addresses):
        self.addresses, self.over, self.failures, self.counts = addresses, threading.Event(), [], collections.Counter()
        self.threads = [threading.Thread(target=self.run, args=(step,), daemon=True) for step in (self.plan, self.plan, self.plan_long, self.follow, self.list)]
        for each in self.threads:
            each.start()

    def run(self, step):
        client, choose = Client(self.addresses, self.counts), random.Random(len(self.threads))
        while not self.over.is_set() and not self.failures:
            try:
                step(client, choose)
            except Exception as error:  # pylint: disable=broad-except
                self.failures.append(f"{step.__name__}: {type(error).__name__}: {error}")

    def plan(self, client, choose, document=None):
        id = client.submit(document or choose.choice(DOCUMENTS))["id"]
        client.wait(id)
        rows = client.result(id)["setpoints"]["count"]
        found = client.rows(id, every=max(1, rows // 100))
        expect(len(found.values[0]) > 1, "rows of a plan")
        self.counts["jobs"] += 1

    def plan_long(self, client, choose):
        self.plan(client, choose, LONG)

    def follow(self, client, choose):
        last, state = 0, None
        for event in client.events(client.submit(choose.choice(DOCUMENTS))["id"]):
            if int(event.id) <= last:
                raise RuntimeError(f"event {event.id} after {last}")
            last, state = int(event.id), event.data.get("state")
        if state != "succeeded":
            raise RuntimeError(f"the last event says {state}")
        self.counts["jobs"] += 1

    def list(self, client, _):
        for _ in zip(range(60), client.jobs(limit=20)):
            pass
        self.over.wait(0.1)

    def stop(self):
        self.over.set()
        for each in self.threads:
            each.join(600)
        expect(not any(each.is_alive() for each in self.threads), "each client comes to its end")
        expect(not self.failures, f"a request failed: {self.failures}")


def main():
    words = argparse.ArgumentParser()
    words.add_argument("binary")
    words.add_argument("--restarts", type=int, default=8)
    words.add_argument("--through", choices=(*proxies.CONFIGURES, "both"))
    words.add_argument("--hard", action="store_true")
    words = words.parse_args()
    if not programs():
        print("its server is not installed")
        sys.exit(77)
    through = words.through or (proxies.installed(proxies.CONFIGURES) or ["both"])[0]
    with Database() as database, contextlib.ExitStack() as stack:
        database.make()
        database.start()
        database.ask("CREATE DATABASE bahnwerk", "postgres")
        worker = ("--role", "worker", "--workers", "1", "--worker-nice", "0")
        roles = ("api", ("--role", "api")), ("worker", worker), ("api", ("--role", "api")), ("worker", worker)
        all = [(name, stack.enter_context(Service(words.binary, *arguments, url=database.url))) for name, arguments in roles]
        ports = [each.port for name, each in all if name == "api"]
        addresses = [f"http://127.0.0.1:{port}" for port in (ports if through == "both" else [stack.enter_context(proxies.proxy(through, ports))])]
        load, start, done = Load(addresses), time.monotonic(), collections.Counter()
        for number in range(words.restarts):
            jobs = load.counts["jobs"]
            until(lambda: load.failures or load.counts["jobs"] >= jobs + 3, "the load goes on")
            if load.failures:
                break
            name, each = all[number % len(all)]
            if words.hard:
                each.kill()
            else:
                expect(each.stop() == 0, "an orderly end")
            each.start()
            done[name] += 1
        load.stop()
        states = json.loads(all[0][1].ask("GET", "/v1/jobs?limit=1")[2])["counts"]
        expect(states["succeeded"] == sum(states.values()), f"all jobs have succeeded: {states}")
        if not words.hard:
            expect(database.ask("SELECT count(*) FROM bahnwerk.jobs WHERE attempt <> 1") == "0", "each job in its first attempt")
        expect(all[0][1].check() == "", "bahnwerk check finds nothing")
        print(f"{sum(done.values())} restarts ({', '.join(f'{count} of {name}s' for name, count in done.items())}) in {time.monotonic() - start:.0f} s, through {through}: "
              f"{', '.join(f'{count} {name}' for name, count in sorted(load.counts.items()))}; no request failed")


if __name__ == "__main__":
    main()
