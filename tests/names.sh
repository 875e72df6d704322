#!/usr/bin/env bash
# One type, one name: two classes of the same name in one namespace are one to the linker, whose functions are then mixed up.
# Prints every name that headers give to more than one type; what a header only declares does not count.
set -euo pipefail
cd "${1:-.}"
find core api server -name '*.hpp' -exec awk '
  FNR == 1 { space = "" }
  /^namespace [a-z_:]+ *\{/ { space = $2 }
  /^(class|struct|enum|union) / && !/;[ \t]*$/ || /^(class|struct|enum|union) .*\{.*\};/ {
    name = $2 == "class" || $2 == "struct" ? $3 : $2
    sub(/(\{.*|:)$/, "", name)
    if (name ~ /^[A-Za-z_0-9]+$/) print space "::" name, FILENAME
  }' {} + | sort -u | awk '
  $1 == last { print "the name " $1 " stands for two types: in " file " and in " $2; bad = 1 }
  { last = $1; file = $2 }
  END { exit bad }'
