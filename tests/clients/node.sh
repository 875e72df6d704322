#!/usr/bin/env bash
# The client of examples/clients/node, with the real service.
source "$(dirname "$0")/lib.sh"
start_server
start_proxy 60 700 1500
URL=$url PROXY=$proxy EXAMPLES=$examples WORK=$work node --test "$root/tests/clients/node_client.mjs" >"$work/out" 2>&1 ||
  { cat "$work/out" >&2; fail "the client's tests"; }
mapfile -t seen < <(sed 1d "$work/proxy")
expect_equal "${seen[0]} ${seen[1]}" "- -" "nothing was had before the first whole event"
[[ ${seen[3]} =~ ^[1-9][0-9]*$ ]] || fail "the connection after the first event says which it had: ${seen[*]}"
node "$examples/clients/node/bahnwerk.mjs" "$examples/line.json" "$url" >"$work/body" 2>/dev/null || fail "plans as a program"
expect_json '.verification.passed'
code=0
node "$examples/clients/node/bahnwerk.mjs" "$work/wrong.json" "$url" 2>"$work/err" || code=$?
expect_equal "$code" 1
grep -q '/spec/contour/blocks/0/feed: ' "$work/err" || fail "the fault's place is said"
