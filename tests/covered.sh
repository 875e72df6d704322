#!/usr/bin/env bash
# Every header that files of another folder include has a test of its own name, declares no function, or has a line in tests/README.md; every line there names
# what exists and has no such test. Headers that their own folder alone includes are its parts: tests of what the folder offers cover them.
# Where several headers have one name, a test of that name is the own one of the header in whose folder, or above it, the test's folder lies. Functions that
# are pure virtual, defaulted or deleted are none.
set -euo pipefail
cd "${1:-.}"
bad=0
tests=$(find tests -name '*.cpp' -o -name '*.sh')
headers=$(find core api server -name '*.hpp')
# The headers that another folder includes.
offered=$(grep -RoE '^#include "(core|api|server)/[^"]*' core api server --include='*.hpp' --include='*.ipp' --include='*.cpp' |
  awk -F: '{ sub(/^#include "/, "", $2); from = $1; to = $2; sub(/[^\/]*$/, "", from); sub(/[^\/]*$/, "", to); if (from != to) print $2 }' | sort -u)
namesakes=$(sed 's|.*/||' <<<"$headers" | sort | uniq -d)

# has_own_test HEADER
has_own_test() {
  local name folder found test
  name=$(basename "$1" .hpp)
  case $1 in server/*) found=$(grep "/$name\\.cpp\$" <<<"$tests") || return 1 ;; *) found=$(grep "/${name}_test\\.cpp\$" <<<"$tests") || return 1 ;; esac
  grep -qx "$name.hpp" <<<"$namesakes" || return 0
  folder=tests/$(dirname "$1")/
  while read -r test; do [[ $folder == "$(dirname "$test")"/* ]] && return 0; done <<<"$found"
  return 1
}

# declares_functions HEADER: reads all that sed writes, so that no pipe breaks.
declares_functions() {
  sed -e 's://.*::' -e '/^ *#/d' "$1" | sed -zE 's/[^;{}]*= (0|default|delete);//g' | grep '(' >/dev/null
}

mapfile -t lines < <(sed -n '/^# Which test covers what/,$ s/^| \(`.*\) | \(.*\) |$/\1|\2/p' tests/README.md)
listed=()
for line in "${lines[@]}"; do
  while read -r header; do
    listed+=("$header")
    grep -q "^\(.*/\)\?$header\$" <<<"$headers" || { echo "tests/README.md names $header, which does not exist"; bad=1; }
  done < <(grep -o '[a-z0-9_/]*\.hpp' <<<"${line%%|*}")
  while read -r test; do
    grep -q "/$test\$" <<<"$tests" || { echo "tests/README.md names $test, which does not exist"; bad=1; }
  done < <(grep -oE '[a-z0-9_/]+\.(cpp|sh)' <<<"${line##*|}")
done
declare -A needed=()
for header in $offered; do
  has_own_test "$header" && continue
  declares_functions "$header" || continue
  covered=0
  for each in "${listed[@]}"; do [[ /$header == */"$each" ]] && covered=1 && needed[$each]=1; done
  [[ $covered == 1 ]] || { echo "$header has no test of its own name and no line in tests/README.md"; bad=1; }
done
for each in "${listed[@]}"; do
  [[ -v needed[$each] ]] || { echo "tests/README.md names $each, which needs no line"; bad=1; }
done
exit $bad
