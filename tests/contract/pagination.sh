#!/usr/bin/env bash
# GET /v1/jobs: newest first, page by page, filtered.
source "$(dirname "$0")/lib.sh"
start_server --workers 0
for i in $(seq 25); do
  jq -c ".name = \"job $i\" | .reference = \"WO-$((i % 3))\"" "$examples/line.json" >"$work/job.json"
  post "$work/job.json"
  expect_status 202
  ids=("$id" "${ids[@]}")
done

collected=() cursor=
for _ in $(seq 10); do
  request GET "/v1/jobs?limit=7${cursor:+&cursor=$cursor}"
  expect_status 200
  expect_json '.jobs | length <= 7 and all(has("spec") | not)'
  mapfile -t -O ${#collected[@]} collected < <(field '.jobs[].id')
  cursor=$(field '.next // empty')
  [[ -z $cursor ]] && break
  # What is posted meanwhile does not move the pages.
  post "$examples/line.json"
done
expect_equal "${collected[*]}" "${ids[*]}" "all jobs, newest first"
expect_equal "${collected[*]}" "$(printf '%s\n' "${collected[@]}" | sort -r | tr '\n' ' ' | sed 's/ $//')" "ids in order"

request GET '/v1/jobs?reference=WO-1&limit=200'
expect_json '.jobs | length == 9 and all(.reference == "WO-1")'
request GET '/v1/jobs?state=succeeded'
expect_json '.jobs == [] and .next == null'
request GET '/v1/jobs?'
expect_json '.jobs | length == 28'
request GET '/v1/jobs?kind=contour&state=queued&limit=1'
expect_json '(.jobs | length == 1) and .next != null'
request GET '/v1/jobs?reference=caf%C3%A9+1'
expect_json '.jobs == []'
for query in limit=0 limit=201 limit=x state=lost cursor=zzz colour=red state= kind= reference= limit= cursor= limit 'limit=3&limit=3' 'state=queued&state=queued'; do
  request GET "/v1/jobs?$query"
  expect_problem schema-violation 422
  expect_json '.errors[0].pointer == "/query/" + $name' --arg name "${query%%=*}"
done
