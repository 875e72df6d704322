#!/usr/bin/env python3
"""nginx and Caddy, as deploy/proxy has them, before two processes: what is sent to the other one when the first one fails, and what is not.

    tests/deploy/proxies.py [nginx] [caddy]

Stubs take the place of the processes. Exit 77: no proxy is installed.
"""
import contextlib
import http.client
import pathlib
import shutil
import socket
import socketserver
import subprocess
import sys
import tempfile
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
RESTS = {"nginx": 2.5, "caddy": 0}  # s, longer than a process that failed is left alone: nginx counts whole seconds, Caddy asks for /healthz
PATH = "/usr/sbin:/usr/bin:/sbin:/bin"
MANY = 8  # requests, of which some come to each


class Stub(socketserver.ThreadingTCPServer):
    """Answers each request with its name, or breaks off after it, and counts methods."""

    allow_reuse_address = daemon_threads = True

    def __init__(self, name):
        super().__init__(("127.0.0.1", 0), None)
        self.name, self.seen, self.breaks, self.go_on = name, [], False, threading.Event()
        self.port = self.server_address[1]
        threading.Thread(target=self.serve_forever, daemon=True).start()

    def finish_request(self, connection, _):
        file = connection.makefile("rwb")
        method, path = file.readline().decode().split()[:2]
        length = 0
        while (line := file.readline().decode().strip()):
            if line.lower().startswith("content-length:"):
                length = int(line.split(":")[1])
        file.read(length)
        if path != "/healthz":
            self.seen.append(method)
            if self.breaks:
                return
        if path.endswith("/events"):
            file.write(b"HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\nConnection: close\r\n\r\nevent: state\ndata: {}\n\n")
            file.flush()
            self.go_on.wait(60)
            file.write(b"event: end\ndata: {}\n\n")
        else:
            file.write(f"HTTP/1.1 200 OK\r\nContent-Length: {len(self.name)}\r\nConnection: close\r\n\r\n{self.name}".encode())
        file.flush()


def free_port():
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        return free.getsockname()[1]


def replace(text, *pairs):
    for old, new in pairs:
        if old not in text:
            sys.exit(f"deploy/proxy has no '{old}'")
        text = text.replace(old, new)
    return text


def nginx(folder, port, ports):
    text = replace((ROOT / "deploy/proxy/nginx.conf").read_text(), ("# server 127.0.0.1:8081", f"server 127.0.0.1:{ports[1]}"), ("127.0.0.1:8080", f"127.0.0.1:{ports[0]}"),
                   ("listen 443 ssl http2;", f"listen 127.0.0.1:{port};"), ("listen [::]:443 ssl http2;", ""), ("listen 80;", f"listen 127.0.0.1:{free_port()};"),
                   ("listen [::]:80;", ""), ("fail_timeout=5s", "fail_timeout=1s"))
    text = "\n".join(line for line in text.splitlines() if not line.strip().startswith("ssl_"))
    paths = "".join(f"{name}_temp_path {folder}/{name}; " for name in ("client_body", "proxy", "fastcgi", "uwsgi", "scgi"))
    # One worker, so that a test knows what it remembers.
    (folder / "nginx.conf").write_text(f"pid {folder}/pid; error_log {folder}/log; worker_processes 1; daemon off; events {{}} http {{ access_log off; {paths}\n{text}\n}}")
    return ["nginx", "-e", folder / "log", "-c", folder / "nginx.conf"]


def caddy(folder, port, ports):
    text = replace((ROOT / "deploy/proxy/Caddyfile").read_text(), ("reverse_proxy 127.0.0.1:8080 {", f"reverse_proxy 127.0.0.1:{ports[0]} 127.0.0.1:{ports[1]} {{"),
                   ("planning.example.com {", f"{{\n\tadmin off\n\tauto_https off\n}}\nhttp://127.0.0.1:{port} {{"))
    (folder / "Caddyfile").write_text(text)
    return ["caddy", "run", "--adapter", "caddyfile", "--config", folder / "Caddyfile"]


def ask(port, method, path="/v1/jobs", body=None):
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=120)
    try:
        connection.request(method, path, body, {"Host": f"127.0.0.1:{port}"})
        answer = connection.getresponse()
        return answer.status, dict(answer.getheaders()), answer.read().decode()
    finally:
        connection.close()


def expect(condition, what):
    if not condition:
        sys.exit(f"wrong: {what}")


