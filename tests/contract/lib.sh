# Helpers for the contract tests: start the real binary on a free port with a fresh store, ask it with curl, look at answers with jq.
# A test sources this file, then reads like a client's session. Usage of a test: SCRIPT [path of bahnwerk]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
bahnwerk=${1:-$root/build/release/bahnwerk}
examples=$root/examples
work=$(mktemp -d)
server_pid=
trap 'stop_server TERM >/dev/null 2>&1 || true; rm -rf "$work"' EXIT

fail() {
  echo "FAILED ($(caller 1 2>/dev/null || caller)): $*" >&2
  echo "--- last answer: ${status:-none}" >&2
  [[ -f $work/headers ]] && cat "$work/headers" >&2
  [[ -f $work/body ]] && head -c 2000 "$work/body" >&2
  echo "--- last lines of the server's log" >&2
  [[ -f $work/log ]] && tail -n 15 "$work/log" >&2
  exit 1
}

# start_server [flags of serve…]: sets $url; $listen is the address, a free port unless set. The store stays the same over restarts within a test. Planners have the priority of what else the machine
# runs: below it they might not get a turn for minutes.
start_server() {
  : >"$work/log"
  "$bahnwerk" serve --listen "${listen:-127.0.0.1:0}" --worker-nice 0 --store "${store_url:-sqlite:${store:-$work/store.db}}" "$@" 2>>"$work/log" &
  server_pid=$!
  for _ in $(seq 600); do
    address=$(jq -rR 'fromjson? | select(.event == "listening").address' "$work/log" 2>/dev/null || true)
    [[ -n $address ]] && break
    kill -0 "$server_pid" 2>/dev/null || fail "the server did not start"
    sleep 0.1
  done
  [[ -n $address ]] || fail "the server does not listen"
  url=http://$address host=${address%:*} port=${address##*:}
}

# stop_server [signal]: its exit code is the function's.
stop_server() {
  [[ -n $server_pid ]] || return 0
  local pid=$server_pid code=0
  server_pid=
  kill -"${1:-TERM}" "$pid" 2>/dev/null || true
  wait "$pid" 2>/dev/null || code=$?
  return $code
}

# request METHOD PATH [curl's arguments…]: sets $status; the body is in $work/body, the header in $work/headers.
request() {
  local method=$1 path=$2
  shift 2
  rm -f "$work/body" "$work/headers"
  local head=()
  [[ $method == HEAD ]] && head=(--head)
  status=$(curl -sS --max-time 600 -X "$method" "${head[@]}" -o "$work/body" -D "$work/headers" -w '%{http_code}' "$@" "$url$path") ||
    fail "curl $method $path"
  [[ -f $work/body ]] || : >"$work/body"
}
body() { cat "$work/body"; }
# field FILTER: what jq finds in the last body.
field() { jq -r "$1" "$work/body"; }
# header NAME: the value in the last answer.
header() { tr -d '\r' <"$work/headers" | sed -n "s/^$1: //Ip" | tail -n 1; }

expect_status() { [[ $status == "$1" ]] || fail "expected status $1"; }
# expect_json FILTER [arguments of jq…]: true for the last body.
expect_json() {
  local filter=$1
  shift
  jq -e "$@" "$filter" "$work/body" >/dev/null || fail "expected $filter"
}
expect_header() { [[ $(header "$1") == "$2" ]] || fail "expected header $1: $2"; }
expect_equal() { [[ $1 == "$2" ]] || fail "expected '$2', got '$1' ${3:-}"; }
# expect_problem SLUG STATUS: the last answer is this problem, complete as RFC 9457 and this service promise.
expect_problem() {
  expect_status "$2"
  [[ $(header Content-Type) == application/problem+json ]] || fail "expected application/problem+json"
  [[ -n $(header X-Request-Id) ]] || fail "expected X-Request-Id"
  expect_json '.type == "/problems/" + $slug and .status == ($status | tonumber) and (.title | length > 0)
    and (.detail | length > 0) and (.instance | startswith("/"))' --arg slug "$1" --arg status "$2"
}
# expect_error SLUG: the job in the last answer failed or was cancelled for this reason.
expect_error() { expect_json '.error.type == "/problems/" + $slug and (.error.detail | length > 0)' --arg slug "$1"; }

