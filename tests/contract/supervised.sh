#!/usr/bin/env bash
# The service says which build it is, and tells a service manager that speaks sd_notify when it is ready, that it lives, and that it ends.
source "$(dirname "$0")/lib.sh"
"$bahnwerk" --version >"$work/version"
read -r name version rest <"$work/version"
[[ $name == bahnwerk && $version =~ ^[0-9]+\.[0-9]+\.[0-9]+$ && $rest =~ ^\(commit\ ([0-9a-f]{7,40}(-dirty)?|unknown)\;\ [A-Za-z]+,\ (GNU|Clang)\ [0-9.]+,\ .*-ffp-contract=off.*\)$ ]] ||
  fail "version, commit and flags: $(cat "$work/version")"
commit=$(sed 's/.*(commit \([^;]*\);.*/\1/' "$work/version")

# Starts the service as systemd does, with a watchdog of 400 ms, prints what it is told, and ends it after three signs of life.
cat >"$work/manager.py" <<'P'
import os, socket, subprocess, sys
path, program, store = sys.argv[1:]
manager = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
manager.bind(path)
manager.settimeout(60)
environment = dict(os.environ, NOTIFY_SOCKET=path, WATCHDOG_USEC="400000")
environment.pop("WATCHDOG_PID", None)
with open(path + ".log", "w") as log:
    service = subprocess.Popen([program, "serve", "--listen", "127.0.0.1:0", "--store", store, "--drain-timeout", "3"], env=environment, stderr=log)
lives = 0
while True:
    message = manager.recv(4096).decode()
    print(message.replace("\n", " "), flush=True)
    lives += message == "WATCHDOG=1"
    if message == "WATCHDOG=1" and lives == 3:
        service.terminate()
    if message.startswith("STOPPING=1"):
        break
print("exit", service.wait(60))
P
python3 "$work/manager.py" "$work/notify" "$bahnwerk" "sqlite:$work/store.db" >"$work/told" || fail "a manager hears of the service: $(cat "$work/told")"
head -n 1 "$work/told" | grep -qE '^READY=1 STATUS=serving on 127\.0\.0\.1:[0-9]+$' || fail "ready first: $(cat "$work/told")"
(($(grep -c '^WATCHDOG=1$' "$work/told") >= 3)) || fail "signs of life"
grep -q '^STOPPING=1 STATUS=draining EXTEND_TIMEOUT_USEC=13000000$' "$work/told" || fail "the end and how long it takes: $(cat "$work/told")"
expect_equal "$(tail -n 1 "$work/told")" "exit 0"
jq -se --arg version "$version" --arg commit "$commit" '.[0] | .event == "starting" and .version == $version and .commit == $commit and (.build | contains("-ffp-contract=off"))' \
  "$work/notify.log" >/dev/null || fail "the log begins with the build"

start_server
request GET /healthz
expect_status 200
expect_json '.status == "alive" and .version == $version and .commit == $commit and (.build | contains("-ffp-contract=off"))' --arg version "$version" --arg commit "$commit"