def until(condition, what):
    end = time.monotonic() + 60
    while not condition():
        expect(time.monotonic() < end, f"never: {what}")
        time.sleep(0.05)


def answers(port):
    try:
        return ask(port, "GET")[0] == 200
    except OSError:
        return False


@contextlib.contextmanager
def proxy(name, ports):
    """Gives the port of the proxy before these ports, when it answers."""
    port, folder = free_port(), pathlib.Path(tempfile.mkdtemp(prefix="bahnwerk-proxy-"))
    environment = {"XDG_DATA_HOME": str(folder), "XDG_CONFIG_HOME": str(folder), "HOME": str(folder), "PATH": PATH}
    with open(folder / "out", "wb") as out:
        process = subprocess.Popen(CONFIGURES[name](folder, port, ports), stdout=out, stderr=out, env=environment)
    try:
        until(lambda: answers(port) or process.poll() is not None, f"{name} answers")
        expect(process.poll() is None, f"{name} does not start: {(folder / 'out').read_text()[-2000:]}")
        yield port
    finally:
        process.terminate()
        process.wait()
        shutil.rmtree(folder, ignore_errors=True)


def check(name):
    stubs = [Stub("one"), Stub("two")]
    try:
        with proxy(name, [stub.port for stub in stubs]) as port:
            check_through(name, port, stubs)
        print(f"{name}: two processes", flush=True)
    finally:
        for stub in stubs:
            stub.server_close()


def check_through(name, port, stubs):
    # No stickiness: requests of one client come to both.
    until(lambda: {ask(port, "GET")[2] for _ in range(8)} == {"one", "two"}, "both are asked")

    # An event comes before the stream's end.
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=60)
    connection.request("GET", "/v1/events", headers={"Host": f"127.0.0.1:{port}"})
    stream = connection.getresponse()
    expect(stream.readline() == b"event: state\n", "the first event")
    for stub in stubs:
        stub.go_on.set()
    expect(b"event: end" in stream.read(), "the rest of the stream")
    connection.close()

    # Both take requests and break off: each is tried with what may be carried out twice, one alone with a POST.
    for method, body, expected in (("GET", None, 2), ("DELETE", None, 2), ("POST", b"{}", 1)):
        for broken in stubs, stubs[:1]:
            time.sleep(RESTS[name])
            for stub in stubs:
                stub.breaks = stub in broken
                stub.seen.clear()
            if len(broken) == 2:
                status, headers, _ = ask(port, method, body=body)
                expect(status == 503 and "Retry-After" in headers, f"{name}, {method}, both break off: {status} {headers}")
                asked = sum(len(stub.seen) for stub in stubs)
                expect(asked == expected, f"{name}, {method}, both break off: {asked} attempts")
            else:
                statuses = [ask(port, method, body=body)[0] for _ in range(MANY)]
                repeated = len(stubs[0].seen) + len(stubs[1].seen) - MANY
                expect(len(stubs[0].seen) >= 1, f"{name}, {method}: the one that breaks off is not asked")
                if expected == 2:
                    expect(statuses == [200] * MANY and repeated == len(stubs[0].seen), f"{name}, {method}, one breaks off: {statuses}, {repeated} repeated")
                else:
                    expect(repeated == 0 and set(statuses) == {200, 503}, f"{name}, {method}, one breaks off: {statuses}, {repeated} repeated")

    # Beside a process that is gone, clients that repeat what gets 503 lose nothing; then nothing goes there any more.
    time.sleep(RESTS[name])
    stubs[0].breaks = False
    stubs[0].shutdown()
    stubs[0].server_close()

    def posts():
        answers = [ask(port, "POST", body=b"{}") for _ in range(MANY)]
        expect(all(status == 200 or (status == 503 and "Retry-After" in headers) for status, headers, _ in answers), f"{name}: a POST beside a process that is gone: {answers}")
        return [body for _, _, body in answers] == ["two"] * MANY

    until(posts, f"{name} leaves a process alone that is gone")


CONFIGURES = {"nginx": nginx, "caddy": caddy}


def installed(names):
    return [name for name in names if shutil.which(name, path=PATH)]


def main():
    found = installed(sys.argv[1:] or CONFIGURES)
    if not found:
        print("its proxies are not installed")
        sys.exit(77)
    for name in found:
        check(name)


if __name__ == "__main__":
    main()
