#!/usr/bin/env bash
# Layouts of a slot over HTTP: the same bits with one worker and with two, and as `bahnwerk plan` gives them; drawings; no
# setpoints; clear faults.
source "$(dirname "$0")/lib.sh"
jq '.spec.wires = [1.5, 1.6] | .spec.effort = 0.2 | .spec.robustness = {"samples": 1}' "$examples/stator_slot.json" >"$work/job.json"
jq '.spec.seed = 2 | .spec.wires = [1.4]' "$work/job.json" >"$work/other.json"

start_server --workers 1
post "$work/job.json"
expect_status 202
await succeeded 120
request GET "/v1/jobs/$id/result"
expect_status 200
expect_json '.verification.passed and .bound.count >= .summary.count and .kind == "fill_factor"'
expect_json '.details.layouts | length == 10 and all(.count == (.positions | length))'
expect_json '.details.drawings["potential.svg"] | startswith("<svg")'
jq -S . "$work/body" >"$work/one.json"
request GET "/v1/jobs/$id/setpoints"
expect_problem not-found 404
request GET "/v1/jobs/$id"
expect_json '.progress.fraction == 1'
stop_server

expect_same_bits_elsewhere "$work/job.json" "$work/other.json" "$work/one.json"
jq -S . "$work/offline/result.json" | cmp - "$work/one.json" || fail "result.json"
for name in orthocyclic_base orthocyclic_flank raabe potential needle fill_factors; do
  [[ $(head -c 4 "$work/offline/$name.svg") == '<svg' ]] || fail "$name.svg"
done

jq '.spec.slot.base_corner_radius = 3 ' "$work/job.json" >"$work/bad.json"
post "$work/bad.json"
expect_problem semantic-violation 422
expect_json '.errors[0].pointer == "/spec/slot/base_corner_radius"'
jq 'del(.spec.slot.height)' "$work/job.json" >"$work/bad.json"
post "$work/bad.json"
expect_problem schema-violation 422
expect_json '.errors[0].pointer == "/spec/slot/height"'

# What cannot end in its time is refused with numbers, what takes long has a note.
jq '.spec.robustness.samples = 1000 | .spec.effort = 10' "$work/job.json" >"$work/endless.json"
post "$work/endless.json"
expect_problem semantic-violation 422
expect_json '.errors[0].pointer == "/spec/robustness/samples" and (.detail | test("about [0-9.e+]+ s"))'
jq '.spec.wires = [0.6] | .spec.effort = 100 | del(.spec.robustness)' "$work/job.json" >"$work/long.json"
jq '.time_budget = 5' "$work/long.json" >"$work/endless.json"
post "$work/endless.json"
expect_problem semantic-violation 422
expect_json '.detail | test("time_budget")'

# A long search stops the first time that it reports after the order.
jq '.spec.wires = [0.6] | .spec.effort = 100 | del(.spec.robustness)' "$work/job.json" >"$work/long.json"
post "$work/long.json"
await running
request POST "/v1/jobs/$id/cancel"
expect_status 202
await cancelled 30
expect_stopped "$id"
