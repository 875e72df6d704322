"""A PostgreSQL server of its own for tests, from Debian's package: in a folder, on a socket there, as a user of its own."""
import os
import pathlib
import pwd
import shutil
import signal
import subprocess
import tempfile
import time


def programs():
    """The folder of the server's programs; None: there are none."""
    found = [path.parent for path in pathlib.Path("/usr/lib/postgresql").glob("*/bin/initdb")]
    return max(found, key=lambda path: int(path.parent.name)) if found else None


class Database:
    """Ends with the block `with` that it is used in."""

    def __init__(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="bahnwerk-postgres-"))
        self.data = self.folder / "data"
        self.settings = "-c fsync=off -c max_connections=100"
        self.url = f"postgresql://postgres@/bahnwerk?host={self.folder}"
        # The server refuses to be root's.
        user = pwd.getpwnam("nobody")
        self.user = {"user": user.pw_uid, "group": user.pw_gid, "extra_groups": []} if os.getuid() == 0 else {}
        if self.user:
            os.chown(self.folder, user.pw_uid, user.pw_gid)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if (self.data / "postmaster.pid").exists():
            self.resume()
            self.stop("immediate")
        shutil.rmtree(self.folder, ignore_errors=True)

    def run(self, program, *arguments):
        done = subprocess.run([programs() / program, *arguments], cwd=self.folder, capture_output=True, text=True, **self.user)
        if done.returncode:
            raise SystemExit(f"{program} failed: {done.stdout}{done.stderr}")
        return done.stdout

    def make(self):
        self.run("initdb", "-D", self.data, "-U", "postgres", "-A", "trust", "-E", "UTF8", "--locale=C.UTF-8", "--no-sync", "--no-instructions")

    def copy(self, other):
        """Makes this one a standby of the other."""
        self.run("pg_basebackup", "-D", self.data, "-h", other.folder, "-U", "postgres", "-R", "-c", "fast", "--no-sync")

    def start(self):
        self.run("pg_ctl", "-D", self.data, "-w", "-t", "600", "-l", self.folder / "log", "-o",
                 f"-k {self.folder} -c listen_addresses= {self.settings}", "start")

    def stop(self, mode="fast"):
        self.run("pg_ctl", "-D", self.data, "-w", "-t", "600", "-m", mode, "stop")

    def promote(self):
        self.run("pg_ctl", "-D", self.data, "-w", "-t", "600", "promote")

    def ask(self, sql, database="bahnwerk"):
        return self.run("psql", "-h", self.folder, "-U", "postgres", "-d", database, "-XAtqc", sql).strip()

    def processes(self):
        first = int((self.data / "postmaster.pid").read_text().split()[0])
        children = subprocess.run(["ps", "-o", "pid=", "--ppid", str(first)], capture_output=True, text=True).stdout.split()
        return [first, *map(int, children)]

    def signal(self, number):
        for process in self.processes():
            try:
                os.kill(process, number)
            except ProcessLookupError:
                pass

    def pause(self):
        """The server stands still: it takes connections and answers nothing."""
        self.signal(signal.SIGSTOP)

    def resume(self):
        self.signal(signal.SIGCONT)


def until(condition, what, seconds=600):
    """Waits for a condition, whatever time that takes on a busy machine."""
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise SystemExit(f"never: {what}")
        time.sleep(0.05)
