#!/usr/bin/env bash
# The library can be embedded: library.sh BUILD installs it from there into an empty folder; the example builds and runs against that folder alone, every
# public header stands alone, and docs/library.md names what is installed as public. Called by .ci/run package.
set -euo pipefail
root=$(realpath "$(dirname "$0")/../..")
build=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "library: $*" >&2; exit 1; }

cmake --install "$build" --prefix "$work/installed" >"$work/log" || { tail -5 "$work/log" >&2; fail "cmake --install"; }
include=$work/installed/include
[[ -s $work/installed/lib/libbahnwerk.a ]] || fail "no library"
[[ $(find "$work/installed" -mindepth 1 -maxdepth 1 -printf '%f\n' | sort | xargs) == "include lib" ]] || fail "more than a library is installed"

# The example sees the installed tree alone: it is copied out of the sources.
cp -r "$root/examples/embed" "$work/example"
cmake -S "$work/example" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/installed" -DCMAKE_CXX_FLAGS="-Wall -Wextra -Wpedantic -Werror" >"$work/log" 2>&1 &&
  cmake --build "$work/build" >>"$work/log" 2>&1 || { tail -20 "$work/log" >&2; fail "the example does not build"; }
"$work/build/embed" >"$work/rows" || fail "the example ends with $?"
cat "$work/rows"
head -n 1 "$work/rows" | grep -q '; verified$' || fail "its plan is not verified"
# x, y of the first and the last row that are printed: it begins at 0, 0 and ends at 80, 60, or some rows before.
awk 'NR == 3 && ($1 != 0 || $2 != 0) { exit 1 } END { exit !(NR > 10 && $1 == 80 && $2 > 40) }' "$work/rows" || fail "the rows are not those of the contour"

mapfile -t public < <(sed -n 's/^| `\(bahnwerk\/[a-z_/]*\.hpp\)` |.*/\1/p' "$root/docs/library.md" | sort)
declared=$(sed -n '/^set(BAHNWERK_PUBLIC_HEADERS/,/)$/p' "$root/cmake/library.cmake" | grep -o '[a-z_/]*\.hpp' | sed 's#^#bahnwerk/#' | sort)
[[ "$(printf '%s\n' "${public[@]}")" == "$declared" ]] || fail "docs/library.md and cmake/library.cmake name different headers"
# Each of them first in a file; none of the libraries that core uses is needed.
for header in "${public[@]}"; do echo "#include <$header>"; done >"$work/all.cpp"
tac "$work/all.cpp" >"$work/backwards.cpp"
for file in all backwards; do
  c++ -std=c++20 -fsyntax-only -Wall -Wextra -Wpedantic -Werror -I"$include" "$work/$file.cpp" || fail "a header does not stand alone"
done
others=$(grep -rhE '^ *# *include *[<"]' "$include" | grep -vE '<[a-z_]+>|"bahnwerk/' || true)
[[ -z $others ]] || fail "installed headers include $others"
echo "library: ${#public[@]} public headers, $(find "$include" -name '*.hpp' | wc -l) installed"
