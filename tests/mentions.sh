#!/usr/bin/env bash
# Every file that a comment names exists: path_task.hpp, core/verify/rounding.hpp, docs/methods/winding_path.md. A name is found where some path
# ends with it; what is no file of the repository, as what users name, is listed here.
set -euo pipefail
cd "${1:-.}"
{
  find . -path ./build -prune -o -path ./.git -prune -o -type f -printf '%P\n'
  printf '%s\n' json.hpp result.json setpoints.csv schemas_embedded.cpp
  echo ---
  grep -RnoE '(^|[^:"])//.*$' core api server tests docs/draw --include='*.hpp' --include='*.ipp' --include='*.cpp' | grep -E '\.(hpp|ipp|cpp|md|sh|json|cmake|sql|txt)'
} | awk '
  /^---$/ { texts = 1; next }
  !texts {
    known[$0] = 1
    while (sub(/^[^\/]*\//, "")) known[$0] = 1
    next
  }
  {
    match($0, /^[^:]*:[0-9]+:/)
    where = substr($0, 1, RLENGTH); text = substr($0, RLENGTH + 1)
    while (match(text, /[A-Za-z0-9_\/]+\.(hpp|ipp|cpp|md|sh|json|cmake|sql|txt)/)) {
      name = substr(text, RSTART, RLENGTH)
      if (!(name in known)) { print where " names " name ", which does not exist"; bad = 1 }
      text = substr(text, RSTART + RLENGTH)
    }
  }
  END { exit bad }'
