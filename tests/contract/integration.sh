#!/usr/bin/env bash
# What docs/integration.md shows is run as it stands there.
source "$(dirname "$0")/lib.sh"
mkdir "$work/bin" "$work/here"
ln -s "$(realpath "$bahnwerk")" "$work/bin/bahnwerk"
ln -s "$examples" "$work/here/examples"
awk '/^```bash$/ { on = 1; next } /^```$/ { on = 0 } on' "$root/docs/integration.md" >"$work/script"
[[ $(grep -c . "$work/script") -gt 30 ]] || fail "the blocks are found"
free_port() { python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'; }
sed -i "s/18443/$(free_port)/g; s/18444/$(free_port)/g" "$work/script"
(cd "$work/here" && PATH=$work/bin:$PATH timeout $((300 * ${SLOWER:-1})) bash -euo pipefail "$work/script" >"$work/out" 2>&1) || {
  kill "$(jq -rR 'fromjson? | select(.event == "listening").pid' "$work/here/log" 2>/dev/null)" 2>/dev/null || true
  cat "$work/out" >&2
  fail "docs/integration.md"
}
grep -q '"action":"POST /v1/jobs"' "$work/out" || fail "the audit lines"
