#!/usr/bin/env python3
"""A client of the planning service in one file, with nothing but Python's standard library (3.9 or later).

    from bahnwerk import Client
    client = Client("http://127.0.0.1:8080")            # where keys are needed: Client(url, key="bw_…", ca="ca.pem")
    job = client.submit(document)                       # a dict, or a job document as text
    job = client.wait(job["id"], on_progress=print)     # raises JobFailed unless it succeeded
    result = client.result(job["id"])
    rows = client.rows(job["id"], columns=["x", "y"])   # rows.columns, rows.values: one list (or numpy array) per column
    job = called_job(headers["Bahnwerk-Signature"], body, secret)   # in a receiver of callbacks

As a program: python3 bahnwerk.py JOB.json [--server URL] plans a document and prints its result document.

Units are those of the service: mm, s, deg. Every fault that the service reports is a `Problem` with its document.
"""
import array
import base64
import email.utils
import hashlib
import hmac
import http.client
import json
import os
import socket
import ssl
import sys
import time
import urllib.parse
import uuid
from dataclasses import dataclass

try:
    import numpy
except ImportError:
    numpy = None

FINAL = ("succeeded", "failed", "cancelled")
RETRIED = (429, 502, 503, 504, 507)  # asking again may help: the service is busy, or restarts behind a proxy


class Problem(Exception):
    """What the service refused; `document` is its problem document (RFC 9457), `slug` its type without /problems/."""

    def __init__(self, status, document):
        self.status, self.document = status, document
        self.slug = document.get("type", "").rsplit("/", 1)[-1]
        lines = [document.get("detail") or document.get("title", "HTTP %d" % status)]
        lines += ["  %s: %s" % (fault["pointer"], fault["message"]) for fault in document.get("errors", [])]
        super().__init__("\n".join(lines))


class JobFailed(Problem):
    """A job that failed or was cancelled; `job` is its resource, `document` why."""

    def __init__(self, job):
        self.job = job
        super().__init__(200, job.get("error") or {})


@dataclass
class Event:
    id: str
    name: str  # "state": data is the job resource; "progress": data is its member progress
    data: dict


@dataclass
class Rows:
    columns: list  # names
    values: list  # one sequence of floats per column
    first: int
    every: int

    def __getitem__(self, name):
        return self.values[self.columns.index(name)]


