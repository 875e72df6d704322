#!/usr/bin/env bash
# A winding over HTTP: the same bits with one worker and with two, and as `bahnwerk plan` gives them; setpoints of the
# machine's axes; clear faults; named errors of planning.
source "$(dirname "$0")/lib.sh"
jq '.spec.coil.turns = 2 | .spec.feed.method = "optimised"' "$examples/rotor_coil.json" >"$work/job.json"
jq '.spec.coil.slots = [1, 0]' "$work/job.json" >"$work/other.json"

start_server --workers 1
post "$work/job.json"
expect_status 202
await succeeded 120
request GET "/v1/jobs/$id/result"
expect_status 200
expect_json '.verification.passed and .kind == "winding" and .summary.turns == 2 and .bound.duration <= .summary.duration'
expect_json '.details.support_points | length == 16'
expect_json '.details.path | (.knots | length) == (.points | length) + .degree + 1'
jq -S . "$work/body" >"$work/one.json"
count=$(field .setpoints.count)
request GET "/v1/jobs/$id/setpoints?columns=q1,q4,vq4,phi,brake" -H 'Accept: text/csv'
expect_status 200
expect_equal "$(head -n 1 "$work/body")" q1,q4,vq4,phi,brake
expect_equal "$(wc -l <"$work/body")" $((count + 1))
request GET "/v1/jobs/$id/setpoints?first=$((count - 1))&count=1" -H 'Accept: application/json'
expect_status 200
stop_server

expect_same_bits_elsewhere "$work/job.json" "$work/other.json" "$work/one.json"
expect_equal "$(wc -l <"$work/offline/setpoints.csv")" $((count + 1))

jq '.spec.part.slot.groove_radius = 0.1' "$work/job.json" >"$work/bad.json"
post "$work/bad.json"
expect_problem semantic-violation 422
expect_json '.errors[0].pointer == "/spec/part/slot/groove_radius"'
jq '.spec.path.objective = "minimum_time"' "$work/job.json" >"$work/bad.json"
post "$work/bad.json"
expect_problem schema-violation 422
expect_json '.errors[0].pointer == "/spec/path/objective" and (.errors[0].message | contains("not available"))'

# Where the machine does not reach: turn, region and pose.
jq '.spec.machine.axes.q3.range = [0, 50]' "$work/job.json" >"$work/short.json"
post "$work/short.json"
await failed 60
expect_error unreachable-pose
expect_json '.error.detail | contains("turn 1 of coil 1") and contains("phi")'

# A long plan is stopped within a second.
jq '.spec.coil.turns = null | .spec.coil.repeat = {"step": 1, "count": 6}' "$work/job.json" >"$work/long.json"
post "$work/long.json"
sleep 1
request POST "/v1/jobs/$id/cancel"
expect_status 202
await cancelled 3
