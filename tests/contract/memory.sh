#!/usr/bin/env bash
# The limit of the process's memory, and what does not fit: a plan, the check of a document; long checks and plans; texts in pieces; 304 before anything is read.
source "$(dirname "$0")/lib.sh"

"$bahnwerk" serve --max-memory 64MiB --store "sqlite:$work/none.db" 2>"$work/refused" && fail "64 MiB are too little"
grep -q 'max-memory' "$work/refused" || fail "the refusal names the flag"

start_server --workers 2 --max-memory 256MiB
# The limit is the system's: of the data of the process.
expect_equal "$(awk '/^Max data size/ {print $5}' "/proc/$server_pid/limits")" $((256 << 20))
logged '.event == "starting" and .max_memory == 268435456' || fail "the log does not tell the limit"
resident() { awk '/^VmRSS/ {print int($2 / 1024)}' "/proc/$server_pid/status"; }

# arcs N: a program of 2 N half circles, in 150 bytes.
arcs() {
  jq -nc --arg n "$1" '{kind:"contour",spec:{contour:{gcode:
    ("G21 G90 F60000\nG1 X0 Y0\n#1=0\no1 repeat [" + $n + "]\nG2 X[#1+2] Y0 I1 J0\nG3 X[#1+4] Y0 I1 J0\n#1=[#1+4]\no1 endrepeat\nM2\n"),steps:10000000},
    machine:{kinematics:"cartesian",cycle_time:0.01,axes:{x:{velocity:1800,acceleration:16000,jerk:500000},y:{velocity:1800,acceleration:16000,jerk:500000}}},
    planning:{method:"time_optimal"}}}'
}
arcs 300000 >"$work/bomb.json"
bombs=()
for _ in 1 2; do
  post "$work/bomb.json"
  # Its check may end in time, too, and then without memory.
  case $status in
    202) bombs+=("$id") ;;
    422) expect_problem semantic-violation 422 ;;
    *) fail "a large document is accepted or refused with a sentence" ;;
  esac
done
# Small jobs beside them are taken, and none of them pays for its neighbours.
small=()
for _ in $(seq 5); do
  post "$examples/line.json"
  expect_status 202
  small+=("$id")
done
for id in "${small[@]}"; do await succeeded 300; done
for id in "${bombs[@]}"; do
  await failed 300
  expect_error budget-exhausted
done
request GET /readyz
expect_status 200
# Idle again: what was taken is given back.
small_again() { (($(resident) <= 80)); }
[[ -n ${SLOWER:-} ]] || soon small_again || fail "$(resident) MB are resident"
stop_server

# The time of a plan is limited, whatever the job says.
start_server --workers 1 --max-planning-time 1
snake 200000 '{"time_budget":3600}' >"$work/long.json"
post "$work/long.json"
expect_status 202
await failed
expect_error budget-exhausted
stop_server

# Texts of megabytes come in pieces with their length, and whether the client has one is decided by its tag.
start_server --workers 1
{
  head -c 3000000 /dev/zero | tr '\0' ' '
  cat "$examples/line.json"
} >"$work/blanks.json"
post "$work/blanks.json"
expect_status 202
await succeeded
request GET "/v1/jobs/$id/spec"
cmp "$work/blanks.json" "$work/body" || fail "the document is not what was posted"
expect_header Content-Length "$(wc -c <"$work/blanks.json")"
tag=$(header ETag)
[[ $tag == *"$("$bahnwerk" --version | cut -d' ' -f2)"* ]] || fail "the tag $tag does not name the version"
request GET "/v1/jobs/$id/spec" -H "If-None-Match: $tag"
expect_status 304
request HEAD "/v1/jobs/$id/spec"
expect_header Content-Length "$(wc -c <"$work/blanks.json")"
expect_equal "$(curl -sS --http1.0 "$url/v1/jobs/$id/spec" | wc -c)" "$(wc -c <"$work/blanks.json")"
gzip -c "$work/blanks.json" >"$work/blanks.gz"
request POST /v1/jobs -H 'Content-Type: application/json' -H 'Content-Encoding: gzip' --data-binary "@$work/blanks.gz"
expect_status 202
post "$examples/bracket.json"
await succeeded
request GET "/v1/jobs/$id/result"
cp "$work/body" "$work/result.json"
[[ $(header ETag) == *-1\" ]] || fail "the result's tag does not name the attempt"
request GET "/jobs/$id/drawings/contour.svg"
expect_status 200
expect_header Content-Type image/svg+xml
jq -j '.details.drawings["contour.svg"]' "$work/result.json" | cmp - "$work/body" || fail "the drawing is not that of the result"
tag=$(header ETag)
request GET "/jobs/$id/drawings/contour.svg" -H "If-None-Match: $tag"
expect_status 304
request GET "/jobs/$id/drawings/none.svg"
expect_status 404
