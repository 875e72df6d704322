#!/usr/bin/env bash
# SIGTERM: running jobs may finish within the drain timeout, otherwise they go back to the queue without losing an attempt.
source "$(dirname "$0")/../contract/lib.sh"
start_server --workers 1 --drain-timeout 120
snake "${SEGMENTS:-1500}" >"$work/short.json"
post "$work/short.json"
await running
short=$id
post "$examples/line.json"
waiting=$id
stop_server TERM || fail "an orderly end exits 0"
jq -e 'select(.event == "drain_finished")' "$work/log" >/dev/null || fail "the log tells of the end"
[[ ! -s $work/store.db-wal ]] || fail "the store was not checkpointed"

start_server --workers 1 --drain-timeout 0.5
request GET "/v1/jobs/$short"
expect_json '.state == "succeeded" and .attempt == 1'
id=$waiting
await succeeded

# Planning it takes seconds. It is no longer, because a document whose check was stopped at POST is read by the worker, and a sanitizer's worker that
# reads text does not notice the end for as long as that takes.
snake 6000 >"$work/long.json"
post "$work/long.json"
await running
stop_server INT || fail "an orderly end exits 0"
start_server --workers 0
request GET "/v1/jobs/$id"
expect_json '.state == "queued" and .attempt == 0 and .started_at == null and .progress.fraction == 0'
stop_server || fail "orderly end"

# A second signal ends at once.
start_server --workers 1 --drain-timeout 600
await running
kill -TERM "$server_pid"
soon logged '.event == "drain_started"' || fail "no drain"
code=0
stop_server TERM || code=$?
expect_equal $code $((128 + 15)) "exit code after a second signal"

# An answer under way when the end is asked for is still given whole, if the drain timeout lasts.
start_server --workers 0
request POST "/v1/jobs/$id/cancel"
stop_server || fail "orderly end"
start_server --workers 1 --drain-timeout 300
post "$work/short.json"
await succeeded
request GET "/v1/jobs/$id/setpoints" -H 'Accept: text/csv'
cp "$work/body" "$work/whole.csv"
curl -sS --limit-rate 3M -H 'Accept: text/csv' "$url/v1/jobs/$id/setpoints" -o "$work/slow.csv" &
download=$!
soon test -s "$work/slow.csv" || fail "the download does not begin"
stop_server TERM || fail "orderly end"
wait "$download" || fail "the download broke off"
cmp "$work/whole.csv" "$work/slow.csv" || fail "the download is not whole"
