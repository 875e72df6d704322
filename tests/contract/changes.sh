#!/usr/bin/env bash
# Knowing of all jobs without asking for each: the feed of changes as pages, as an answer that waits, and as a stream; and a post that waits for its job.
source "$(dirname "$0")/lib.sh"
start_server --workers 1 --event-heartbeat 1

request GET /v1/changes
expect_status 200
expect_json '.changes == [] and .gap == false and (.next | type == "number")'
start=$(field .next)

# A post that waits answers with the ended job, still 202.
post "$examples/line.json" -H "Prefer: wait=60"
expect_status 202
expect_header Preference-Applied "wait=60"
expect_json '.state == "succeeded"'
expect_header Location "/v1/jobs/$id"
first=$id
post "$examples/line.json" -H "Idempotency-Key: once" -H "Prefer: wait=60"
expect_json '.state == "succeeded"'
second=$id
post "$examples/line.json" -H "Idempotency-Key: once" -H "Prefer: wait=60"
expect_status 202
expect_equal "$id" "$second" "the same job"

# Each job once, with its last state, in the order of the last changes; `next` goes on from there.
request GET "/v1/changes?since=$start"
expect_json '[.changes[] | [.id, .state]] == [[$a, "succeeded"], [$b, "succeeded"]] and .next == .changes[-1].sequence' --arg a "$first" --arg b "$second"
expect_json '[.changes[].sequence] == ([.changes[].sequence] | sort | unique)'
next=$(field .next)
request GET "/v1/changes?since=$start&limit=1"
expect_json '[.changes[].id] == [$a]' --arg a "$first"
request GET "/v1/changes?since=$(field .next)&limit=1"
expect_json '[.changes[].id] == [$b]' --arg b "$second"
request GET "/v1/changes?since=$next"
expect_json '.changes == [] and .next == ($n | tonumber)' --arg n "$next"
request GET "/v1/changes?since=$next" -H "Prefer: wait=1"
expect_json '.changes == []'

# An answer that waits comes with the change. Of a number that this store has never given, only a comparison with the list can help.
(
  sleep 0.3
  curl -sS -X DELETE "$url/v1/jobs/$first"
) &
request GET "/v1/changes?since=$next" -H "Prefer: wait=60"
wait $!
expect_json '[.changes[] | [.id, .state]] == [[$a, "removed"]]' --arg a "$first"
next=$(field .next)
request GET "/v1/changes?since=900000000"
expect_json '.changes == [] and .gap == true and .next == ($n | tonumber)' --arg n "$next"
for wrong in since=-1 since=x since=1e3 limit=0 limit=5000 after=1; do
  request GET "/v1/changes?$wrong"
  expect_problem schema-violation 422
done
request GET /v1/changes -H "Accept: text/csv"
expect_problem not-acceptable 406

# The stream: every change as it happens, each with the number from which to resume.
curl -sSN --max-time 60 -o "$work/stream" -H "Accept: text/event-stream" "$url/v1/changes?since=$next" &
follower=$!
post "$examples/line.json" -H "Prefer: wait=60"
third=$id
tells() { grep '^data: ' "$work/stream" 2>/dev/null | sed 's/^data: //' | jq -se --arg id "$1" --arg state "$2" 'any(.[]; .id == $id and .state == $state)' >/dev/null; }
soon tells "$third" succeeded || fail "the stream does not tell of the end"
soon grep -qs '^: ' "$work/stream" || fail "no heartbeat"
kill "$follower"
wait "$follower" || true
last=$(sed -n 's/^id: //p' "$work/stream" | tail -n 1)
request DELETE "/v1/jobs/$third"
expect_status 204
curl -sSN --max-time 60 -o "$work/stream" -H "Accept: text/event-stream" -H "Last-Event-ID: $last" "$url/v1/changes" &
follower=$!
soon tells "$third" removed || fail "what happened in between is sent at once"
# Numbers go on after a restart, and the end of the service ends the stream.
stop_server
wait "$follower" || fail "the stream ends in order"
start_server --workers 0
request GET "/v1/changes?since=$last"
expect_json '[.changes[].id] == [$c]' --arg c "$third"
post "$examples/line.json"
request GET "/v1/changes?since=$(field .next 2>/dev/null || echo "$last")"
request GET "/v1/changes?since=$last"
expect_json '[.changes[].state] == ["removed", "queued"]'
