#!/usr/bin/env bash
# A backup that is made while jobs are posted and planned has every job that was acknowledged before it began, and a service starts on it.
source "$(dirname "$0")/lib.sh"
start_server
for _ in $(seq 20); do
  post "$examples/line.json"
  echo "$id" >>"$work/acknowledged"
done
await succeeded
# Others post all the while.
while [[ ! -e $work/stop ]]; do
  curl -fsS -o /dev/null "$url/v1/jobs" -H 'Content-Type: application/json' --data-binary "@$examples/line.json" || break
done &
poster=$!
python3 - "$work" <<'P' || fail "the backups"
import sqlite3, sys
folder = sys.argv[1]
store = sqlite3.connect(folder + "/store.db")
store.backup(sqlite3.connect(folder + "/backup.db"))
store.execute("VACUUM INTO ?", (folder + "/vacuum.db",))
P
: >"$work/stop"
wait $poster
stop_server || fail "orderly end"
for copy in backup vacuum; do
  expect_equal "$(python3 -c 'import sqlite3, sys; print(sqlite3.connect(sys.argv[1]).execute("PRAGMA integrity_check").fetchone()[0])' "$work/$copy.db")" ok
  store=$work/$copy.db
  start_server
  while read -r id; do
    await succeeded
    request GET "/v1/jobs/$id/setpoints" -H 'Accept: text/csv'
    expect_equal "$(tail -n 1 "$work/body" | cut -d, -f1)" 100 "the last row of $id in $copy"
  done <"$work/acknowledged"
  stop_server || fail "orderly end"
done

# A store of a newer version is refused and stays as it is.
python3 -c 'import sqlite3, sys; sqlite3.connect(sys.argv[1]).execute("PRAGMA user_version = 1000")' "$work/backup.db"
before=$(sha256sum <"$work/backup.db")
code=0
"$bahnwerk" serve --listen 127.0.0.1:0 --store "sqlite:$work/backup.db" 2>"$work/err" || code=$?
expect_equal $code 2
grep -q 'it was written by a newer version' "$work/err" || fail "says why: $(cat "$work/err")"
expect_equal "$(sha256sum <"$work/backup.db")" "$before" "the refused store"
