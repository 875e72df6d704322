#!/usr/bin/env bash
# Following a job: events as they happen, waiting for the end with few and small answers.
source "$(dirname "$0")/lib.sh"
start_server --workers 1 --event-heartbeat 1
snake 50000 >"$work/long.json"
post "$work/long.json"
long=$id
await running

# stream FILE [curl's arguments…]: the events of job $id until their end.
stream() {
  local file=$1
  shift
  curl -sSN --max-time 90 -D "$file.headers" -o "$file" "$@" "$url/v1/jobs/$id/events"
}
names() { sed -n 's/^event: //p' "$1" | tr '\n' ' '; }
last_id() { sed -n 's/^id: //p' "$1" | tail -n 1; }
states() { sed -n 's/^data: //p' "$1" | jq -r '.state // empty' | tr '\n' ' '; }

# tells_progress FILE [N]: whether it holds so many events of progress.
tells_progress() { (($(cat "$1" 2>/dev/null | grep -c "^event: progress") >= ${2:-1})); }

# The state at once, then progress, at most once a second, without the connection's end.
began=$(date +%s)
curl -sSN --max-time 100 -o "$work/part" "$url/v1/jobs/$long/events" &
follower=$!
soon tells_progress "$work/part" 3 || fail "no progress"
kill "$follower"
wait "$follower" || true
[[ $(names "$work/part") == "state progress "* ]] || fail "first the state, then progress: $(names "$work/part")"
expect_equal "$(states "$work/part")" "running "
(($(grep -c '^event: progress' "$work/part") <= $(date +%s) - began + 1)) || fail "more than one progress a second"
sed -n 's/^data: //p' "$work/part" | tail -n 1 | jq -e '.fraction >= 0 and (.stage | length > 0)' >/dev/null || fail "progress carries its figures"

# A queued job's stream sees every state, also those that last a moment only; a heartbeat keeps it open meanwhile.
post "$examples/line.json"
stream "$work/short" &
follower=$!
soon grep -qs '^: ' "$work/short" || fail "no heartbeat"
expect_equal "$(states "$work/short")" "queued "
request POST "/v1/jobs/$long/cancel"
wait "$follower" || fail "the stream ends by itself"
expect_equal "$(states "$work/short")" "queued running succeeded "
grep -qi "^Content-Type: text/event-stream" "$work/short.headers" || fail "the media type"
ids=$(sed -n 's/^id: //p' "$work/short")
expect_equal "$ids" "$(sort -nu <<<"$ids")" "ids grow"

# Resumed where it broke off: what is later, once; after the last event there is nothing.
stream "$work/rest" -H "Last-Event-ID: $(head -n 1 <<<"$ids")"
expect_equal "$(states "$work/rest")" "running succeeded "
stream "$work/rest" -H "Last-Event-ID: $(sed -n 2p <<<"$ids")"
expect_equal "$(states "$work/rest")" "succeeded "
request GET "/v1/jobs/$id/events" -H "Last-Event-ID: $(last_id "$work/short")"
expect_status 204
stream "$work/rest" -H "Last-Event-ID: nonsense"
[[ $(states "$work/rest") == *"succeeded " ]] || fail "an unknown id starts anew"
request GET "/v1/jobs/$id/events" -H 'Accept: application/json'
expect_problem not-acceptable 406
request GET /v1/jobs/01890000-0000-7000-8000-000000000000/events
expect_problem not-found 404

# 200 streams at once take no threads; the server still answers, and ends them when it ends.
post "$work/long.json"
long=$id
await running
threads=$(ls "/proc/$server_pid/task" | wc -l)
for i in $(seq 200); do
  curl -sSN --max-time 120 "$url/v1/jobs/$long/events" -o "$work/many.$i" &
  pids[i]=$!
done
begun() { cat "$work"/many.* 2>/dev/null | grep -c '^event: state'; }
all_begun() { (($(begun) >= 200)); }
soon all_begun || fail "of 200 streams $(begun) have begun"
expect_equal "$(ls "/proc/$server_pid/task" | wc -l)" "$threads" "threads"
request GET /healthz
expect_status 200

# Waiting without If-None-Match: one answer, at the end, and a small one.
began=$SECONDS
request GET "/v1/jobs/$long" -H 'Prefer: wait=3'
((SECONDS - began >= 2)) || fail "progress ended the wait"
expect_json '.state == "running" and (has("spec") | not)'
(($(wc -c <"$work/body") < 1500)) || fail "the job resource has $(wc -c <"$work/body") bytes"
id=$long
(sleep 1 && curl -sS -X POST "$url/v1/jobs/$long/cancel" -o /dev/null) &
request GET "/v1/jobs/$long" -H 'Prefer: wait=60'
expect_json '.state == "cancelled"'
for pid in "${pids[@]}"; do wait "$pid" || fail "a stream broke off"; done
expect_equal "$(cat "$work"/many.* | grep -c '"state":"cancelled"')" 200 "every stream saw the end"

# The terminal client asks once a minute at most when nobody looks at its bar.
post "$work/long.json"
began=$SECONDS
(sleep 4 && curl -sS -X POST "$url/v1/jobs/$id/cancel" -o /dev/null) &
code=0
"$bahnwerk" watch "$id" --server "$url" >"$work/watched" || code=$?
expect_equal "$code" 1
# asked: how often job $id has been asked for.
asked() { jq -cR --arg path "/v1/jobs/$id" 'fromjson? | select(.event == "request" and .method == "GET" and .path == $path)' "$work/log" | wc -l; }
(($(asked) <= 2 + (SECONDS - began) / 60)) || fail "watch asked $(asked) times"

# With somebody looking, about once a second.
if ! script -qec true /dev/null >/dev/null 2>&1; then
  echo "no pseudo-terminals here: the progress bar is not tested"
  exit 0
fi
post "$work/long.json"
began=$SECONDS
asked_often() { (($(asked) >= 4)); }
(soon asked_often; curl -sS -X POST "$url/v1/jobs/$id/cancel" -o /dev/null) &
script -qec "'$bahnwerk' watch $id --server $url" /dev/null >"$work/watched" 2>&1 || true
grep -q '\[#* *\] *[0-9]* %' "$work/watched" || fail "a bar on a terminal"
(($(asked) >= 4)) || fail "watch asked $(asked) times"
# The first two answers come at once: the job's, and that it runs.
(($(asked) <= SECONDS - began + 4)) || fail "watch asked $(asked) times within $((SECONDS - began)) s"