# soon COMMAND…: holds until the command succeeds; false when it has not within 60 s, times $SLOWER.
soon() {
  local until=$((SECONDS + 60 * ${SLOWER:-1}))
  until "$@"; do
    ((SECONDS < until)) || return 1
    sleep 0.1
  done
}
# logged FILTER [arguments of jq…]: whether some line of the server's log passes.
logged() {
  local filter=$1
  shift
  [[ -n $(jq -cR "$@" "fromjson? | select($filter)" "$work/log") ]]
}
# expect_stopped ID: the planner of this job was told to stop, and that was the last time that it reported.
expect_stopped() {
  soon logged '.event == "job_ended" and .job == $id' --arg id "$1" || fail "the log does not tell of the end of job $1"
  logged '.event == "job_ended" and .job == $id and .reports_after_stop == 0' --arg id "$1" ||
    fail "the planner of job $1 went on after it was told to stop"
}

# post FILE [curl's arguments…]: posts a job document, sets $id.
post() {
  local file=$1
  shift
  request POST /v1/jobs -H 'Content-Type: application/json' --data-binary "@$file" "$@"
  id=$(field '.id // empty' 2>/dev/null || true)
}
# await STATE [seconds, by default 120; times $SLOWER, a sanitizer's factor]: holds until job $id has this state; any other final state fails the test.
await() {
  local until=$((SECONDS + ${2:-120} * ${SLOWER:-1}))
  while ((SECONDS < until)); do
    request GET "/v1/jobs/$id"
    expect_status 200
    local now
    now=$(field .state)
    [[ $now == "$1" ]] && return
    case $now in succeeded | failed | cancelled) fail "expected $1, but the job $now" ;; esac
    sleep 0.1
  done
  fail "the job did not become $1"
}

# snake N [members of the job, JSON]: a contour of N half circles; about 1 s of planning per 1000.
snake() {
  awk -v n="$1" 'BEGIN {
    printf "{\"kind\":\"contour\",\"spec\":{\"contour\":{\"start\":[0,0],\"blocks\":[{\"mode\":\"cut\",\"segments\":["
    for (i = 1; i <= n; i++)
      printf "%s{\"arc\":{\"to\":[%d,0],\"center\":[%d,0],\"direction\":\"%s\"}}", (i > 1 ? "," : ""), 2*i, 2*i - 1, (i % 2 ? "cw" : "ccw")
    printf "]}]},\"machine\":{\"kinematics\":\"cartesian\",\"axes\":{\"x\":{\"velocity\":1800,\"acceleration\":16000},"
    printf "\"y\":{\"velocity\":1800,\"acceleration\":16000}},\"cycle_time\":0.001},\"planning\":{\"method\":\"time_optimal\"}}}"
  }' | jq -c --argjson more "${2:-"{}"}" '. + $more'
}

# expect_same_bits_elsewhere JOB OTHER RESULT: a server with two workers that plans OTHER beside it, and `bahnwerk plan`
# (into $work/offline), give the result of JOB that RESULT holds with sorted keys. The server stays.
expect_same_bits_elsewhere() {
  local first
  store=$work/two.db
  start_server --workers 2
  post "$1"
  first=$id
  post "$2"
  await succeeded 120
  id=$first
  await succeeded 120
  request GET "/v1/jobs/$id/result"
  jq -S . "$work/body" >"$work/two.json"
  cmp "$3" "$work/two.json" || fail "one worker and two give different results"
  "$bahnwerk" plan "$1" --out "$work/offline" | jq -S . >"$work/offline.json"
  cmp "$3" "$work/offline.json" || fail "the service and the command line give different results"
}
