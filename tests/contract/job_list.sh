#!/usr/bin/env bash
# The list of jobs as a page uses it: tags, texts, order, counts, tags of answers, waiting for a change, places in the queue, and the events of all jobs in one stream.
source "$(dirname "$0")/lib.sh"
key() { "$bahnwerk" key "$@" --store "sqlite:$work/store.db" 2>>"$work/cli"; }
start_server --workers 0
ids=()
for i in $(seq 12); do
  jq -c ".name = \"part $i\" | .reference = \"WO-$((i % 3))\" | .tags = [\"all\", \"mod-$((i % 4))\"]" "$examples/line.json" >"$work/job.json"
  post "$work/job.json"
  expect_status 202
  expect_json '.tags == ["all", $t]' --arg t "mod-$((i % 4))"
  ids+=("$id")
done
post "$examples/line.json"
last=$id
names() { field '[.jobs[].name] | join(",")'; }

request GET '/v1/jobs?tag=mod-1'
expect_equal "$(names)" "part 9,part 5,part 1"
request GET '/v1/jobs?tag=mod-1&sort=oldest&limit=2'
expect_equal "$(names)" "part 1,part 5"
request GET "/v1/jobs?tag=mod-1&sort=oldest&limit=2&cursor=$(field .next)"
expect_equal "$(names)" "part 9"
expect_json '.next == null'
request GET '/v1/jobs?tag=all&reference=WO-0&limit=200'
expect_equal "$(names)" "part 12,part 9,part 6,part 3"
request GET '/v1/jobs?tag=mod'
expect_json '.jobs == []'
request GET '/v1/jobs?text=part%201'
expect_equal "$(names)" "part 12,part 11,part 10,part 1"
request GET '/v1/jobs?text=WO-2&sort=oldest'
expect_equal "$(names)" "part 2,part 5,part 8,part 11"
request GET "/v1/jobs?text=$last"
expect_json '[.jobs[].id] == [$id]' --arg id "$last"
for text in art PART 'part%201%25' 'part_1'; do
  request GET "/v1/jobs?text=$text"
  expect_json '.jobs == []'
done
request GET '/v1/jobs?sort=oldest&limit=1'
expect_json '.jobs[0].id == $id' --arg id "${ids[0]}"
for query in sort=name 'text=' 'tag='; do
  request GET "/v1/jobs?$query"
  expect_problem schema-violation 422
done

# Counts of all, whatever the page shows; places in the queue, at most a second old.
request GET '/v1/jobs?tag=mod-1'
expect_json '.counts == {queued: 13, running: 0, succeeded: 0, failed: 0, cancelled: 0}'
place() { request GET "/v1/jobs/$1" && jq -e ".queue == {ahead: $2}" "$work/body" >"$work/none"; }
soon place "$last" 12 || fail "the place in the queue"
soon place "${ids[3]}" 3 || fail "the place in the queue"
expect_json '.progress.remaining == null'

# A page has a tag, and an answer that waits comes when the page differs.
request GET '/v1/jobs?tag=mod-2'
tag=$(header ETag)
request GET '/v1/jobs?tag=mod-2' -H "If-None-Match: $tag"
expect_status 304
request GET '/v1/jobs?tag=mod-2' -H "If-None-Match: $tag" -H 'Prefer: wait=1'
expect_status 304
expect_header Preference-Applied wait=1
(sleep 0.3; curl -sS -o "$work/none" -X POST "$url/v1/jobs/${ids[1]}/cancel") &
request GET '/v1/jobs?tag=mod-2' -H "If-None-Match: $tag" -H 'Prefer: wait=60'
wait $!
expect_status 200
expect_json '.jobs[-1].state == "cancelled" and .jobs[-1].queue == null and .counts.cancelled == 1'

# Bulk calls take tags.
request POST '/v1/jobs/cancel?tag=mod-1'
expect_json '.count == 3'
request DELETE '/v1/jobs?tag=mod-1'
expect_json '.count == 3'
request GET '/v1/jobs?tag=mod-1'
expect_json '.jobs == [] and .counts.queued == 9'
stop_server

# Events of all jobs: each state, progress of those that run, removals; resumed by the last id.
start_server --workers 1 --event-heartbeat 1
curl -sSN --max-time 900 -o "$work/stream" "$url/v1/events" &
follower=$!
soon grep -q retry "$work/stream" || fail "the stream begins"
snake 3000 >"$work/long.json"
post "$work/long.json"
long=$id
await succeeded
request DELETE "/v1/jobs/$long"
removed() { grep -q '^event: removed' "$work/stream"; }
soon removed || fail "the removal is sent"
kill $follower
wait $follower 2>/dev/null || true
grep '^data: ' "$work/stream" | sed 's/^data: //' >"$work/data"
jq -es --arg id "$long" 'any(.[]; .id == $id and .state == "succeeded")' "$work/data" >"$work/none" || fail "the state is sent"
jq -es --arg id "$long" 'any(.[]; .id == $id and .fraction != null and .state == null)' "$work/data" >"$work/none" || fail "progress is sent"
last_id=$(sed -n 's/^id: //p' "$work/stream" | head -n 1)
curl -sSN --max-time 5 -o "$work/again" -H "Last-Event-ID: $last_id" "$url/v1/events?kind=contour" || true
grep -q '^event: removed' "$work/again" || fail "resumed"
curl -sSN --max-time 3 -o "$work/none" "$url/v1/events?kind=winding" || true
! grep -q '^event: state' "$work/none" || fail "another kind"
request GET '/v1/events?state=lost'
expect_problem schema-violation 422

# Each tenant has its own list, counts and events.
acme=$(key add acme --scope submit,read) other=$(key add other --scope submit,read) admin=$(key add boss --scope admin)
closed() { request GET /v1/jobs && [[ $status == 401 ]]; }
soon closed || fail "the keys take effect"
as() { local key=$1; shift; request "$@" -H "Authorization: Bearer $key"; }
jq -c '.name = "part of acme" | .tags = ["all"]' "$examples/line.json" >"$work/job.json"
post "$work/job.json" -H "Authorization: Bearer $acme" -H 'Prefer: wait=60'
expect_json '.state == "succeeded"'
mine=$id
for query in 'tag=all' 'text=part' 'state=succeeded' 'kind=contour' 'sort=oldest'; do
  as "$acme" GET "/v1/jobs?$query"
  expect_json '[.jobs[].id] == [$id] and .counts == {queued: 0, running: 0, succeeded: 1, failed: 0, cancelled: 0}' --arg id "$mine"
  as "$other" GET "/v1/jobs?$query"
  expect_json '.jobs == [] and .counts.succeeded == 0'
  as "$admin" GET "/v1/jobs?$query&limit=200"
  expect_json '(.jobs | length) > 1 and any(.jobs[]; .id == $id) and ([.jobs[].id] | . == sort or . == (sort | reverse))' --arg id "$mine"
done
curl -sSN --max-time 3 -o "$work/theirs" -H "Authorization: Bearer $other" -H 'Last-Event-ID: 0' "$url/v1/events" || true
! grep -q "$mine" "$work/theirs" || fail "events of another tenant"
curl -sSN --max-time 3 -o "$work/ours" -H "Authorization: Bearer $acme" -H 'Last-Event-ID: 0' "$url/v1/events" || true
grep -q "$mine" "$work/ours" || fail "a tenant's own events"
