#!/usr/bin/env python3
"""Kills the service again and again while clients post, cancel and delete; whatever was acknowledged is there afterwards.

    tests/crash/kills.py BINARY [--kills 50] [--seed 1]

Each round lasts until some more jobs are acknowledged and three have been planned, whatever time that takes: what ran at the last
kill has ended then, so that no job runs alone at three of them. A post without an answer is repeated with
its key and gives one job. What a client saw ended keeps its state; nothing fails. Exit 0: nothing was lost.
"""
import argparse
import json
import random
import sys
import threading
import uuid

from service import Service, example, half_circles

DOCUMENTS = [json.dumps(example("line")), json.dumps(half_circles(40)), json.dumps(half_circles(150))]
FINAL = ("succeeded", "failed", "cancelled")


class Record:
    """What clients know."""

    def __init__(self):
        self.lock = threading.Lock()
        self.posted = {}       # key: id, acknowledged
        self.unanswered = {}   # key: document
        self.ended = {}        # id: state that was seen
        self.cancelled, self.deleted, self.maybe_deleted = set(), set(), set()


def client(service, record, seed, over):
    choose = random.Random(seed)
    while not over.is_set():
        try:
            act(service, record, choose)
        except OSError:
            over.wait(0.05)


def act(service, record, choose):
    what = choose.random()
    with record.lock:
        known = [id for id in list(record.posted.values())[-200:] if id not in record.maybe_deleted]
    if what < 0.5 or not known:
        key, document = str(uuid.UUID(int=choose.getrandbits(128))), choose.choice(DOCUMENTS)
        with record.lock:
            record.unanswered[key] = document
        status, _, body = service.ask("POST", "/v1/jobs", document, {"Idempotency-Key": key})
        if status == 202:
            with record.lock:
                record.posted[key] = json.loads(body)["id"]
        with record.lock:  # 429: the queue is full
            del record.unanswered[key]
        return
    id = choose.choice(known)
    if what < 0.6:
        with record.lock:
            record.cancelled.add(id)
        service.ask("POST", f"/v1/jobs/{id}/cancel")
    elif what < 0.75:
        if service.json(f"/v1/jobs/{id}").get("state") == "running":
            return
        with record.lock:
            record.maybe_deleted.add(id)
        status = service.ask("DELETE", f"/v1/jobs/{id}")[0]
        with record.lock:
            if status == 204:
                record.deleted.add(id)
    else:
        state = service.json(f"/v1/jobs/{id}").get("state")
        if state in FINAL:
            with record.lock:
                record.ended[id] = state


def faults_of(service, record, ids):
    """Sentences on jobs that are not as clients were told."""
    for id in ids:
        status, _, body = service.ask("GET", f"/v1/jobs/{id}")
        if id in record.deleted:
            if status != 404:
                yield f"{id} was deleted and answers {status}"
            continue
        if status == 404 and id in record.maybe_deleted:
            continue
        if status != 200:
            yield f"{id} was acknowledged and answers {status}"
            continue
        job = json.loads(body)
        if id in record.ended and job["state"] != record.ended[id]:
            yield f"{id} was {record.ended[id]} and is {job['state']}"
        if job["state"] == "failed":
            yield f"{id} failed: {job['error']}"
        if job["state"] == "cancelled" and id not in record.cancelled:
            yield f"{id} was cancelled by nobody"


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("binary")
    arguments.add_argument("--kills", type=int, default=50)
    arguments.add_argument("--seed", type=int, default=1)
    options = arguments.parse_args()
    choose, record, faults, slowest = random.Random(options.seed), Record(), [], 0.0
    with Service(options.binary, "--workers", "2", "--worker-nice", "0", "--max-queued", "60") as service:
        for kill in range(options.kills):
            over, before = threading.Event(), len(record.posted)
            clients = [threading.Thread(target=client, args=(service, record, 1000 * kill + n + options.seed, over)) for n in range(4)]
            for each in clients:
                each.start()
            enough = before + choose.randint(5, 25)
            while len(record.posted) < enough or service.planned() < 3:
                over.wait(0.002)
            over.wait(choose.random() * 0.1)
            service.kill()
            over.set()
            for each in clients:
                each.join()
            slowest = max(slowest, service.start())
            ids = list(record.posted.values())
            faults += faults_of(service, record, ids[-30:] + choose.sample(ids, min(10, len(ids))))
            if faults:
                break
            if kill % 100 == 99:
                print(f"{kill + 1} kills, {len(record.posted)} acknowledged", flush=True)
        for id in record.posted.values():
            if id not in record.maybe_deleted:
                service.wait(id)
        for key, document in list(record.unanswered.items()):
            first, again = (json.loads(service.ask("POST", "/v1/jobs", document, {"Idempotency-Key": key})[2])["id"] for _ in range(2))
            if first != again:
                faults.append(f"the key {key} gave {first} and {again}")
            record.posted[key] = first
            service.wait(first)
        faults += faults_of(service, record, record.posted.values())
        listed, cursor = [], ""
        while cursor is not None:
            page = service.json(f"/v1/jobs?limit=200{cursor}")
            listed += [job["id"] for job in page["jobs"]]
            cursor = f"&cursor={page['next']}" if page["next"] else None
        if len(set(listed)) != len(listed):
            faults.append("jobs are listed twice")
        if unknown := set(listed) - set(record.posted.values()):
            faults.append(f"{len(unknown)} jobs that nobody posted, such as {unknown.pop()}")
        if code := service.stop():
            faults.append(f"the orderly end has exit code {code}")
        if said := service.check():
            faults.append("bahnwerk check: " + said)
    for fault in faults[:20]:
        print(fault)
    print(f"{options.kills} kills, {len(record.posted)} jobs acknowledged, {len(record.deleted)} deleted, {len(faults)} faults, "
          f"slowest start {slowest:.2f} s")
    sys.exit(bool(faults))


if __name__ == "__main__":
    main()
