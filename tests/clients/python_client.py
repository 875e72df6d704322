"""python_client.py URL PROXY EXAMPLES WORK [test…]: called by python.sh."""
import email.utils
import hashlib
import hmac
import http.server
import json
import os
import sys
import threading
import time
import unittest
import uuid
from pathlib import Path

if os.environ.get("BAHNWERK_NO_NUMPY"):
    sys.modules["numpy"] = None

import bahnwerk
from bahnwerk import Client, JobFailed, Problem

url, proxy, examples, work = sys.argv[1:5]
line = json.loads(Path(examples, "line.json").read_text())


class JobsTest(unittest.TestCase):
    client = Client(url)

    def test_plans_from_document_to_result(self):
        seen = []
        job = self.client.submit(line)
        done = self.client.wait(job["id"], on_progress=seen.append)
        self.assertEqual((done["id"], done["state"]), (job["id"], "succeeded"))
        self.assertEqual(seen[-1]["fraction"], 1)
        result = self.client.result(job["id"])
        self.assertTrue(result["verification"]["passed"])
        self.assertEqual(json.loads(self.client.spec(job["id"])), line)
        self.assertEqual(self.client.plan(Path(examples, "line.json").read_text())["summary"], result["summary"])

    def test_names_the_place_of_a_fault(self):
        with self.assertRaises(Problem) as caught:
            self.client.submit(Path(work, "wrong.json").read_bytes())
        self.assertEqual((caught.exception.status, caught.exception.slug), (422, "schema-violation"))
        self.assertIn("/spec/contour/blocks/0/feed: ", str(caught.exception))

    def test_says_why_a_job_failed(self):
        job = self.client.submit(Path(work, "budget.json").read_text())
        with self.assertRaises(JobFailed) as caught:
            self.client.wait(job["id"])
        self.assertEqual(caught.exception.slug, "budget-exhausted")
        self.assertEqual(caught.exception.job["state"], "failed")

    def test_repeats_a_post_without_a_second_job(self):
        key = str(uuid.uuid4())
        first, second = (self.client.submit(line, idempotency_key=key)["id"] for _ in range(2))
        self.assertEqual(first, second)
        self.assertNotEqual(self.client.submit(line)["id"], first)

    def test_lists_all_pages_and_deletes(self):
        document = dict(line, reference=str(uuid.uuid4()))
        ids = [self.client.submit(document)["id"] for _ in range(3)]
        listed = [job["id"] for job in self.client.jobs(reference=document["reference"], limit=2)]
        self.assertEqual(listed, ids[::-1])
        for id in ids:
            self.client.wait(id)
            self.client.delete(id)
        with self.assertRaises(Problem) as caught:
            self.client.job(ids[0])
        self.assertEqual(caught.exception.status, 404)

    def test_stops_waiting(self):
        job = self.client.submit(Path(work, "long.json").read_text())
        with self.assertRaises(TimeoutError):
            self.client.wait(job["id"], timeout=0)
        self.client.cancel(job["id"])
        with self.assertRaises(JobFailed) as caught:
            self.client.wait(job["id"])
        self.assertEqual(caught.exception.slug, "cancelled")

    def test_gives_up_where_no_server_is(self):
        with self.assertRaises(OSError):
            Client("http://127.0.0.1:1", patience=0).job("x")
        with self.assertRaises(OSError):
            next(Client("http://127.0.0.1:1", patience=0).events("x"))
        for wrong in ("localhost:8080", "ftp://x", ""):
            with self.assertRaises(ValueError):
                Client(wrong)


class Restarting(http.server.BaseHTTPRequestHandler):
    """A service that restarts behind a proxy: 502 as nginx answers, 504, 503 with a date, then the job. `asked` holds
    the Authorization of each request."""
    asked = []

    def do_GET(self):
        answers = [(502, {}), (504, {}), (503, {"Retry-After": email.utils.formatdate(time.time() + 1, usegmt=True)})]
        status, headers = answers[len(self.asked)] if len(self.asked) < len(answers) else (200, {})
        self.asked.append(self.headers.get("Authorization"))
        body = b'{"id":"x","state":"queued"}' if status == 200 else b"<html>Bad Gateway</html>"
        self.send_response(status)
        for name, value in {**headers, "Content-Length": str(len(body))}.items():
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, *_):
        pass


