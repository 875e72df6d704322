#!/usr/bin/env bash
# Every kind, every stage that a client can see: cancelled there, a job stops within a second; asked to end there, the process ends within
# --drain-timeout and a second. What counts is the processor time that the server takes until then (a stage that does not listen
# burns it); the clock on the wall counts too where it can: a run that a busy machine delayed is repeated.
source "$(dirname "$0")/../contract/lib.sh"
slower=${SLOWER:-1}          # a sanitizer's factor: documents are as much shorter
limit_ms=$((1000 * slower))  # from the order to the end
ticks=$(getconf CLK_TCK)

# cpu_ms: processor time of the server so far.
cpu_ms() { sed 's/.*) //' "/proc/$server_pid/stat" | awk -v hz="$ticks" '{ printf "%d", ($12 + $13) * 1000 / hz }'; }
now_ms() { echo $(($(date +%s%N) / 1000000)); }

waves() {
  awk -v n="$1" -v planning="$2" -v jerk="$3" 'BEGIN {
    printf "{\"kind\":\"contour\",\"spec\":{\"contour\":{\"points\":[[0,0]"
    for (i = 1; i < n; i++) printf ",[%.4f,%.4f]", 0.3 * i, 5 * sin(0.02 * i)
    axis = "{\"velocity\":1800,\"acceleration\":16000,\"jerk\":" jerk "}"
    printf "]},\"machine\":{\"kinematics\":\"cartesian\",\"axes\":{\"x\":%s,\"y\":%s},\"cycle_time\":0.0005},\"planning\":%s}}", axis, axis, planning
  }'
}
slot() {
  awk -v n="$1" 'BEGIN {
    printf "{\"kind\":\"fill_factor\",\"spec\":{\"slot\":{\"type\":\"polygon\",\"liner\":0.2,\"points\":["
    for (i = 0; i < n; i++) {
      t = 6.283185307179586 * i / n
      printf "%s[%.9f,%.9f]", i ? "," : "", (7 + 0.1 * sin(40 * t)) * cos(t), 15 + (13 + 0.1 * sin(40 * t)) * sin(t)
    }
    printf "]},\"wires\":[0.71]}}"
  }'
}
waves $((100000 / slower)) '{"method":"time_optimal"}' null >"$work/optimal.json"
waves $((30000 / slower)) '{"method":"jerk_limited"}' 800000 >"$work/smooth.json"
waves $((30000 / slower)) '{"method":"braking_reserve","corner":{"mode":"blend","tolerance":0.02}}' null >"$work/blended.json"
slot "${CORNERS:-400}" >"$work/slot.json"

# reach: posts $document and holds until a stage is shown that is not in $seen; false when the job has ended without one.
reach() {
  post "$document"
  expect_status 202
  while :; do
    read -r state stage < <(curl -s "$url/v1/jobs/$id" | jq -r '.state + " " + (.progress.stage | gsub(" "; "_"))')
    case $state in
      succeeded) return 1 ;;
      failed | cancelled) request GET "/v1/jobs/$id" && fail "the job $state" ;;
    esac
    [[ $state == running && -n $stage && $stage != null && " $seen " != *" $stage "* ]] && return 0
  done
}

for name in optimal smooth blended slot; do
  document=$work/$name.json
  start_server --workers 1 --drain-timeout 0.5
  seen= stages=0
  while reach; do
    asked=$(cpu_ms)
    request POST "/v1/jobs/$id/cancel"
    expect_status 202
    until [[ $(curl -s -H 'Prefer: wait=1' "$url/v1/jobs/$id" | jq -r .state) =~ cancelled|succeeded ]]; do
      (($(cpu_ms) - asked <= 20 * limit_ms)) || fail "$name does not stop in stage $stage"
    done
    took=$(($(cpu_ms) - asked))
    echo "$name, $stage: cancelled after $took ms of processor time"
    ((took <= limit_ms)) || fail "$name: cancelled in stage $stage, the job went on for $took ms"
    seen+=" $stage" stages=$((stages + 1))
  done
  ((stages >= 3)) || fail "$name showed $stages stages only"
  all=$seen

  # The same with SIGTERM: all stages but the one aimed at count as seen.
  for target in $all; do
    for attempt in 1 2 3 4 5; do
      seen= 
      for other in $all; do [[ $other == "$target" ]] || seen+=" $other"; done
      [[ -n $server_pid ]] || start_server --workers 1 --drain-timeout 0.5
      reach || continue 2  # too short to be hit this time
      asked=$(now_ms)
      stop_server TERM || fail "$name: SIGTERM in stage $target: exit code $?"
      took=$(($(now_ms) - asked))
      ((took <= 500 + limit_ms)) && break
      ((attempt < 5)) || fail "$name: SIGTERM in stage $target took $took ms"
    done
    echo "$name, $target: SIGTERM took $took ms"
    start_server --workers 0
    request GET "/v1/jobs/$id"
    expect_json '.state == "queued" or .state == "succeeded"'
    request POST "/v1/jobs/$id/cancel"
    stop_server || fail "orderly end"
  done
  stop_server || fail "orderly end"
done
