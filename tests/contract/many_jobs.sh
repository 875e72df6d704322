#!/usr/bin/env bash
# Acting on many jobs: planning once more, cancelling and removing all that match, lists by time, and retention.
source "$(dirname "$0")/lib.sh"
start_server --workers 0
named() { jq -c --arg r "$1" '. + {reference: $r}' "$examples/line.json" >"$work/$1.json"; }
named A
named B
for _ in 1 2 3; do post "$work/A.json"; done
post "$work/B.json"
b=$id

# Without a filter nothing is touched; a wrong one is named.
for call in "DELETE /v1/jobs" "POST /v1/jobs/cancel" "DELETE /v1/jobs?before=yesterday" "DELETE /v1/jobs?limit=3"; do
  request ${call% *} "${call#* }"
  expect_problem schema-violation 422
done
request POST "/v1/jobs/cancel?reference=A&before=2020-01-01T00:00:00Z"
expect_json '.count == 0'
request POST "/v1/jobs/cancel?reference=A"
expect_status 200
expect_json '.count == 3'
request POST "/v1/jobs/cancel?reference=A"
expect_json '.count == 0'
request GET "/v1/jobs?state=cancelled"
expect_json '[.jobs[].reference] == ["A", "A", "A"]'
a=$(field '.jobs[0].id')

# A cancelled job can be planned once more: another job with the same document. One key gives one job.
request POST "/v1/jobs/$b/retry"
expect_problem job-not-failed 409
request POST "/v1/jobs/00000000-0000-7000-8000-000000000000/retry"
expect_problem not-found 404
request POST "/v1/jobs/$a/retry" -H "Idempotency-Key: again"
expect_status 202
retried=$(field .id)
[[ $retried != "$a" ]] || fail "a new job"
expect_json '.state == "queued" and .reference == "A" and .attempt == 0'
expect_header Location "/v1/jobs/$retried"
request POST "/v1/jobs/$a/retry" -H "Idempotency-Key: again"
expect_equal "$(field .id)" "$retried"
cmp <(curl -sS "$url/v1/jobs/$a/spec") <(curl -sS "$url/v1/jobs/$retried/spec") || fail "the same document"
stop_server
start_server --workers 1
id=$retried
await succeeded
request POST "/v1/jobs/$retried/retry"
expect_problem job-not-failed 409

# Lists by time: from, and before.
now=$(date -u +%Y-%m-%dT%H:%M:%SZ -d '+1 hour')
request GET "/v1/jobs?created_before=$now"
expect_json '.jobs | length == 5'
request GET "/v1/jobs?created_after=$now"
expect_json '.jobs == []'
created=$(curl -sS "$url/v1/jobs/$retried" | jq -r .created_at)
request GET "/v1/jobs?created_after=$created"
expect_json '[.jobs[].id] == [$id]' --arg id "$retried"
request GET "/v1/jobs?created_before=$created"
expect_json '.jobs | length == 4'
request GET "/v1/jobs?created_after=now"
expect_problem schema-violation 422

request DELETE "/v1/jobs?state=cancelled"
expect_json '.count == 3'
request GET /v1/jobs
expect_json '[.jobs[].state] | sort == ["succeeded", "succeeded"]'

# Retention by number: the latest ended jobs stay.
stop_server
start_server --workers 1 --keep-jobs 1
left() { request GET /v1/jobs && [[ $(field '.jobs | length') == "$1" ]]; }
soon left 1 || fail "more jobs than --keep-jobs"
# By time, with a unit.
stop_server
start_server --workers 1 --keep-for 1s
soon left 0 || fail "a job is kept longer than --keep-for"
soon logged '.event == "jobs_removed"' || fail "the log does not say that jobs were removed"
for wrong in 0 -1s 5x nan 40000d; do
  code=0
  "$bahnwerk" serve --listen 127.0.0.1:0 --store "sqlite:$work/other.db" --keep-for "$wrong" 2>"$work/said" || code=$?
  expect_equal "$code" 2 "--keep-for $wrong"
done
