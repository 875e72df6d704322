#!/usr/bin/env bash
# The bodies of a scene are those that the rows of the motion keep clear of, by geometry of its own.
source "$(dirname "$0")/lib.sh"
start_server
plan() { # FILE KIND
  post "$1"
  expect_status 202
  await succeeded
  python3 "$(dirname "${BASH_SOURCE[0]}")/scene.py" "$url" "$2" "$id" || fail "the scene of $1"
}
for file in rotor_coil stator_coil; do plan "$examples/$file.json" winding; done
for file in probe_space probe_profile; do plan "$examples/$file.json" probe_path; done
jq -n '{kind: "contour", spec: {contour: {start: [0, 0, 0], blocks: [{mode: "cut", segments: [{line: [20, 0, 2]}, {line: [20, 15, 4]}, {line: [0, 15, 0]}]}]},
  machine: {kinematics: "coarse_fine",
    coarse: {x: {velocity: 500, acceleration: 3000}, y: {velocity: 500, acceleration: 3000}, z: {velocity: 500, acceleration: 3000}},
    fine: {x: {velocity: 900, acceleration: 12000, stroke: 3}, y: {velocity: 900, acceleration: 12000, stroke: 3}},
    redundancy: {method: "iterative"}}}}' >"$work/space.json"
plan "$work/space.json" contour

request GET "/v1/jobs/$id/scene"
expect_status 200
known=$(header ETag)
request GET "/v1/jobs/$id/scene" -H "If-None-Match: $known"
expect_status 304
request GET "/v1/jobs/$id/scene?points=5"
expect_problem schema-violation 422
request GET "/v1/jobs/$id/path?columns=phi"
expect_problem schema-violation 422
request GET "/v1/jobs/$id/scene" -H 'Accept: text/csv'
expect_problem not-acceptable 406
request GET "/v1/jobs/00000000-0000-7000-8000-000000000000/scene"
expect_problem not-found 404
for file in line rotor_slot pick_and_place; do
  post "$examples/$file.json"
  await succeeded
  request GET "/v1/jobs/$id/scene"
  expect_problem not-found 404
done
stop_server TERM || fail "the server ends"
start_server --workers 0
post "$examples/rotor_coil.json"
request GET "/v1/jobs/$id/scene"
expect_problem job-not-finished 409
