#!/usr/bin/env bash
# A probe path over HTTP, as a user goes: post, wait, look at figures and drawings, fetch rows in every format; the same bits
# with one worker and with two, and as `bahnwerk plan` gives them; clear faults.
source "$(dirname "$0")/lib.sh"
cat >"$work/job.json" <<'JSON'
{"kind": "probe_path", "name": "four edges", "spec": {
  "points": [[0, 0, 0], [12, 0, 2], [12, 0, 2], [20, 9, 2], [11, 16, 5]], "tolerance": 0.3, "speed": 20,
  "limits": {"x": {"acceleration": 250, "jerk": 5000, "snap": 250000}, "y": {"acceleration": 250, "jerk": 5000, "snap": 250000},
             "z": {"acceleration": 120, "jerk": 2500, "snap": 120000}},
  "method": "arcs", "cycle_time": 0.002}}
JSON
jq '.spec.method = "spline"' "$work/job.json" >"$work/other.json"

start_server --workers 1
post "$work/job.json"
expect_status 202
await succeeded 60
request GET "/v1/jobs/$id/result"
expect_status 200
expect_json '.kind == "probe_path" and .verification.passed'
expect_json '.bound.duration > 0 and .bound.duration <= .summary.duration * 1.000000001'
expect_json '[.verification.checks[].name] | contains(["speed", "deviation", "points", "snap z", "continuity of jerk", "setpoints jerk"])'
expect_json '.details.points | length == 5 and .[1].time == .[2].time and all(.distance <= 1e-6)'
expect_json '.summary.max_deviation <= 0.3 and .summary.duration < .details.stops_duration'
expect_json '.details.drawings["path.svg"] | startswith("<svg")'
jq -S . "$work/body" >"$work/one.json"
rows=$(field .setpoints.count)
request GET "/v1/jobs/$id/setpoints" -H 'Accept: text/csv'
expect_status 200
[[ $(head -n 1 "$work/body") == x,y,z,vx,vy,vz,ax,ay,az,jx,jy,jz,deviation,v ]] || fail "columns"
[[ $(wc -l <"$work/body") == $((rows + 1)) ]] || fail "rows"
[[ $(tail -n 1 "$work/body") == 11,16,5,0,0,0,0,0,0,0,0,0,0,0 ]] || fail "the last row is the last point at rest"
request GET "/v1/jobs/$id/setpoints?columns=deviation,v&first=$((rows - 2))" -H 'Accept: text/csv'
[[ $(wc -l <"$work/body") == 3 && $(head -n 1 "$work/body") == deviation,v ]] || fail "two columns of the last two rows"
stop_server

expect_same_bits_elsewhere "$work/job.json" "$work/other.json" "$work/one.json"
for name in path motion; do
  [[ $(head -c 4 "$work/offline/$name.svg") == '<svg' ]] || fail "$name.svg"
done

jq '.spec.points[2] = [12, 0]' "$work/job.json" >"$work/bad.json"
post "$work/bad.json"
expect_problem semantic-violation 422
expect_json '.errors[0].pointer == "/spec/points/2"'
jq 'del(.spec.limits.z.snap)' "$work/job.json" >"$work/bad.json"
post "$work/bad.json"
expect_problem schema-violation 422
expect_json '.errors[0].pointer == "/spec/limits/z/snap"'
