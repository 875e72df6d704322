#!/usr/bin/env bash
# ETag, If-None-Match, and `Prefer: wait`, which holds the answer until the job has ended, or with If-None-Match until it changes.
source "$(dirname "$0")/lib.sh"
start_server --workers 1

post "$examples/bracket.json"
await succeeded
request GET "/v1/jobs/$id"
etag=$(header ETag)
[[ $etag == \"*\" ]] || fail "the job has a strong ETag"
request GET "/v1/jobs/$id" -H "If-None-Match: $etag"
expect_status 304
expect_equal "$(wc -c <"$work/body")" 0
expect_header ETag "$etag"
request GET "/v1/jobs/$id" -H "If-None-Match: \"other\", W/$etag"
expect_status 304
request GET "/v1/jobs/$id" -H 'If-None-Match: "other"'
expect_status 200
for path in result setpoints; do
  request GET "/v1/jobs/$id/$path"
  tag=$(header ETag)
  request GET "/v1/jobs/$id/$path" -H "If-None-Match: $tag"
  expect_status 304
done
request GET "/v1/jobs/$id/setpoints" -H 'Accept: text/csv' -H "If-None-Match: $tag"
expect_status 200 # another form, another tag

# elapsed NS: ms since that moment. Only what has to take long is measured; what has to be quick is given a minute.
elapsed() { echo $((($(date +%s%N) - $1) / 1000000)); }
# A finished job does not change any more: no wait.
began=$(date +%s%N)
request GET "/v1/jobs/$id" -H "If-None-Match: $etag" -H 'Prefer: wait=60'
expect_status 304
(($(elapsed "$began") < 50000)) || fail "waited for a finished job"

# A queued job behind a long one: held for the whole time, then 304.
snake 50000 >"$work/long.json"
post "$work/long.json"
long=$id
await running
post "$examples/line.json"
short=$id
request GET "/v1/jobs/$short"
etag=$(header ETag)
began=$(date +%s%N)
request GET "/v1/jobs/$short" -H "If-None-Match: $etag" -H 'Prefer: respond-async, wait=2'
expect_status 304
expect_header Preference-Applied wait=2
took=$(elapsed "$began")
((took >= 1900)) || fail "held for $took ms instead of 2000"

# A running job's progress wakes the waiter, once a second at most, and every revision differs.
request GET "/v1/jobs/$long"
began=$(date +%s%N)
for _ in 1 2 3; do
  etag=$(header ETag)
  request GET "/v1/jobs/$long" -H "If-None-Match: $etag" -H 'Prefer: wait=30'
  expect_status 200
  [[ $(header ETag) != "$etag" ]] || fail "woken without a change"
  expect_json '.progress.fraction >= 0 and .progress.fraction <= 1 and (.progress.stage | length > 0)'
done
(($(elapsed "$began") >= 3000)) || fail "woken three times within $(elapsed "$began") ms"
# Without If-None-Match progress does not count: held for the whole time.
began=$(date +%s%N)
request GET "/v1/jobs/$long" -H 'Prefer: wait=2'
expect_status 200
expect_header Preference-Applied wait=2
(($(elapsed "$began") >= 1900)) || fail "progress ended the wait"

# Cancelling the queued job wakes who waits for it.
request GET "/v1/jobs/$short"
etag=$(header ETag)
(sleep 1 && curl -sS -X POST "$url/v1/jobs/$short/cancel" -o /dev/null) &
began=$(date +%s%N)
request GET "/v1/jobs/$short" -H "If-None-Match: $etag" -H 'Prefer: wait=60'
expect_status 200
expect_json '.state == "cancelled"'
(($(elapsed "$began") < 50000)) || fail "not woken by the change"
wait $!
# Waiters do not hold up the end of service, nor threads: 200 of them, and the server still answers.
request GET "/v1/jobs/$long"
for i in $(seq 200); do
  curl -sS --max-time 90 -H 'Prefer: wait=60' "$url/v1/jobs/$long" -o /dev/null &
  pids[i]=$!
done
request GET /readyz
expect_status 200
request POST "/v1/jobs/$long/cancel"
expect_status 202
for pid in "${pids[@]}"; do wait "$pid" || fail "a waiter was not answered"; done
