#!/usr/bin/env bash
# kill -9 while a job runs: after the start it runs again and succeeds. A job that loses its process three times while it runs alone is given up.
source "$(dirname "$0")/../contract/lib.sh"
start_server --workers 1
snake "${SEGMENTS:-4000}" >"$work/job.json"
post "$work/job.json"
expect_status 202
running=$id
post "$examples/line.json"
queued=$id
id=$running
await running
stop_server KILL && fail "killed, and yet it ended well"

start_server --workers 1
request GET "/v1/jobs/$running"
expect_status 200
await succeeded 600
expect_json '.attempt == 2'
request GET "/v1/jobs/$running/result"
expect_json '.verification.passed and .setpoints.count > 0'
rows=$(field .setpoints.count)
request GET "/v1/jobs/$running/setpoints" -H 'Accept: text/csv'
expect_equal "$(wc -l <"$work/body")" $((rows + 1)) "rows"
id=$queued
await succeeded
expect_json '.attempt == 1'

# Two jobs that run together are suspects after the kill: they run one after the other, and neither is blamed for it.
stop_server || fail "orderly end"
start_server --workers 2
together=()
for _ in 1 2; do
  post "$work/job.json"
  together+=("$id")
done
for id in "${together[@]}"; do await running; done
stop_server KILL || true
start_server --workers 2
id=${together[0]}
await running
request GET "/v1/jobs/${together[1]}"
expect_json '.state == "queued" and .attempt == 1'
for id in "${together[@]}"; do
  await succeeded 600
  expect_json '.attempt == 2'
done
stop_server || fail "orderly end"
start_server --workers 1

# Three times, alone.
snake 20000 >"$work/long.json"
post "$work/long.json"
long=$id
for _ in 1 2 3; do
  id=$long
  await running
  stop_server KILL || true
  start_server --workers 1
done
request GET "/v1/jobs/$long"
expect_json '.state == "failed" and .attempt == 3 and .finished_at != null'
expect_error worker-lost

# A cancellation that was promised holds over a kill.
post "$work/long.json"
await running
request POST "/v1/jobs/$id/cancel"
expect_status 202
stop_server KILL || true
start_server --workers 1
request GET "/v1/jobs/$id"
expect_json '.state == "cancelled"'