class Client:
    def __init__(self, server="http://127.0.0.1:8080", timeout=75.0, patience=60.0, key=None, ca=None):
        """`timeout`: how long one answer may stay out, s. `patience`: how long a request that found no server, or one
        that cannot serve now, is repeated before the error is raised, s; 0: not at all. `key`: sent with every
        request; by default that of the environment, BAHNWERK_KEY. `ca`: a file, PEM, with the authorities that the
        server's certificate may come from; by default BAHNWERK_CA, else the system's."""
        parts = urllib.parse.urlsplit(server)
        if parts.scheme not in ("http", "https") or not parts.hostname:
            raise ValueError("expected http://HOST[:PORT][/PREFIX], got %r" % server)
        self._parts, self.timeout, self.patience = parts, timeout, patience
        key, ca = key or os.environ.get("BAHNWERK_KEY"), ca or os.environ.get("BAHNWERK_CA")
        self._headers = {"Authorization": "Bearer " + key} if key else {}
        self._tls = {"context": ssl.create_default_context(cafile=ca)} if parts.scheme == "https" else {}
        if parts.username is not None:  # http://USER:PASSWORD@HOST, for a proxy that asks who one is
            user = "%s:%s" % tuple(urllib.parse.unquote(part or "") for part in (parts.username, parts.password))
            self._headers["Authorization"] = "Basic " + base64.b64encode(user.encode()).decode()

    # Jobs

    def submit(self, document, idempotency_key=None):
        """Posts a job document and returns the job, which is durable then. It is safe to repeat: without a key of the
        caller's own one is made, so that a post whose answer was lost does not make a second job."""
        body = document if isinstance(document, (str, bytes)) else json.dumps(document)
        body = body.encode() if isinstance(body, str) else body
        headers = {"Content-Type": "application/json", "Idempotency-Key": idempotency_key or str(uuid.uuid4())}
        return self._json("POST", "/v1/jobs", headers, body)

    def check(self, document):
        """Checks a job document without posting it: {kind, checked, notes, estimate, outline}, or a Problem as a post
        would raise it."""
        body = document if isinstance(document, (str, bytes)) else json.dumps(document)
        body = body.encode() if isinstance(body, str) else body
        return self._json("POST", "/v1/check", {"Content-Type": "application/json"}, body)

    def job(self, id):
        return self._json("GET", self._path(id))

    def jobs(self, **filters):
        """All jobs, newest first, page by page; filters: state, kind, reference, limit (of a page)."""
        while True:
            page = self._json("GET", "/v1/jobs?" + urllib.parse.urlencode(filters))
            yield from page["jobs"]
            if not page["next"]:
                return
            filters["cursor"] = page["next"]

    def wait(self, id, timeout=None, on_progress=None):
        """Returns the job when it has succeeded, raises JobFailed when it ended otherwise, TimeoutError after `timeout`
        seconds. `on_progress` is called with the member progress whenever that has changed."""
        until = None if timeout is None else time.monotonic() + timeout
        etag = None
        while True:
            left = 60.0 if until is None else max(0.0, until - time.monotonic())
            headers = {"Prefer": "wait=%d" % min(60, max(1, round(left)))}
            if on_progress and etag:
                headers["If-None-Match"] = etag
            status, answer, body = self._request("GET", self._path(id), headers)
            if status != 304:
                job, etag = json.loads(body), answer["ETag"]
                if on_progress:
                    on_progress(job["progress"])
                if job["state"] == "succeeded":
                    return job
                if job["state"] in FINAL:
                    raise JobFailed(job)
            if until is not None and time.monotonic() >= until:
                raise TimeoutError("job %s has not ended after %g s" % (id, timeout))

    def events(self, id, retry=None):
        """The job's events until it has ended, over broken connections and restarts of the service: each connection
        says which event it had last. `retry`: pause before the next connection, s; None: what the service asks for."""
        last, pause, deadline = None, 3.0, None
        while True:
            connection = None
            try:
                headers = {"Accept": "text/event-stream"}
                if last is not None:
                    headers["Last-Event-ID"] = last
                connection, response = self._open("GET", self._path(id, "/events"), headers)
                if response.status == 204:
                    return
                if response.status != 200:
                    self._raise(response.status, response.read())
                for kind, value in read_events(response):
                    deadline = None  # something came: the service lives
                    if kind == "retry":
                        pause = value
                        continue
                    last = value.id
                    yield value
                    if value.name == "state" and value.data["state"] in FINAL:
                        return
            except Problem as problem:
                if problem.status not in RETRIED:
                    raise
                deadline = self._give_up_at(deadline, problem)
            except (OSError, http.client.HTTPException) as error:
                deadline = self._give_up_at(deadline, error)
            finally:
                if connection:
                    connection.close()
            time.sleep(pause if retry is None else retry)

    def cancel(self, id):
        return self._json("POST", self._path(id, "/cancel"))

    def delete(self, id):
        self._request("DELETE", self._path(id))

    # Results

    def spec(self, id):
        """The job document, byte for byte as posted."""
        return self._request("GET", self._path(id, "/spec"))[2]

    def result(self, id, parts=None):
        """The result document, or some members of it: parts=["summary", "details.slowest"]."""
        query = "?" + urllib.parse.urlencode({"parts": ",".join(parts)}) if parts else ""
        return self._json("GET", self._path(id, "/result" + query))

    def blocks(self, id, by="block", sort="start"):
        """Blocks, segments or lines of a contour with their times and what they lose, page by page."""
        first = 0
        while True:
            query = urllib.parse.urlencode({"by": by, "sort": sort, "first": first, "count": 1000})
            page = self._json("GET", self._path(id, "/blocks?" + query))
            yield from page["blocks"]
            first += len(page["blocks"])
            if first >= page["total"]:
                return

    def path(self, id, **query):
        """The path in few vertices, which are rows: {tolerance, columns, values}. Query: points or tolerance, box
        (x0, y0, x1, y1), first, count, of, columns."""
        for name in ("box", "columns"):
            if name in query:
                query[name] = ",".join(map(str, query[name]))
        return self._json("GET", self._path(id, "/path?" + urllib.parse.urlencode(query)))

    def scene(self, id):
        """The bodies among which the motion takes place: part, tools, needle and laid wires of a winding, tube of a
        probe path, range of fine axes in space. {bodies, movers, frame, place, box}."""
        return self._json("GET", self._path(id, "/scene"))

    def rows(self, id, columns=None, first=0, count=None, every=1):
        """Setpoints, column by column: lists of floats, or numpy arrays where numpy is installed. Every `every`-th of
        the `count` rows from `first` on; None: to the end."""
        query = {"first": first, "every": every}
        if count is not None:
            query["count"] = count
        if columns is not None:
            query["columns"] = ",".join(columns)
        path = self._path(id, "/setpoints?") + urllib.parse.urlencode(query)
        _, headers, body = self._request("GET", path, {"Accept": "application/octet-stream"})
        names = headers["X-Columns"].split(",")
        if numpy is not None:
            table = numpy.frombuffer(body, dtype="<f8").reshape(-1, len(names))
            values = [table[:, k] for k in range(len(names))]
        else:
            flat = array.array("d", body)
            if sys.byteorder == "big":
                flat.byteswap()
            values = [flat[k :: len(names)].tolist() for k in range(len(names))]
        return Rows(names, values, first, every)

    def limits(self, id, first=0, count=None, points=None):
        """Which limits kept the motion from being faster: `limits` with time and share of each; with `points` also
        shares in that many intervals."""
        query = {"first": first}
        if count is not None:
            query["count"] = count
        if points is not None:
            query["points"] = points
        return self._json("GET", self._path(id, "/limits?") + urllib.parse.urlencode(query))

    def plan(self, document, timeout=None, on_progress=None):
        """submit, wait, result."""
        job = self.submit(document)
        self.wait(job["id"], timeout, on_progress)
        return self.result(job["id"])

    # Requests

    @staticmethod
    def _path(id, rest=""):
        return "/v1/jobs/" + urllib.parse.quote(id, safe="") + rest

    def _open(self, method, path, headers, body=None):
        kind = http.client.HTTPSConnection if self._parts.scheme == "https" else http.client.HTTPConnection
        connection = kind(self._parts.hostname, self._parts.port, timeout=self.timeout, **self._tls)
        try:
            connection.request(method, self._parts.path.rstrip("/") + path, body, {**self._headers, **headers})
            return connection, connection.getresponse()
        except BaseException:
            connection.close()
            raise

    def _request(self, method, path, headers=None, body=None):
        """Status, headers and body of the answer; repeats what found no server or one that cannot serve now."""
        deadline = None
        while True:
            pause, connection = 1.0, None
            try:
                connection, response = self._open(method, path, headers or {}, body)
                text = response.read()
                if response.status < 400:
                    return response.status, response.headers, text
                pause = retry_after(response.headers.get("Retry-After"))
                self._raise(response.status, text)
            except Problem as problem:
                if problem.status not in RETRIED:
                    raise
                deadline = self._give_up_at(deadline, problem)
            except (OSError, http.client.HTTPException) as error:
                deadline = self._give_up_at(deadline, error)
            finally:
                if connection:
                    connection.close()
            time.sleep(min(pause, max(0.0, deadline - time.monotonic())))

    def _json(self, method, path, headers=None, body=None):
        return json.loads(self._request(method, path, headers, body)[2])

    def _give_up_at(self, deadline, error):
        """When to stop repeating; raises `error` where that has passed. `deadline`: None before the first failure."""
        now = time.monotonic()
        if deadline is None:
            deadline = now + self.patience
        if now >= deadline:
            raise error
        return deadline

    @staticmethod
    def _raise(status, body):
        try:
            document = json.loads(body)
        except ValueError:  # not from the service: a proxy's page
            document = {}
        raise Problem(status, document if isinstance(document, dict) else {})


