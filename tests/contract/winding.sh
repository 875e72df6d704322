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
expect_json '.details.feed_fluctuation | .exact.largest <= 1e-6 and .quartic.mean < .taylor1.mean'
expect_json '.details.wire | .peak == 30 and .least == 30'
expect_json '.details.support_points | length == 16'
expect_json '.details.path | (.knots | length) == (.points | length) + .degree + 1'
jq -S . "$work/body" >"$work/one.json"
count=$(field .setpoints.count)
request GET "/v1/jobs/$id/setpoints?columns=q1,q4,vq4,phi,brake" -H 'Accept: text/csv'
expect_status 200
expect_equal "$(head -n 1 "$work/body")" q1,q4,vq4,phi,brake
expect_equal "$(wc -l <"$work/body")" $((count + 1))
# What a controller follows: axes, velocities and brake; the needle's pose, its rates and brake; nothing of it as JSON.
request GET "/v1/jobs/$id/setpoints?layout=twincat&count=3" -H 'Accept: text/csv'
expect_status 200
expect_equal "$(head -n 1 "$work/body")" $'q1;q2;q3;q4;q5;vq1;vq2;vq3;vq4;vq5;brake\r'
expect_equal "$(wc -l <"$work/body")" 4
"$bahnwerk" fetch "$id" --server "$url" --layout twincat_poses >"$work/poses.csv"
expect_equal "$(head -n 1 "$work/poses.csv")" $'x;y;z;phi;psi;vx;vy;vz;vphi;vpsi;brake;base_frame\r'
request GET "/v1/jobs/$id/setpoints?layout=twincat" -H 'Accept: application/json'
expect_problem schema-violation 422
expect_json '.errors[0].pointer == "/query/layout"'
request GET "/v1/jobs/$id/setpoints?first=$((count - 1))&count=1" -H 'Accept: application/json'
expect_status 200
request GET "/jobs/$id" -H 'Accept: text/html'
expect_status 200
for figure in 'wire length</th><td>[0-9.]* mm' 'resistance</th><td>[0-9.]* Ω' 'strokes per minute</th><td>[0-9.]* 1/min' 'clearance</th><td>[0-9.]* mm'; do
  grep -q -- "<th scope=\"row\">$figure</td>" "$work/body" || fail "the page lacks $figure"
done
# The path as a spline for CAD, a download of the job's page.
request GET "/jobs/$id/drawings/needle_path.dxf"
expect_status 200
expect_header Content-Type image/vnd.dxf
grep -q AcDbSpline "$work/body" || fail "no spline in the drawing"
request GET "/jobs/$id/drawings/needle_path.dxf" -H 'Accept: image/svg+xml'
expect_problem not-acceptable 406
request GET "/jobs/$id"
grep -q 'href="[^"]*needle_path.dxf"' "$work/body" || fail "the page names the spline"
! grep -q 'src="[^"]*dxf"' "$work/body" || fail "no browser shows it"
stop_server

expect_same_bits_elsewhere "$work/job.json" "$work/other.json" "$work/one.json"
expect_equal "$(wc -l <"$work/offline/setpoints.csv")" $((count + 1))

jq '.spec.part.slot.groove_radius = 0.1' "$work/job.json" >"$work/bad.json"
post "$work/bad.json"
expect_problem semantic-violation 422
expect_json '.errors[0].pointer == "/spec/part/slot/groove_radius"'
jq '.spec.path.objective = "least_length"' "$work/job.json" >"$work/bad.json"
post "$work/bad.json"
expect_problem schema-violation 422
expect_json '.errors[0].pointer == "/spec/path/objective"'

# Every way of choosing the feed; what cannot be held is named.
for method in natural constant critical_points; do
  jq --arg method "$method" '.spec.coil.turns = 1 | .spec.feed.method = $method' "$examples/rotor_coil.json" >"$work/feed.json"
  post "$work/feed.json"
  await succeeded 60
  request GET "/v1/jobs/$id/result"
  expect_json ".verification.passed and .details.feed == \"$method\" and .details.fastest > 0"
done
jq '.spec.coil.turns = 1 | .spec.feed = {"method": "constant", "velocity": 700}' "$examples/rotor_coil.json" >"$work/fast.json"
post "$work/fast.json"
await failed 60
expect_error infeasible
expect_json '.error.detail | contains("feed.velocity") and contains("largest constant feed")'

# Setpoints that scatter about the time law exceed the axes' limits, which is said by name.
jq '.spec.feed.interpolator = "taylor1"' "$work/job.json" >"$work/scatter.json"
post "$work/scatter.json"
await failed 120
expect_error verification-failed
expect_json '.error.detail | contains("setpoint jerk") and contains("turn 1 of coil 1")'
# What was planned can be had all the same, but nothing that a machine could follow.
request GET "/v1/jobs/$id/result"
expect_status 200
expect_json '.verification.passed == false and has("setpoints") == false and .summary.turns == 2'
expect_json '[.verification.checks[] | select(.passed | not) | has("place") and has("change")] | all'
request GET "/v1/jobs/$id/setpoints"
expect_problem no-result 409
if "$bahnwerk" plan "$work/scatter.json" --out "$work/scatter" >"$work/out"; then fail "a plan that is not verified"; fi
jq -e '.type == "/problems/verification-failed"' "$work/out" >/dev/null || fail "the problem is printed"
jq -e '.verification.passed == false' "$work/scatter/result.json" >/dev/null || fail "the result is written"
[ ! -e "$work/scatter/setpoints.csv" ] || fail "setpoints of a plan that is not verified"

# Where the machine does not reach: turn, region and pose.
jq '.spec.machine.axes.q3.range = [0, 50]' "$work/job.json" >"$work/short.json"
post "$work/short.json"
await failed 60
expect_error unreachable-pose
expect_json '.error.detail | contains("turn 1 of coil 1") and contains("phi")'

# A long plan stops the first time that it reports after the order.
jq '.spec.coil.turns = null | .spec.coil.repeat = {"step": 1, "count": 6}' "$work/job.json" >"$work/long.json"
post "$work/long.json"
await running
request POST "/v1/jobs/$id/cancel"
expect_status 202
await cancelled 30
expect_stopped "$id"
