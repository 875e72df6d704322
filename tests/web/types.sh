#!/usr/bin/env bash
# The compiler's word on the modules of pages, and on answers.ts: the types of answers that modules declare are those of the served OpenAPI document.
# types.sh BAHNWERK; needs npm, or what it installed before.
source "$(dirname "$0")/../contract/lib.sh"
here=$root/tests/web
"$here/../modules.sh" "$here"
start_server
request GET /openapi.json
out=$root/build/web
mkdir -p "$out"
"$here/node_modules/.bin/openapi-typescript" "$work/body" --default-non-nullable=false -o "$out/served.d.ts" >"$work/out" 2>&1 || { cat "$work/out" >&2; fail "types from the OpenAPI document"; }
"$here/node_modules/.bin/tsc" -p "$here" || { echo "FAILED: the compiler" >&2; exit 1; }
