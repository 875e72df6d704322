#!/usr/bin/env bash
# Every stage that a client can see: cancelled there, a job stops the first time that its planner reports again, which a tenth of the limit below is
# enough for; asked to end there, the process ends in order. What counts is the processor time that the server takes until then (a stage that does not
# listen burns it). That a plan stops at whichever report it is told to, the tests of stages show.
source "$(dirname "$0")/../contract/lib.sh"
slower=${SLOWER:-1}          # a sanitizer's factor: documents are as much shorter
limit_ms=$((1000 * slower))  # from the order to the end
ticks=$(getconf CLK_TCK)

# cpu_ms: processor time of the server so far.
cpu_ms() { sed 's/.*) //' "/proc/$server_pid/stat" | awk -v hz="$ticks" '{ printf "%d", ($12 + $13) * 1000 / hz }'; }

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
waves $((60000 / slower)) '{"method":"jerk_limited","corner":{"mode":"blend","tolerance":0.02}}' 800000 >"$work/contour.json"
slot "${CORNERS:-200}" >"$work/slot.json"

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

for name in contour slot; do
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
    request GET "/v1/jobs/$id"
    [[ $(field .state) == succeeded ]] || expect_stopped "$id"
    seen+=" $stage" stages=$((stages + 1))
  done
  ((stages >= 3)) || fail "$name showed $stages stages only"
  # SIGTERM in the first, a middle and the last stage: all stages but the one aimed at count as seen.
  read -ra all <<<"$seen"
  for target in "${all[0]}" "${all[stages / 2]}" "${all[stages - 1]}"; do
    seen=
    for other in "${all[@]}"; do [[ $other == "$target" ]] || seen+=" $other"; done
    [[ -n $server_pid ]] || start_server --workers 1 --drain-timeout 0.5
    reach || continue # too short to be hit this time
    stop_server TERM || fail "$name: SIGTERM in stage $target: exit code $?"
    start_server --workers 0
    request GET "/v1/jobs/$id"
    expect_json '.state == "queued" or .state == "succeeded"'
    request POST "/v1/jobs/$id/cancel"
    stop_server || fail "orderly end"
  done
  stop_server || fail "orderly end"
done
