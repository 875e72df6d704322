#!/usr/bin/env bash
# Installs the packages of Node that FOLDER/package-lock.json names into FOLDER/node_modules, unless they are there: modules.sh FOLDER. What cannot be had
# is a failure, never a reason to leave tests out.
set -euo pipefail
folder=$1
installed=$folder/node_modules/.installed
! cmp -s "$folder/package-lock.json" "$installed" || exit 0
command -v npm >/dev/null || { echo "The tests need npm, to install what $folder/package-lock.json names: apt-get install npm" >&2; exit 1; }
log=$(mktemp)
if ! npm ci --prefix "$folder" --ignore-scripts --no-audit --no-fund >"$log" 2>&1; then
  tail -5 "$log" >&2
  echo "npm could not install what $folder/package-lock.json names (no network?). The whole log: $log" >&2
  exit 1
fi
rm -f "$log"
cp "$folder/package-lock.json" "$installed"