class RestartTest(unittest.TestCase):
    def test_lives_through_a_restart_behind_a_proxy(self):
        with http.server.ThreadingHTTPServer(("127.0.0.1", 0), Restarting) as server:
            threading.Thread(target=server.serve_forever, daemon=True).start()
            client = Client("http://me:p%%40ss@127.0.0.1:%d" % server.server_address[1])
            self.assertEqual(client.job("x")["state"], "queued")
            server.shutdown()
        self.assertEqual(Restarting.asked, ["Basic bWU6cEBzcw=="] * 4)

    def test_reads_both_forms_of_retry_after(self):
        self.assertEqual([bahnwerk.retry_after(value) for value in ("7", None, "nonsense", "0")], [7, 1, 1, 0])
        self.assertEqual(bahnwerk.retry_after("Fri, 31 Dec 9999 23:59:59 GMT"), 3600)
        self.assertEqual(bahnwerk.retry_after("Sun, 06 Nov 1994 08:49:37 GMT"), 0.1)


class EventsTest(unittest.TestCase):
    def test_follows_over_broken_connections(self):
        client = Client(proxy)
        job = client.submit(Path(work, "long.json").read_text())
        events = []
        for event in client.events(job["id"], retry=0.01):
            events.append(event)
            if len(events) == 3:
                client.cancel(job["id"])
        ids = [int(event.id) for event in events]
        self.assertEqual(ids, sorted(set(ids)), "nothing comes twice or out of order")
        self.assertEqual(events[0].name, "state")
        self.assertEqual(events[-1].data["state"], "cancelled")
        self.assertTrue(all(event.name in ("state", "progress") for event in events))

    def test_a_job_that_has_ended_has_one_event(self):
        client = Client(url)
        job = client.submit(line)
        client.wait(job["id"])
        states = [event.data["state"] for event in client.events(job["id"])]
        self.assertEqual(states, ["succeeded"])

    def test_reads_streams_as_they_come(self):
        stream = [b"retry: 250\n", b"\n", b": comment\n", b"id: 4\r\n", b"event: progress\r\n", b'data: {"a":\r\n',
                  b"data: 1}\r\n", b"\r\n", b"id: 5\n", b'data: {"lost": true}\n', b"da"]
        found = list(bahnwerk.read_events(stream))
        self.assertEqual(found, [("retry", 0.25), ("event", bahnwerk.Event("4", "progress", {"a": 1}))])


class PathTest(unittest.TestCase):
    def test_a_line_has_two_vertices_and_one_block(self):
        client = Client(url)
        self.assertEqual(client.check(line)["kind"], "contour")
        job = client.submit(line)
        client.wait(job["id"])
        path = client.path(job["id"], tolerance=0.01, box=(-1, -1, 101, 1), columns=["v", "block"])
        self.assertEqual(path["values"]["x"], [0, 100])
        blocks = list(client.blocks(job["id"], by="segment", sort="lost"))
        self.assertEqual([block["length"] for block in blocks], [100])
        parts = client.result(job["id"], parts=["summary", "details.slowest"])
        self.assertEqual((list(parts), list(parts["details"])), (["details", "summary"], ["slowest"]))


class RowsTest(unittest.TestCase):
    def test_gives_columns(self):
        client = Client(url)
        job = client.submit(line)
        client.wait(job["id"])
        total = client.result(job["id"])["setpoints"]["count"]
        rows = client.rows(job["id"])
        self.assertIn("vx", rows.columns)
        self.assertEqual({len(column) for column in rows.values}, {total})
        self.assertEqual(isinstance(rows["x"], list), bahnwerk.numpy is None)
        self.assertEqual((rows["x"][0], rows["x"][-1], rows["vx"][-1]), (0, 100, 0))
        part = client.rows(job["id"], columns=["vx", "x"], first=10, count=8, every=2)
        self.assertEqual(part.columns, ["vx", "x"])
        self.assertEqual(list(part["x"]), list(rows["x"][10:18:2]))
        with self.assertRaises(Problem) as caught:
            client.rows(job["id"], columns=["nonsense"])
        self.assertEqual(caught.exception.status, 422)

    def test_checks_who_calls(self):
        def signed(t, body=b'{"id": "x"}', secret=b"s"):
            return "t=%d,v1=%s" % (t, hmac.new(secret, b"%d." % t + body, hashlib.sha256).hexdigest())

        now = int(time.time())
        self.assertEqual(bahnwerk.called_job(signed(now), b'{"id": "x"}', "s"), {"id": "x"})
        for wrong in (signed(now, secret=b"r"), signed(now, b"{}"), signed(now - 1000), "", None, "t=1", "v1=00"):
            with self.assertRaises(ValueError):
                bahnwerk.called_job(wrong, b'{"id": "x"}', "s")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[5:])
