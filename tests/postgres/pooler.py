#!/usr/bin/env python3
"""Jobs through PgBouncer in transaction mode, whose pool is smaller than what its clients have connections.

    tests/postgres/pooler.py BINARY

One process that serves listens past the pooler, the other one asks for changes, and two plan. Exit 77: there is no server, or no pooler.
"""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "crash"))
from database import Database, programs, until  # noqa: E402
from faults import DOCUMENTS, Plant, expect, kills, launch, launch_refused, say, server_restarts, server_stands_still, shows_what_others_do  # noqa: E402
from service import Service  # noqa: E402


class Pooler:
    """PgBouncer before a database; ends with the block `with` that it is used in."""

    SIZE = 3

    def __init__(self, database):
        self.database = database
        self.folder = database.folder / "pooler"
        self.url = f"postgresql://postgres@/bahnwerk?host={self.folder}&port=6432"
        self.process = None

    def __enter__(self):
        self.folder.mkdir()
        settings = self.folder / "pgbouncer.ini"
        settings.write_text(f"[databases]\n* = host={self.database.folder} user=postgres\n[pgbouncer]\nlisten_addr =\nlisten_port = 6432\n"
                            f"unix_socket_dir = {self.folder}\nlogfile = {self.folder}/log\nauth_type = any\npool_mode = transaction\n"
                            f"default_pool_size = {self.SIZE}\nmax_client_conn = 500\nserver_login_retry = 1\n")
        user = self.database.user
        if user:
            for path in (self.folder, settings):
                os.chown(path, user["user"], user["group"])
        self.process = subprocess.Popen([shutil.which("pgbouncer", path="/usr/sbin:/usr/bin:/sbin:/bin"), "-q", settings], cwd=self.folder, **user)
        until(lambda: (self.folder / ".s.PGSQL.6432").exists(), "the pooler listens")
        return self

    def __exit__(self, *_):
        self.process.send_signal(signal.SIGINT)
        self.process.wait(600)


class PooledPlant(Plant):
    """All processes of the plant go through the pooler."""

    def __init__(self, binary, database, pooler):
        self.pooler = pooler
        through = ("--store-prepared", "off")
        super().__init__(binary, database, pooler.url, lambda number: through + (("--store-listen-url", database.url) if number in (0, 2) else ()))


def leaves_nothing_behind(plant):
    """No session of the server keeps what a process has set or prepared."""
    for _ in range(2 * Pooler.SIZE):
        for name, value in (("search_path", '"$user", public'), ("lock_timeout", "0"), ("statement_timeout", "0"), ("synchronous_commit", "on")):
            found = plant.database.run("psql", plant.pooler.url, "-XAtqc", f"SHOW {name}").strip()
            expect(found == value, f"{name} is {found}")
        expect(plant.database.run("psql", plant.pooler.url, "-XAtqc", "SELECT count(*) FROM pg_prepared_statements").strip() == "0", "a statement is prepared")
        expect(plant.database.run("psql", plant.pooler.url, "-XAtqc", "SELECT count(*) FROM pg_listening_channels()").strip() == "0", "somebody listens")
    through = plant.database.ask("SELECT count(*) FROM pg_stat_activity WHERE backend_type = 'client backend' AND application_name = 'bahnwerk' AND "
                                 "query NOT LIKE '%pg_notify%' AND query NOT LIKE '%LISTEN%'")
    expect(int(through) <= Pooler.SIZE, f"{through} sessions besides those for signals")


def signals_arrive(plant):
    """With the listener's server away from it alone, a process goes on."""
    service = Service(plant.binary, "--workers", "1", "--store-prepared", "off", "--store-listen-url", "postgresql://postgres@/none?host=/nowhere", url=plant.pooler.url)
    with service:
        expect(service.wait(service.post(DOCUMENTS[0]))["state"] == "succeeded", "a job without signals")
        expect("signals_away" in (service.folder / "log").read_text(), "the log says that signals are away")
        expect(json.loads(service.ask("GET", "/readyz")[2])["status"], "it is ready")


def refusals(plant):
    for url, why in ((plant.pooler.url.replace("/bahnwerk?", "/nowhere?"), "an unknown database"),
                     (plant.pooler.url + "&options=-cgeqo%3Doff", "a parameter that the pooler does not pass on")):
        refused = Service(plant.binary, "--role", "api", "--store-prepared", "off", url=url)
        launch_refused(refused, why)
        refused.__exit__()


def main():
    if not programs():
        print("its server is not installed")
        sys.exit(77)
    if not shutil.which("pgbouncer", path="/usr/sbin:/usr/bin:/sbin:/bin"):
        print("pgbouncer is not installed")
        sys.exit(77)
    with Database() as database:
        database.make()
        database.start()
        database.ask("CREATE DATABASE bahnwerk", "postgres")
        with Pooler(database) as pooler:
            plant = PooledPlant(sys.argv[1], database, pooler)
            try:
                for each in plant.all():
                    launch(each)
                plant.ready()
                plant.load(lambda: None)
                for fault in (refusals, shows_what_others_do, leaves_nothing_behind, signals_arrive, kills, server_restarts, server_stands_still, leaves_nothing_behind):
                    say(fault.__name__.replace("_", " "))
                    fault(plant)
                    plant.ready()
                    plant.whole()
                for each in plant.all():
                    expect(each.stop() == 0, "an orderly end")
            except BaseException:
                for each in plant.all():
                    print(each.folder, "".join(line for line in (each.folder / "log").read_text().splitlines(True) if '"info"' not in line)[-1500:])
                print((pooler.folder / "log").read_text()[-2000:])
                raise
            finally:
                for each in plant.all():
                    each.__exit__()
            say(f"{len(plant.posted)} jobs acknowledged, none lost")


if __name__ == "__main__":
    main()
