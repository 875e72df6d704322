#!/usr/bin/env bash
# Cancelling and deleting.
source "$(dirname "$0")/lib.sh"
start_server --workers 1
post "$examples/line.json"
await succeeded
request POST "/v1/jobs/$id/cancel"
expect_status 202
expect_json '.state == "succeeded" and .error == null'
request DELETE "/v1/jobs/$id"
expect_status 204
expect_equal "$(wc -c <"$work/body")" 0
for path in "" /result /setpoints; do
  request GET "/v1/jobs/$id$path"
  expect_problem not-found 404
done
request DELETE "/v1/jobs/$id"
expect_problem not-found 404
request POST "/v1/jobs/$id/cancel"
expect_problem not-found 404

snake 20000 >"$work/long.json"
post "$work/long.json"
await running
long=$id
request DELETE "/v1/jobs/$long"
expect_problem job-not-finished 409
post "$examples/line.json"
request DELETE "/v1/jobs/$id" # still queued
expect_status 204
request POST "/v1/jobs/$long/cancel"
expect_status 202
id=$long
await cancelled
request DELETE "/v1/jobs/$long"
expect_status 204
request GET /v1/jobs
expect_json '.jobs == []'
