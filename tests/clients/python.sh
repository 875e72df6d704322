#!/usr/bin/env bash
# The client of examples/clients/python, with the real service.
source "$(dirname "$0")/lib.sh"
start_server
# Cut within the header, within the first event, and after it: the second event's first bytes are lost.
start_proxy 60 700 1500
export PYTHONPATH=$examples/clients/python PYTHONDONTWRITEBYTECODE=1
python3 "$root/tests/clients/python_client.py" "$url" "$proxy" "$examples" "$work" || fail "the client's tests"
# The same lists without numpy, whether it is installed or not.
BAHNWERK_NO_NUMPY=1 python3 "$root/tests/clients/python_client.py" "$url" "$proxy" "$examples" "$work" RowsTest || fail "without numpy"
mapfile -t seen < <(sed 1d "$work/proxy")
expect_equal "${seen[0]} ${seen[1]}" "- -" "nothing was had before the first whole event"
[[ ${seen[3]} =~ ^[1-9][0-9]*$ ]] || fail "the connection after the first event says which it had: ${seen[*]}"
# As a program.
python3 "$examples/clients/python/bahnwerk.py" "$examples/line.json" --server "$url" >"$work/body" || fail "plans as a program"
expect_json '.verification.passed'
code=0
python3 "$examples/clients/python/bahnwerk.py" "$work/wrong.json" --server "$url" 2>"$work/err" || code=$?
expect_equal "$code" 1
grep -q '/spec/contour/blocks/0/feed: ' "$work/err" || fail "the fault's place is said"
