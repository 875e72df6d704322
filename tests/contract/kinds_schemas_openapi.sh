#!/usr/bin/env bash
# What can be asked, machine-readable; and what an operator looks at.
source "$(dirname "$0")/lib.sh"
start_server
request GET /v1/kinds
expect_status 200
expect_json '.kinds | map(.name) | index("contour") != null'
for schema in $(field '.kinds[] | .schema, .result_schema') /v1/schemas/job; do
  request GET "$schema"
  expect_status 200
  expect_json '.["$schema"] != null and .type == "object"'
done
request GET /v1/schemas/nothing
expect_problem not-found 404
request GET /openapi.json
expect_status 200
expect_json '.openapi | startswith("3.1")'
# Every address of the document is served: none answers that there is nothing there.
for path in $(field '.paths | keys[]'); do
  request OPTIONS "$(sed 's/{[a-z]*}/x/g' <<<"$path")"
  expect_status 204
done
request GET /v1/kinds -H 'Accept: text/plain'
expect_problem not-acceptable 406

post "$examples/line.json"
await succeeded
request GET /metrics
expect_status 200
for metric in 'bahnwerk_http_requests_total{method="POST",route="/v1/jobs",status="202"} 1' 'bahnwerk_jobs{state="succeeded"} 1' \
  'bahnwerk_queue_length 0' 'bahnwerk_planning_seconds_count{kind="contour",state="succeeded"} 1'; do
  grep -qF "$metric" "$work/body" || fail "expected metric $metric"
done
grep -q '^bahnwerk_store_commit_seconds_count [1-9]' "$work/body" || fail "commits are measured"
grep -q 'bahnwerk_http_request_seconds_bucket{.*route="/v1/jobs/{id}"' "$work/body" || fail "latency is measured by route"
request GET /healthz
expect_status 200
request GET /readyz
expect_status 200
expect_json '.status == "ready"'
jq '.name = "<script>alert(1)</script>"' "$examples/line.json" >"$work/job.json"
post "$work/job.json"
request GET / -H 'Accept: text/html'
expect_status 200
grep -q "/jobs/$id" "$work/body" || fail "the page links the job"
grep -q '<script>alert' "$work/body" && fail "names are escaped"
request GET / -H 'Accept: application/json'
expect_problem not-acceptable 406
