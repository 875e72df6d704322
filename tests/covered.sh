#!/usr/bin/env bash
# Every header has a test of its own name, declares no function, or has a line in tests/README.md; every line there names what exists.
set -euo pipefail
cd "${1:-.}"
bad=0
tests=$(find tests -name '*.cpp' -o -name '*.sh')
headers=$(find core api server -name '*.hpp')
mapfile -t lines < <(sed -n 's/^| \(`.*\) | \(.*\) |$/\1|\2/p' tests/README.md)
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
for header in $headers; do
  name=$(basename "$header" .hpp)
  case $header in server/*) own="/$name\\.cpp\$" ;; *) own="/${name}_test\\.cpp\$" ;; esac
  grep -q "$own" <<<"$tests" && continue
  sed -e 's://.*::' -e '/^ *#/d' "$header" | grep -q '(' || continue # no function: types alone
  covered=0
  for each in "${listed[@]}"; do [[ /$header == */"$each" ]] && covered=1 && break; done
  [[ $covered == 1 ]] || { echo "$header has no test of its own name and no line in tests/README.md"; bad=1; }
done
exit $bad
