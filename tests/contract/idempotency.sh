#!/usr/bin/env bash
# Idempotency-Key: one key, one body, one job; over restarts too.
source "$(dirname "$0")/lib.sh"
start_server --workers 0

post "$examples/line.json" -H 'Idempotency-Key: order 17'
expect_status 202
first=$id
post "$examples/line.json" -H 'Idempotency-Key: order 17'
expect_status 202
expect_equal "$id" "$first"
expect_header Location "/v1/jobs/$first"
post "$examples/circle.json" -H 'Idempotency-Key: order 17'
expect_problem idempotency-conflict 409
post "$examples/line.json" -H 'Idempotency-Key: order 18'
expect_status 202
[[ $id != "$first" ]] || fail "another key is another job"
post "$examples/line.json"
[[ $id != "$first" ]] || fail "no key is another job"
request GET /v1/jobs
expect_json '.jobs | length == 3'

# Twenty at once with one key: one job.
for i in $(seq 20); do
  curl -sS -H 'Content-Type: application/json' -H 'Idempotency-Key: order 19' --data-binary "@$examples/line.json" \
    "$url/v1/jobs" -o "$work/answer.$i" &
  pids[i]=$!
done
for pid in "${pids[@]}"; do wait "$pid"; done
expect_equal "$(jq -r .id "$work"/answer.* | sort -u | wc -l)" 1 "jobs of twenty posts with one key"

stop_server KILL || true
start_server --workers 0
post "$examples/line.json" -H 'Idempotency-Key: order 17'
expect_status 202
expect_equal "$id" "$first" "after a restart"

# A deleted job frees its key.
request DELETE "/v1/jobs/$first"
expect_status 204
post "$examples/circle.json" -H 'Idempotency-Key: order 17'
expect_status 202
post "$examples/line.json" -H "Idempotency-Key: $(head -c 300 /dev/zero | tr '\0' k)"
expect_status 400
