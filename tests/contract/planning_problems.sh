#!/usr/bin/env bash
# Why planning fails, in the job's `error`: cancelled, deadline-exceeded, budget-exhausted; and draining while a job still runs.
source "$(dirname "$0")/lib.sh"
start_server --workers 1 --drain-timeout 600

snake 20000 '{"time_budget":0.5}' >"$work/budget.json"
post "$work/budget.json"
expect_status 202
await failed
expect_error budget-exhausted
expect_json '.error.instance == "/v1/jobs/" + .id and .finished_at != null'
for part in result setpoints; do
  request GET "/v1/jobs/$id/$part"
  expect_problem no-result 409
  expect_json '.error.type == "/problems/budget-exhausted" and .error.instance == "/v1/jobs/" + $id' --arg id "$id"
done

deadline=$(date -u -d '+2 seconds' +%Y-%m-%dT%H:%M:%SZ)
snake 20000 "{\"deadline\":\"$deadline\"}" >"$work/deadline.json"
post "$work/deadline.json"
expect_status 202
await failed
expect_error deadline-exceeded

snake 20000 >"$work/long.json"
post "$work/long.json"
long=$id
await running
post "$examples/line.json"
queued=$id

# A deadline that passes in the queue ends the job there, though the only worker is busy.
deadline=$(date -u -d '+2 seconds' +%Y-%m-%dT%H:%M:%SZ)
jq --arg deadline "$deadline" '.deadline = $deadline' "$examples/line.json" >"$work/deadline.json"
post "$work/deadline.json"
expect_status 202
request GET "/v1/jobs/$id" -H 'Prefer: wait=60'
expect_error deadline-exceeded
expect_json '.state == "failed" and .attempt == 0 and .started_at == null'
id=$long
request GET "/v1/jobs/$id"
expect_json '.state == "running"'

# A queued job is cancelled at once, a running one when its planner reports the next time; asking again changes nothing.
request POST "/v1/jobs/$queued/cancel"
expect_status 202
expect_json '.state == "cancelled"'
expect_error cancelled
id=$long
request POST "/v1/jobs/$id/cancel"
expect_status 202
await cancelled 30
expect_error cancelled
expect_stopped "$id"
request GET "/v1/jobs/$id"
finished=$(field .finished_at)
request POST "/v1/jobs/$id/cancel"
expect_status 202
expect_json '.state == "cancelled" and .finished_at == $finished' --arg finished "$finished"

# While the server waits for a running job before it ends, it answers, but takes nothing new.
post "$work/long.json"
await running
busy=$id
kill -TERM "$server_pid"
not_ready() { request GET /readyz && [[ $status == 503 ]]; }
soon not_ready || fail "the server does not drain"
expect_problem draining 503
post "$examples/line.json"
expect_problem draining 503
[[ $(header Retry-After) =~ ^[0-9]+$ ]] || fail "draining says when to come again"
request GET /healthz
expect_status 200
request GET "/v1/jobs/$long" -H 'Prefer: wait=30'
expect_status 200
expect_equal "$(curl -sS --max-time 60 "$url/v1/jobs/$busy/events" | grep -c '^event: state')" 1 "events end with the service"
# It ends when the job does.
request POST "/v1/jobs/$busy/cancel"
expect_status 202
wait "$server_pid" || fail "an orderly end exits 0"
server_pid=
