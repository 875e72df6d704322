#!/usr/bin/env bash
# mentions.sh has to find what is not there, and to let pass what is.
set -euo pipefail
mentions=$(dirname "$0")/mentions.sh
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree"/{core/base,api,server,tests,docs/draw}
touch "$tree"/core/base/errors.hpp
# expect <0|1> <comment>
expect() {
  echo "int x;  // $2" >"$tree/api/job.cpp"
  local got=0
  "$mentions" "$tree" >/dev/null || got=1
  [[ $got == "$1" ]] || { echo "\"$2\": got $got, not $1"; exit 1; }
}
expect 0 "as in errors.hpp"
expect 0 "as in core/base/errors.hpp, and base/errors.hpp"
expect 0 "the service reads result.json"
expect 1 "as in error.hpp"
expect 1 "as in core/errors.hpp"
expect 1 "errors.hpp and errors.cpp"
