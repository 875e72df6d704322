#!/usr/bin/env bash
# Drives the pages of the real service in Chromium: browser.sh BAHNWERK [WORD…]. Needs chromium, and npm or what it installed before.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
"$here/../modules.sh" "$here"
exec node "$here/run.mjs" "$@"
