#!/usr/bin/env bash
# Another program in the store: a lock that it holds is waited for, a log that grew beside its reading shrinks again, a backup is whole.
source "$(dirname "$0")/lib.sh"
start_server --workers 0 --max-queued 100000
for _ in 1 2 3; do post "$examples/line.json"; done

# hold SQL: runs it in the store and keeps the transaction until $work/release appears.
hold() {
  rm -f "$work/held" "$work/release"
  python3 - "$work" "$1" <<'P' &
import os, sqlite3, sys, time
folder, sql = sys.argv[1:]
store = sqlite3.connect(folder + "/store.db", isolation_level=None, timeout=60)
for statement in sql.split(";"):
    store.execute(statement).fetchall()
open(folder + "/held", "w").close()
while not os.path.exists(folder + "/release"):
    time.sleep(0.01)
store.execute("ROLLBACK")
P
  holder=$!
  soon test -e "$work/held" || fail "the other program has no lock"
}
release() {
  : >"$work/release"
  wait $holder || fail "the other program"
}

hold "BEGIN IMMEDIATE"
post "$examples/line.json" &
posting=$!
for _ in $(seq 20); do
  request GET "/v1/jobs/$id"
  expect_status 200
done
kill -0 $posting || fail "the post does not wait for the lock"
release
wait $posting || fail "the post that waited"
post "$examples/line.json"
expect_status 202
request GET /v1/jobs
expect_json '.jobs | length == 5'

# The log cannot be emptied beside a reader.
jq -c '.spec.contour = {points: [range(20000) | [(. * 7919 % 9973) / 10, (. * 104729 % 9901) / 10]]}' "$examples/line.json" >"$work/points.json"
hold "BEGIN; SELECT count(*) FROM jobs"
log_size() { stat -c %s "$work/store.db-wal"; }
for _ in $(seq 3000); do
  post "$work/points.json"
  expect_status 202
  (($(log_size) < 24 << 20)) || break
done
(($(log_size) >= 24 << 20)) || fail "the log does not grow; this tests nothing"
release
shrunk() {
  for _ in $(seq 50); do post "$examples/line.json"; done
  (($(log_size) <= 9 << 20))
}
soon shrunk || fail "the log has $(log_size) bytes"

# A backup beside posts has every job that was acknowledged before.
request GET /metrics
jobs=$(sed -n 's/^bahnwerk_jobs{state="queued"} //p' "$work/body")
while [[ ! -e $work/stop ]]; do
  curl -fsS -o /dev/null "$url/v1/jobs" -H 'Content-Type: application/json' --data-binary "@$examples/line.json" || break
done &
poster=$!
"$bahnwerk" backup "$work/copy.db" --store "sqlite:$work/store.db" >"$work/body" || fail "backup"
: >"$work/stop"
wait $poster
expect_json '.jobs >= $n' --argjson n "$jobs"
expect_equal "$(stat -c %a "$work/copy.db")" 600
expect_equal "$(find "$work" -name 'copy.db?*')" "" "beside the copy"
"$bahnwerk" check --store "sqlite:$work/store.db" >"$work/body" || fail "check while the service runs"
"$bahnwerk" check --store "sqlite:$work/copy.db" >"$work/body" || fail "check of the copy"
expect_json '.whole and .faults == []'
python3 -c 'import sqlite3, sys; s = sqlite3.connect(sys.argv[1]); s.execute("DELETE FROM specs WHERE seq = 2"); s.commit()' "$work/copy.db"
code=0
"$bahnwerk" check --store "sqlite:$work/copy.db" >"$work/body" || code=$?
expect_equal $code 1
expect_json '.whole == false and (.faults | length) == 1'
dd if=/dev/urandom of="$work/copy.db" bs=4096 seek=40 count=200 conv=notrunc 2>/dev/null
code=0
"$bahnwerk" check --store "sqlite:$work/copy.db" >"$work/body" 2>&1 || code=$?
((code == 1 || code == 2)) || fail "damage is found"
for arguments in "backup $work/x.db --store sqlite:$work/none.db" "check --store sqlite:$work/none.db" "backup /proc/x.db --store sqlite:$work/store.db" \
  "backup $work/store.db --store sqlite:$work/store.db"; do
  code=0
  "$bahnwerk" $arguments >/dev/null 2>"$work/err" || code=$?
  expect_equal $code 2 "for $arguments"
done
[[ ! -e $work/none.db ]] || fail "a store was made"

# Whatever name it is opened by, one process owns a store, and only its owner reads it.
expect_equal "$(stat -c %a "$work/store.db" "$work/store.db-wal" "$work/store.db.lock" | sort -u)" 600
ln -s store.db "$work/link.db"
ln "$work/store.db" "$work/hard.db"
for name in link hard; do
  code=0
  "$bahnwerk" serve --listen 127.0.0.1:0 --store "sqlite:$work/$name.db" 2>"$work/err" || code=$?
  expect_equal $code 2 "$name"
  grep -q 'another bahnwerk' "$work/err" || fail "says who has it: $(cat "$work/err")"
done
