"""A proxy between a program and its PostgreSQL servers, with a socket for each in a folder of its own: what passes can be cut, delayed and held back, and a commit
can be parted from its answer."""
import pathlib
import re
import shutil
import socket
import struct
import tempfile
import threading
import time

WRITES = re.compile(rb"INSERT INTO|UPDATE |DELETE FROM")
SOCKET = ".s.PGSQL.5432"


class Messages:
    """What a client sends, in messages: knows when the server is asked to commit a write."""

    def __init__(self):
        self.rest, self.started, self.texts, self.writing, self.inside = b"", False, {}, False, False

    def commits(self, piece):
        """Whether a commit of a write ends in this piece."""
        self.rest += piece
        found = False
        while True:
            head = 1 if self.started else 0
            if len(self.rest) < head + 4:
                return found
            size = head + struct.unpack(">I", self.rest[head:head + 4])[0]
            if len(self.rest) < size:
                return found
            kind, body, self.rest = self.rest[:head], self.rest[head + 4:size], self.rest[size:]
            if not self.started:
                self.started = body[:4] == b"\0\3\0\0"  # else a question about encryption
            elif kind == b"P":
                name, text = body.split(b"\0", 2)[:2]
                self.texts[name] = text
            elif kind == b"B":
                self.writing = self.writing or bool(WRITES.search(self.texts.get(body.split(b"\0", 2)[1], b"")))
            elif kind == b"Q":
                ends = body.startswith((b"COMMIT", b"ROLLBACK"))
                found = found or (self.writing and body.startswith(b"COMMIT"))
                self.writing = self.writing and not ends
                self.inside = body.startswith(b"BEGIN") or (self.inside and not ends)
            elif kind == b"S" and not self.inside:
                found = found or self.writing
                self.writing = False


class Wire:
    """`hosts` are folders of servers' sockets. Faults hold from the call on until restore(). Ends with the block `with` that it is used in."""

    def __init__(self, *hosts):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="bahnwerk-wire-"))
        self.lock = threading.Condition()
        self.open, self.refuses, self.holds, self.delay, self.unanswered, self.parted = set(), False, False, 0, 0, 0
        self.ways = []  # folder of our socket, listener
        for number, host in enumerate(hosts):
            folder = self.folder / str(number)
            folder.mkdir()
            listener = socket.socket(socket.AF_UNIX)
            listener.bind(str(folder / SOCKET))
            listener.listen(128)
            self.ways.append((folder, listener))
            threading.Thread(target=self.accept, args=(listener, str(pathlib.Path(host) / SOCKET)), daemon=True).start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for _, listener in self.ways:
            listener.close()
        self.cut()
        shutil.rmtree(self.folder, ignore_errors=True)

    def url(self):
        """With several servers, that of the one that is written is found."""
        hosts = ",".join(str(folder) for folder, _ in self.ways)
        return f"postgresql://postgres@/bahnwerk?host={hosts}" + ("&target_session_attrs=read-write" if len(self.ways) > 1 else "")

    def cut(self, refuse=False):
        """Ends all connections; `refuse`: and each new one."""
        with self.lock:
            self.refuses = refuse
            pairs = list(self.open)
            self.lock.notify_all()
        for pair in pairs:
            self.end(pair)

    def hold(self):
        """Nothing passes, and no connection ends."""
        with self.lock:
            self.holds = True

    def slow(self, seconds):
        """Each piece waits for so long."""
        with self.lock:
            self.delay = seconds

    def part(self, commits):
        """The connections of the next writes end after the server has answered that they are committed; the program never gets the answers."""
        with self.lock:
            self.unanswered = commits

    def restore(self):
        with self.lock:
            self.refuses, self.holds, self.delay, self.unanswered = False, False, 0, 0
            self.lock.notify_all()

    def accept(self, listener, address):
        while True:
            try:
                client, _ = listener.accept()
            except OSError:
                return
            server = socket.socket(socket.AF_UNIX)
            try:
                if self.refuses:
                    raise OSError
                server.connect(address)
            except OSError:
                client.close()
                server.close()
                continue
            pair = (client, server)
            drop = threading.Event()  # the next answer is not passed on
            with self.lock:
                self.open.add(pair)
            threading.Thread(target=self.forward, args=(pair, client, server, Messages(), drop), daemon=True).start()
            threading.Thread(target=self.forward, args=(pair, server, client, None, drop), daemon=True).start()

    def end(self, pair):
        with self.lock:
            self.open.discard(pair)
        for each in pair:
            try:
                each.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass

    def forward(self, pair, source, target, messages, drop):
        try:
            while True:
                piece = source.recv(65536)
                if not piece:
                    break
                if self.delay:
                    time.sleep(self.delay)
                if self.holds:
                    with self.lock:
                        self.lock.wait_for(lambda: not self.holds or pair not in self.open)
                if messages is not None and messages.commits(piece):
                    with self.lock:
                        if self.unanswered > 0:
                            self.unanswered -= 1
                            drop.set()
                elif messages is None and drop.is_set():
                    with self.lock:
                        self.parted += 1
                    break
                target.sendall(piece)
        except OSError:
            pass
        self.end(pair)
        source.close()
