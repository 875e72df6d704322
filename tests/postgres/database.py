"""A PostgreSQL server of its own for tests, from Debian's package: in a folder, on a socket there, as a user of its own."""
import os
import pathlib
import pwd
import shutil
import signal
import subprocess
import sys
import tempfile
import time

OWN_MOUNTS = "BAHNWERK_TEST_OWN_MOUNTS"


def programs():
    """The folder of the server's programs; None: there are none."""
    found = [path.parent for path in pathlib.Path("/usr/lib/postgresql").glob("*/bin/initdb")]
    return max(found, key=lambda path: int(path.parent.name)) if found else None


def begin_with_own_mounts():
    """Begins the script again, as root, where what it mounts is seen by nobody else and goes with it. Returns whether it may mount."""
    if OWN_MOUNTS in os.environ:
        return True
    begin = ["unshare", "--mount", "--propagation", "private"]
    if os.getuid() != 0 or not shutil.which("unshare") or subprocess.run([*begin, "mount", "-t", "tmpfs", "none", "/mnt"], capture_output=True).returncode:
        return False
    os.execvpe(begin[0], [*begin, sys.executable, *sys.argv], os.environ | {OWN_MOUNTS: "1"})


class Disk:
    """A disk of so many MB, mounted on a folder."""

    def __init__(self, folder, megabytes):
        self.folder, self.size = folder, megabytes << 20
        folder.mkdir()
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={self.size},mode=755", "none", folder], check=True)

    def resize(self, size):
        return subprocess.run(["mount", "-o", f"remount,size={size}", self.folder], capture_output=True).returncode == 0

    def used(self):
        found = os.statvfs(self.folder)
        return (found.f_blocks - found.f_bfree) * found.f_frsize

    def fill(self):
        """No byte is left, until free()."""
        until(lambda: self.resize(self.used()), f"{self.folder} is full")

    def free(self):
        self.resize(self.size)

    def __exit__(self, *_):
        subprocess.run(["umount", self.folder], check=True)


class Database:
    """Ends with the block `with` that it is used in. `megabytes`: its data and its log have a disk of this size each, which only root can have after
    begin_with_own_mounts()."""

    def __init__(self, megabytes=None):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="bahnwerk-postgres-"))
        self.disks = [Disk(self.folder / name, megabytes) for name in ("disk", "log-disk")] if megabytes else []
        self.data = self.folder / "disk/data" if self.disks else self.folder / "data"
        self.log = self.folder / "log-disk/log" if self.disks else None  # None: within the data
        self.settings = "-c fsync=off -c max_connections=100"
        self.url = f"postgresql://postgres@/bahnwerk?host={self.folder}"
        # The server refuses to be root's.
        user = pwd.getpwnam("nobody")
        self.user = {"user": user.pw_uid, "group": user.pw_gid, "extra_groups": []} if os.getuid() == 0 else {}
        if self.user:
            for path in (self.folder, *(disk.folder for disk in self.disks)):
                os.chown(path, user.pw_uid, user.pw_gid)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.kill()
        for disk in self.disks:
            disk.__exit__()
        shutil.rmtree(self.folder, ignore_errors=True)

    def run(self, program, *arguments):
        done = subprocess.run([programs() / program, *arguments], cwd=self.folder, capture_output=True, text=True, **self.user)
        if done.returncode:
            raise SystemExit(f"{program} failed: {done.stdout}{done.stderr}")
        return done.stdout

    def make(self):
        self.run("initdb", "-D", self.data, "-U", "postgres", "-A", "trust", "-E", "UTF8", "--locale=C.UTF-8", "--no-sync", "--no-instructions", *(["-X", self.log] if self.log else []))

    def copy(self, other):
        """Makes this one, which does not run, a standby of the other."""
        for folder in (self.data, self.log):
            shutil.rmtree(folder or self.data, ignore_errors=True)
        self.run("pg_basebackup", "-D", self.data, "-h", other.folder, "-U", "postgres", "-R", "-c", "fast", "--no-sync", *(["--waldir", self.log] if self.log else []))

    def follow_synchronously(self, other):
        """Makes this one a standby of the other and starts it: from now on each commit of the other one waits for it."""
        self.copy(other)
        self.start()
        other.ask("ALTER SYSTEM SET synchronous_standby_names = 'walreceiver'", "postgres")
        other.ask("SELECT pg_reload_conf()", "postgres")
        until(lambda: other.ask("SELECT count(*) FROM pg_stat_replication WHERE sync_state = 'sync'", "postgres") == "1", "the standby follows")

    def start(self):
        self.run("pg_ctl", "-D", self.data, "-w", "-t", "600", "-l", self.folder / "log", "-o",
                 f"-k {self.folder} -c listen_addresses= {self.settings}", "start")

    def stop(self, mode="fast"):
        self.run("pg_ctl", "-D", self.data, "-w", "-t", "600", "-m", mode, "stop")

    def promote(self):
        """Makes the standby a server that is written, and that waits for no other one."""
        self.run("pg_ctl", "-D", self.data, "-w", "-t", "600", "promote")

    def lives(self):
        """Whether it runs; False, too, where it has ended by itself."""
        return subprocess.run([programs() / "pg_ctl", "-D", self.data, "status"], capture_output=True, **self.user).returncode == 0

    def kill(self):
        """Ends it as it is, also where it stands still."""
        if self.lives():
            all = self.processes()
            self.signal(signal.SIGKILL)
            until(lambda: not any(pathlib.Path(f"/proc/{each}").exists() for each in all), "the server's processes are gone")
        (self.data / "postmaster.pid").unlink(missing_ok=True)

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
