#!/usr/bin/env bash
# The command line goes on over a restart of the service, tells the job's id at once, and gives up when its patience is over.
source "$(dirname "$0")/../contract/lib.sh"
start_server --workers 0
home=$address
restart() { # the flags of serve; at the same address
  : >"$work/log"
  "$bahnwerk" serve --listen "$home" --worker-nice 0 --store "sqlite:$work/store.db" "$@" 2>>"$work/log" &
  server_pid=$!
}
told() { id=$(sed -n 's/^bahnwerk: job //p' "$work/err") && [[ -n $id ]]; }

"$bahnwerk" submit --wait "$examples/line.json" --server "$url" --patience 600 >"$work/out" 2>"$work/err" &
submit=$!
soon told || fail "the id is not told while the job waits"
"$bahnwerk" watch "$id" --server "$url" --patience 600 >"$work/watched" &
watch=$!
both_wait() { [[ $(curl -fsS "$url/metrics" | sed -n 's/^bahnwerk_http_connections //p') == 3 ]]; } # and the one that asks
soon both_wait || fail "watch does not wait"
stop_server KILL || true
restart --workers 1
wait $submit || fail "submit --wait over a restart: $(cat "$work/err")"
jq -e '.verification.passed' "$work/out" >/dev/null || fail "the result"
wait $watch || fail "watch over a restart"
jq -e '.state == "succeeded" and .id == $id' --arg id "$id" "$work/watched" >/dev/null || fail "the job"
stop_server || fail "orderly end"

restart --workers 0
soon logged '.event == "listening"' || fail "no server"
"$bahnwerk" submit --wait "$examples/line.json" --server "$url" --patience 0.5 >"$work/out" 2>"$work/err" &
submit=$!
soon told || fail "the id is not told"
stop_server KILL || true
code=0
wait $submit || code=$?
expect_equal $code 3 "a server that does not come back"
