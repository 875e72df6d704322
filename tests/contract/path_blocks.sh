#!/usr/bin/env bash
# Where a motion goes and what takes how long, without downloading its rows: compared with all rows by other code.
source "$(dirname "$0")/lib.sh"
start_server
ids=()
plan() {
  post "$1"
  expect_status 202
  await succeeded
  ids+=("$id")
}
program() { # PART [MACHINE]: as /v1/examples offers it
  request GET "/v1/examples/$1"
  cp "$work/body" "$work/job.json"
  plan "$work/job.json"
}
for file in line bracket helix polyline rotor_coil parts/fine_sheet; do plan "$examples/$file.json"; done
program gear.ngc
jq '.spec.planning.corner = {mode: "blend", tolerance: 0.05} | .spec.contour.gcode |= sub("M30"; "G4 P0.3\nM30")' "$work/job.json" >"$work/blended.json"
plan "$work/blended.json"
program lettering.dxf
python3 "$(dirname "$0")/path_blocks.py" "$url" "${ids[@]}"

id=${ids[6]} # gear.ngc
request GET "/v1/jobs/$id/blocks?by=line&sort=time&count=5"
expect_status 200
expect_json '.blocks | length == 5 and all(.[]; .line > 0 and (.text | type == "string" and length > 0) and .limit_share >= 0)'
line=$(field '.blocks[0].line') text=$(field '.blocks[0].text')
expect_equal "$text" "$(sed -n "${line}p" "$examples/parts/gear.ngc" | tr -d '\r')" "text of line $line"
known=$(header ETag)
request GET "/v1/jobs/$id/blocks?by=line&sort=time&count=5" -H "If-None-Match: $known"
expect_status 304
request GET "/v1/jobs/$id/path?points=100&columns=v,mode,block,line" -H 'Accept: application/octet-stream'
expect_status 200
expect_header X-Columns row,begin,x,y,v,mode,block,line
rows=$(wc -c <"$work/body")
[[ $((rows % 32)) == 0 && $rows -le 3200 && $rows -gt 64 ]] || fail "rows of eight numbers"
known=$(header ETag)
request GET "/v1/jobs/$id/path?points=100&columns=v,mode,block,line" -H 'Accept: application/octet-stream' -H "If-None-Match: $known"
expect_status 304
request GET "/v1/jobs/$id/path?points=100" -H "If-None-Match: $known"
expect_status 200
for query in 'points=1' 'points=x' 'tolerance=-1' 'tolerance=nan' 'points=5&tolerance=1' 'box=1,2,3' 'box=2,0,1,1' 'of=moon' 'columns=q' 'first=99999999' 'count=0' 'nothing=1'; do
  request GET "/v1/jobs/$id/path?$query"
  expect_problem schema-violation 422
done
for query in 'by=moon' 'sort=colour' 'first=-1' 'count=0' 'count=1001'; do
  request GET "/v1/jobs/$id/blocks?$query"
  expect_problem schema-violation 422
done
request GET "/v1/jobs/$id/path?of=coarse"
expect_problem not-found 404
request GET "/v1/jobs/$id/path" -H 'Accept: text/csv'
expect_problem not-acceptable 406
request GET "/v1/jobs/${ids[0]}/blocks?by=line"
expect_problem schema-violation 422
request GET "/v1/jobs/${ids[4]}/blocks" # a coil has none
expect_problem not-found 404
request GET "/v1/jobs/${ids[4]}/path?of=part&points=20"
expect_status 200
expect_json '.count <= 20 and (.columns | map(.name)) == ["row", "begin", "x", "y", "z"]'

# Members of a result alone.
request GET "/v1/jobs/$id/result"
jq -Sc '{bound, summary, details: {slowest: .details.slowest}}' "$work/body" >"$work/expected"
expect_json '.verification.checks | all(.[]; .group and .at_unit == "s")'
request GET "/v1/jobs/$id/result?parts=summary,bound,details.slowest,nothing"
expect_status 200
expect_equal "$(jq -Sc . "$work/body")" "$(cat "$work/expected")"
for query in 'parts=' 'parts=a..b' 'parts=%2Fa' 'other=1'; do
  request GET "/v1/jobs/$id/result?$query"
  expect_problem schema-violation 422
done

# Of jobs of older versions, which stored no views, blocks are made of document and rows at the first question: their times are right within a cycle.
answers=(${ids[1]}:block ${ids[1]}:segment "$id:block" "$id:line")
for each in "${answers[@]}"; do
  request GET "/v1/jobs/${each%:*}/blocks?by=${each#*:}&count=1000"
  expect_status 200
  cp "$work/body" "$work/$each.blocks"
done
stop_server TERM || fail "the server ends"
python3 -c 'import sqlite3, sys
store = sqlite3.connect(sys.argv[1])
store.execute("DELETE FROM views")
store.execute("UPDATE results SET views = 0")
store.commit()' "$work/store.db"
start_server
for each in "${answers[@]}"; do
  request GET "/v1/jobs/${each%:*}/result?parts=setpoints"
  cycle=$(field .setpoints.cycle_time)
  request GET "/v1/jobs/${each%:*}/blocks?by=${each#*:}&count=1000"
  expect_status 200
  jq -n --slurpfile new "$work/body" --slurpfile old "$work/$each.blocks" --argjson cycle "$cycle" '
    def near(a; b; by): (a - b) as $d | $d < by and -$d < by;
    $new[0] as $new | $old[0] as $old | $new.total == $old.total and near($new.time; $old.time; $cycle) and
    all(range($new.blocks | length); $new.blocks[.] as $a | $old.blocks[.] as $b |
      $a.text == $b.text and $a.mode == $b.mode and near($a.length; $b.length; 1e-3) and near($a.start_time; $b.start_time; 1.5 * $cycle) and
      near($a.end_time; $b.end_time; 1.5 * $cycle))' >"$work/same"
  expect_equal "$(cat "$work/same")" true "blocks of $each of a job that was stored without them"
done