def called_job(signature, body, secret, tolerance=300.0):
    """The job that a callback tells of. `signature`: the header Bahnwerk-Signature; `body`: the bytes as they came.
    ValueError unless it was signed with the secret, at most `tolerance` s ago."""
    parts = dict(part.partition("=")[::2] for part in (signature or "").split(","))
    time_of_call = parts.get("t", "")
    expected = hmac.new(secret.encode(), time_of_call.encode() + b"." + body, hashlib.sha256).hexdigest()
    if not hmac.compare_digest(parts.get("v1", "").encode(), expected.encode()):
        raise ValueError("the signature is not that of the secret")
    if abs(time.time() - int(time_of_call)) > tolerance:
        raise ValueError("the call is too old")
    return json.loads(body)


def retry_after(value):
    """Seconds to wait, from either form of Retry-After: a number of seconds or a date; 1 without one."""
    try:
        return max(0.0, float(value))
    except (TypeError, ValueError):
        pass
    try:
        return min(3600.0, max(0.1, email.utils.parsedate_to_datetime(value).timestamp() - time.time()))
    except (TypeError, ValueError):
        return 1.0


def read_events(lines):
    """("retry", seconds) and ("event", Event) from the lines of an event stream; what breaks off is no event."""
    id, name, data = "", "message", []
    for line in lines:
        if not line.endswith(b"\n"):
            return
        line = line.decode().rstrip("\r\n")
        if not line:
            if data:
                yield "event", Event(id, name, json.loads("\n".join(data)))
            name, data = "message", []
            continue
        field, _, value = line.partition(":")
        value = value[1:] if value.startswith(" ") else value
        if field == "id":
            id = value
        elif field == "event":
            name = value
        elif field == "data":
            data.append(value)
        elif field == "retry" and value.isdigit():
            yield "retry", int(value) / 1000


def main(arguments):
    import argparse

    parser = argparse.ArgumentParser(description="Plans a job document with the service, prints the result document.")
    parser.add_argument("job", help="job document, - for stdin")
    parser.add_argument("--server", default="http://127.0.0.1:8080")
    given = parser.parse_args(arguments)
    document = sys.stdin.read() if given.job == "-" else open(given.job, encoding="utf-8").read()
    client = Client(given.server, patience=10)
    show = lambda progress: print("%3.0f %% %s" % (100 * progress["fraction"], progress["stage"]), file=sys.stderr)
    try:
        json.dump(client.plan(document, on_progress=show), sys.stdout)
        print()
    except Problem as problem:
        print(problem, file=sys.stderr)
        return 1
    except (OSError, socket.timeout) as error:
        print("%s: %s" % (given.server, error), file=sys.stderr)
        return 3
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
