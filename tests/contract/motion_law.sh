#!/usr/bin/env bash
# A motion law over HTTP: the same bits with one worker and with two, and as `bahnwerk plan` gives them; its table, cam tables in every
# layout of a controller, drawings, clear faults.
source "$(dirname "$0")/lib.sh"
cp "$examples/tolerance_boxes.json" "$work/job.json"
jq '.spec.points[1].position = 14' "$work/job.json" >"$work/other.json"

start_server --workers 1
post "$work/job.json"
expect_status 202
await succeeded 60
request GET "/v1/jobs/$id/result"
expect_status 200
expect_json '.verification.passed and .kind == "motion_law" and .bound.objective <= .summary.objective'
expect_json '(.details.sections | length) == 5 and .setpoints.count == 721'
expect_json '.details.drawings["law.svg"] | startswith("<svg")'
jq -S . "$work/body" >"$work/one.json"
request GET "/v1/jobs/$id/setpoints?first=120&count=1"
expect_status 200
expect_json '.columns | length == 5'
expect_json '.independent == {"name": "phi", "unit": "deg", "step": 0.5}'
request GET "/v1/jobs/$id/setpoints?layout=csv"
expect_status 200
[[ $(head -n 1 "$work/body") == phi,s,v,a,j && $(wc -l <"$work/body") == 722 ]] || fail "csv"
for layout in twincat_nc twincat_mc3 isg lcamhdl_xy lcamhdl_basic lcamhdl_advanced codesys_xyva codesys_xy; do
  request GET "/v1/jobs/$id/setpoints?layout=$layout"
  expect_status 200
  grep -qi '^x-refit-error: position .* jerk ' "$work/headers" || fail "$layout: X-Refit-Error"
  [[ $(wc -l <"$work/body") -gt 4 ]] || fail "$layout"
done
request GET "/jobs/$id" -H 'Accept: text/html'
expect_status 200
[[ $(grep -o 'setpoints?layout=[a-z0-9_]*' "$work/body" | sort -u | wc -l) == 8 ]] || fail "the page links a cam table per layout"
request GET "/v1/jobs/$id/setpoints?layout=twincat_nc&first=3"
expect_problem schema-violation 422
expect_json '.errors[0].pointer == "/query/layout"'
post "$examples/line.json"
await succeeded 60
request GET "/jobs/$id" -H 'Accept: text/html'
! grep -q 'layout=isg' "$work/body" || fail "a contour's page links no cam table"
request GET "/v1/jobs/$id/setpoints?layout=isg"
expect_problem schema-violation 422

# A law that moves on in each cycle: its derivatives close, its position does not.
for name in rotary_knife indexing_table; do
  post "$examples/$name.json"
  await succeeded 60
  travel=$(jq .spec.travel "$examples/$name.json")
  request GET "/v1/jobs/$id/result"
  expect_json ".verification.passed and .details.master.travel == $travel"
  request GET "/v1/jobs/$id/setpoints?layout=csv"
  awk -F, -v travel="$travel" 'NR == 2 { s = $2; v = $3 } END { exit !($2 - s - travel < 1e-9 && s + travel - $2 < 1e-9 && $3 == v) }' \
    "$work/body" || fail "$name: the last row is the first one, $travel farther"
  request GET "/v1/jobs/$id/setpoints?layout=codesys_xyva"
  grep -q "^  $name : MC_CAM_REF" "$work/body" || fail "$name: the table bears the job's name"
  grep -q "in each cycle the slave moves by $travel deg" "$work/body" || fail "$name: the table says the slave's period"
done
stop_server

expect_same_bits_elsewhere "$work/job.json" "$work/other.json" "$work/one.json"
for name in law spectrum; do
  [[ $(head -c 4 "$work/offline/$name.svg") == '<svg' ]] || fail "$name.svg"
done

# The command line knows the layouts, too.
code=0
"$bahnwerk" plan "$work/job.json" --out "$work/cam" --layout codesys_xyva >/dev/null 2>"$work/errors" || code=$?
[[ $code == 0 && $(grep -c 'dX :=' "$work/cam/codesys_xyva.st") -gt 4 && -s "$work/cam/setpoints.csv" ]] || fail "plan --layout codesys_xyva"
grep -q '^codesys_xyva.st differs from the law by position ' "$work/errors" || fail "plan --layout says what the layout loses"
code=0
"$bahnwerk" plan "$examples/line.json" --out "$work/line" --layout isg >"$work/body" 2>/dev/null || code=$?
[[ $code == 2 && ! -e "$work/line/result.json" ]] || fail "a contour has no cam table"
expect_json '.errors[0].pointer == "/query/layout"'

jq '.spec.points[1].position = {"min": 20, "max": 15}' "$work/job.json" >"$work/bad.json"
post "$work/bad.json"
expect_problem semantic-violation 422
expect_json '.errors[0].pointer == "/spec/points/1/position"'
jq '.spec.points[2].at = 60' "$work/job.json" >"$work/bad.json"
post "$work/bad.json"
expect_problem semantic-violation 422
expect_json '.errors[0].pointer == "/spec/points/2/at"'
