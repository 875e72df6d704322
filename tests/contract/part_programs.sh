#!/usr/bin/env bash
# Part programs and drawings over HTTP; corners rounded, jerk limited; faults that name their line.
source "$(dirname "$0")/lib.sh"
start_server
parts=$examples/parts

# A part program, put into the document of the machine that cuts it.
jq --rawfile text "$parts/bracket.ngc" '.spec.contour = {gcode: $text}' "$parts/laser.json" >"$work/job.json"
post "$work/job.json"
expect_status 202
await succeeded
request GET "/v1/jobs/$id/result"
expect_json '.verification.passed and .bound.gap >= 0 and .bound.gap < 1e-4'
expect_json '[.details.blocks[].mode] | unique == ["cut", "position"]'

# The drawing of a part, its cuts in another order: shorter between them, the same along them.
for order in as_drawn nearest; do
  jq --rawfile text "$parts/sheet.dxf" --arg order $order \
    '.spec.contour = {dxf: $text, feed: 100, order: $order} | .spec.machine.cycle_time = 0.01' "$parts/laser.json" >"$work/job.json"
  post "$work/job.json"
  await succeeded
  request GET "/v1/jobs/$id/result"
  field '[.details.blocks[] | select(.mode == "cut").length] | add * 1000 | round' >"$work/$order.cut"
  field '[.details.blocks[] | select(.mode == "position").length] | add | round' >"$work/$order.way"
done
expect_equal "$(cat "$work/nearest.cut")" "$(cat "$work/as_drawn.cut")" "length cut"
[[ $(cat "$work/nearest.way") -lt $(cat "$work/as_drawn.way") ]] || fail "the nearest order is no shorter"

# A program of short chords: at rest in each joint, and rounded within a tolerance; then with limited jerk.
jq --rawfile text "$parts/gear.ngc" '.spec.contour = {gcode: $text} | .spec.machine.axes[].jerk = 1e6' "$parts/laser.json" >"$work/gear.json"
plan() { # planning
  jq --argjson planning "$1" '.spec.planning = $planning' "$work/gear.json" >"$work/job.json"
  post "$work/job.json"
  await succeeded
  request GET "/v1/jobs/$id/result"
  expect_json '.verification.passed'
}
plan '{"method": "time_optimal", "corner": {"mode": "stop"}}'
expect_json '.details.notes | map(select(test("jerk"))) | length == 1'
field .summary.duration >"$work/stop"
plan '{"method": "time_optimal", "corner": {"mode": "blend", "tolerance": 0.02}}'
expect_json '.summary.duration < 0.75 * ($stop | tonumber)' --arg stop "$(cat "$work/stop")"
expect_json '.verification.checks[] | select(.name == "deviation from contour") | .unit == "mm" and .limit == 0.02 and .value > 0 and .value <= 0.02'
field .summary.duration >"$work/blend"
plan '{"method": "jerk_limited", "corner": {"mode": "blend", "tolerance": 0.02}}'
expect_json '.summary.duration > ($blend | tonumber)' --arg blend "$(cat "$work/blend")"
expect_json '[.verification.checks[].name] | contains(["jerk x", "jerk y", "continuity of acceleration", "deviation from contour"])'

# Every fault of a program is found, and names its line.
jq '.spec.contour = {gcode: "G1 X10\nG41 D1\nG1 X[3+4\nG2 X20 I0 J0\n"}' "$parts/laser.json" >"$work/job.json"
post "$work/job.json"
expect_problem semantic-violation 422
expect_json '[.errors[].pointer] | unique == ["/spec/contour/gcode"]'
expect_json '[.errors[].message[0:7]] == ["line 2:", "line 3:", "line 4:"]'
jq '.spec.contour = {dxf: "0\nSECTION\n2\nENTITIES\n0\nLINE\n10\nhere\n"}' "$parts/laser.json" >"$work/job.json"
post "$work/job.json"
expect_problem semantic-violation 422
expect_json '.errors[0].pointer == "/spec/contour/dxf" and (.errors[0].message | startswith("line 8: "))'

# What does not fit together.
jq '.spec.planning = {method: "jerk_limited"} | del(.spec.machine.axes[].jerk)' "$work/gear.json" >"$work/job.json"
post "$work/job.json"
expect_problem semantic-violation 422
expect_json '.errors[0].pointer == "/spec/machine/axes/x/jerk"'
jq '.spec.planning = {corner: {mode: "blend"}}' "$work/gear.json" >"$work/job.json"
post "$work/job.json"
expect_json '.errors[0].pointer == "/spec/planning/corner/tolerance"'
