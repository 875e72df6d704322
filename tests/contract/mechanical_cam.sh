#!/usr/bin/env bash
# A mechanical cam over HTTP: its figures, its drawings and DXF, its profile posted again as a contour; a load; clear refusals.
source "$(dirname "$0")/lib.sh"
start_server --workers 1
for name in radial_cam flat_cam; do
  post "$examples/$name.json"
  expect_status 202
  await succeeded 60
  request GET "/v1/jobs/$id/result"
  expect_status 200
  expect_json '.verification.passed and .details.cam.undercut == false'
  expect_json '.verification.checks | map(.name) | index("cam contact") and index("cam penetration") and index("cam undercut")'
  expect_json '(.details.drawings["cam.svg"] | startswith("<svg")) and (.details.drawings["cam.dxf"] | contains("SPLINE"))'
  jq .details.cam.contour "$work/body" >"$work/contour.json"
  post "$work/contour.json"
  expect_status 202
  await succeeded 60
  request GET "/v1/jobs/$id/result"
  expect_json '.verification.passed and .kind == "contour" and .summary.path_length > 200'
done

jq '.spec.cam.base_radius = 5 | .spec.cam.profile_radius = 0' "$examples/flat_cam.json" >"$work/undercut.json"
post "$work/undercut.json"
expect_status 202
await failed 60
request GET "/v1/jobs/$id"
expect_json '.error.type | endswith("infeasible")'
expect_json '.error.errors[0].pointer == "/spec/cam/base_radius" and (.error.errors[0].message | contains("undercut at"))'

jq '.spec.cam.arm = 50' "$examples/radial_cam.json" >"$work/bad.json"
post "$work/bad.json"
expect_problem semantic-violation 422
expect_json '.errors[0].pointer == "/spec/cam/arm"'

post "$examples/swivel_table.json"
expect_status 202
await succeeded 60
request GET "/v1/jobs/$id/result"
expect_json '.verification.passed and .summary.peak_load <= 12.0001 and .details.load.unit == "N m"'
expect_json '.details.drawings["load.svg"] | startswith("<svg")'
stop_server

"$bahnwerk" plan "$examples/radial_cam.json" --out "$work/cam" >/dev/null
[[ -s "$work/cam/cam.dxf" && $(head -c 4 "$work/cam/cam.svg") == '<svg' ]] || fail "plan --out writes the cam's drawings"
"$bahnwerk" plan "$examples/radial_cam.json" >"$work/one.json"
"$bahnwerk" plan "$examples/radial_cam.json" >"$work/two.json"
cmp -s "$work/one.json" "$work/two.json" || fail "the same document has the same result"
