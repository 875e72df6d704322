"""A service of its own for tests: started on a free port, asked, killed and started again with the same store."""
import http.client
import json
import os
import pathlib
import shutil
import socket
import subprocess
import tempfile
import time

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"


class Service:
    """`arguments` are flags of `bahnwerk serve`; `url` names another store than a file of its own. Ends with the block `with` that it is used in."""

    def __init__(self, binary, *arguments, store=None, url=None):
        self.binary, self.arguments = binary, list(arguments)
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="bahnwerk-"))
        self.store = pathlib.Path(store) if store else self.folder / "store.db"
        self.url = url or f"sqlite:{self.store}"
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = free.getsockname()[1]
        self.process, self.environment = None, {}  # variables beside the test's own

    def __enter__(self):
        self.start()
        return self

    def __exit__(self, *_):
        if self.process and self.process.poll() is None:
            self.kill()
        shutil.rmtree(self.folder, ignore_errors=True)

    def start(self, patience=60):
        """Starts the service; returns the seconds until it is ready."""
        begin = time.monotonic()
        with open(self.folder / "log", "ab") as log:
            self.process = subprocess.Popen(
                [self.binary, "serve", "--listen", f"127.0.0.1:{self.port}", "--store", self.url, *self.arguments],
                stdout=subprocess.DEVNULL, stderr=log, env=os.environ | self.environment)
        while True:
            try:
                if self.ask("GET", "/readyz")[0] == 200:
                    return time.monotonic() - begin
            except OSError:
                pass
            if self.process.poll() is not None:
                raise SystemExit("the service ended: " + (self.folder / "log").read_text()[-2000:])
            if time.monotonic() - begin > patience:
                raise SystemExit("the service is not ready")
            time.sleep(0.005)

    def kill(self):
        self.process.kill()
        self.process.wait()

    def stop(self):
        """An orderly end; returns its exit code."""
        self.process.terminate()
        return self.process.wait(120)

    def ask(self, method, path, document=None, headers=None, timeout=60):
        """(status, headers, body) on a connection of its own; OSError where there is no answer."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=timeout)
        try:
            body = document if document is None or isinstance(document, (str, bytes)) else json.dumps(document)
            given = dict(headers or {})
            if body is not None:
                given.setdefault("Content-Type", "application/json")
            connection.request(method, path, body, given)
            answer = connection.getresponse()
            return answer.status, answer.headers, answer.read()
        except http.client.HTTPException as error:
            raise OSError(str(error)) from error
        finally:
            connection.close()

    def json(self, path, **headers):
        return json.loads(self.ask("GET", path, headers=headers)[2])

    def post(self, document):
        status, _, body = self.ask("POST", "/v1/jobs", document)
        if status != 202:
            raise SystemExit(f"POST answers {status}: {body[:300]}")
        return json.loads(body)["id"]

    def wait(self, job, seconds=600):
        """The job when it has ended."""
        until = time.monotonic() + seconds
        while True:
            found = self.json(f"/v1/jobs/{job}", Prefer="wait=30")
            if found["state"] not in ("queued", "running") or time.monotonic() > until:
                return found

    def planned(self):
        """How many plans have ended since the start."""
        lines = self.ask("GET", "/metrics")[2].decode().splitlines()
        return sum(float(line.split()[-1]) for line in lines if line.startswith("bahnwerk_planning_seconds_count"))

    def resident(self):
        """Resident memory, MB."""
        with open(f"/proc/{self.process.pid}/status") as status:
            return int(next(line for line in status if line.startswith("VmRSS")).split()[1]) / 1024

    def check(self):
        """What `bahnwerk check` says about the store; empty if nothing is wrong."""
        checked = subprocess.run([self.binary, "check", "--store", self.url], capture_output=True, text=True)
        return "" if checked.returncode == 0 else checked.stdout + checked.stderr


def example(name):
    return json.loads((EXAMPLES / f"{name}.json").read_text())


def half_circles(count):
    """A contour of half circles end to end; some 10 ms of planning for each hundred."""
    document = example("line")
    document["spec"]["contour"] = {"start": [0, 0], "blocks": [{"mode": "cut", "segments": [
        {"arc": {"to": [2 * k, 0], "center": [2 * k - 1, 0], "direction": "cw" if k % 2 else "ccw"}} for k in range(1, count + 1)]}]}
    return document
