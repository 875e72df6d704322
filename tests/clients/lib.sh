# What the clients' tests need beside the contract's helpers: a proxy that breaks event streams off, and the documents.
source "$(dirname "${BASH_SOURCE[0]}")/../contract/lib.sh"

# start_proxy CUT…: sets $proxy, the address of a cutting_proxy.py before the service; it says in $work/proxy what it saw.
start_proxy() {
  python3 "$root/tests/clients/cutting_proxy.py" "$address" "$@" >"$work/proxy" &
  proxy_pid=$!
  trap 'kill $proxy_pid 2>/dev/null || true; stop_server TERM >/dev/null 2>&1 || true; rm -rf "$work"' EXIT
  for _ in $(seq 300); do
    [[ -s $work/proxy ]] && break
    sleep 0.1
  done
  proxy=http://127.0.0.1:$(head -n 1 "$work/proxy")
}

# A job that the test can follow for as long as it likes, and one that fails at once.
snake 20000 >"$work/long.json"
snake 20000 '{"time_budget":0.05}' >"$work/budget.json"
jq '.spec.contour.blocks[0].feed = -1' "$examples/line.json" >"$work/wrong.json"
