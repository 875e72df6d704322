#!/usr/bin/env bash
# Before posting: a document is checked without a job; examples and machines can be fetched.
source "$(dirname "$0")/lib.sh"
mkdir "$work/machines"
jq '.axes.x.velocity = 7' "$examples/machines/mill.json" >"$work/machines/mill.json"
jq '.name = "no machine"' "$examples/line.json" >"$work/machines/broken.json"
cp "$examples/machines/laser.json" "$work/machines/laser 2.json"
start_server --machines "$work/machines"

check() { request POST /v1/check -H 'Content-Type: application/json' --data-binary "@$1"; }
logged '.event == "machine_left_out" and (.file | endswith("broken.json")) and (.detail | length > 0)' || fail "a bad file is said at the start"
request GET /v1/machines
expect_status 200
expect_json '[.machines[] | select(.own).name] == ["laser 2", "mill"]'
expect_json '.machines | map(.name) | contains(["robot", "vertical", "horizontal", "md1", "md2"]) and (index("broken") == null)'
request GET /v1/machines/mill
expect_json '.axes.x.velocity == 7'
known=$(header ETag)
request GET /v1/machines/mill -H "If-None-Match: $known"
expect_status 304
request GET '/v1/machines/laser%202'
expect_status 200
request GET /v1/machines/none
expect_problem not-found 404

# Every example passes the check, and can be posted as it is.
request GET /v1/examples
expect_status 200
expect_json '.examples | map(.kind) | unique == ["contour", "fill_factor", "motion_law", "probe_path", "winding"]'
for path in $(field '.examples[].document'); do
  request GET "$path"
  expect_status 200
  cp "$work/body" "$work/example.json"
  check "$work/example.json"
  expect_status 200
  expect_json '.checked and (.notes | type == "array") and (.outline == null or (.outline.vertices | length <= 5000))'
done
request GET /v1/examples/none
expect_problem not-found 404
request GET /v1/jobs
expect_json '.jobs == []'

# The same faults as a post, with the line of a program.
request GET /v1/examples/gear.ngc
jq '.spec.contour.gcode |= sub("G1"; "G1 Q1 A1")' "$work/body" >"$work/bad.json"
post "$work/bad.json"
expect_problem semantic-violation 422
jq 'del(.instance)' "$work/body" >"$work/posted"
check "$work/bad.json"
expect_problem semantic-violation 422
expect_equal "$(jq -c 'del(.instance)' "$work/body")" "$(jq -c . "$work/posted")"
expect_json '.errors[0] | .pointer == "/spec/contour/gcode" and .line > 0 and (.line as $line | .message | startswith("line \($line)"))'
gzip -c "$examples/line.json" >"$work/line.gz"
request POST /v1/check -H 'Content-Type: application/json' -H 'Content-Encoding: gzip' --data-binary "@$work/line.gz"
expect_status 200
expect_json '.outline.vertices == [[0, 0], [100, 0]] and .outline.cut == [0, 1]'
request POST /v1/check -H 'Content-Type: text/plain' --data-binary "@$examples/line.json"
expect_problem unsupported-media-type 415
request GET /v1/check
expect_problem method-not-allowed 405
stop_server
if "$bahnwerk" serve --listen 127.0.0.1:0 --store "sqlite:$work/other.db" --machines "$work/none" 2>"$work/log"; then fail "a missing folder is refused"; fi
grep -q "folder of machines" "$work/log" || fail "the message names the folder"
