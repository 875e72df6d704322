#!/usr/bin/env bash
# Dashboards, alerts, units and manifests name metrics, labels and variables that the program has, and the version that it is.
source "$(dirname "$0")/../contract/lib.sh"
start_server
post "$examples/line.json"
await succeeded
request GET /v1/jobs/unknown # counts as refused
request GET "/v1/jobs/$id" -H 'Prefer: wait=1' # counts as told to wait
request GET /metrics
request GET /metrics # counts the first one, too
for command in serve submit migrate; do "$bahnwerk" $command --help >"$work/help.$command"; done
"$bahnwerk" --version >"$work/version"
python3 "$root/tests/deploy/names.py" "$root" "$work/body" "$work/help" "$work/version" || fail "a name that nothing bears"
