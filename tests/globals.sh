#!/usr/bin/env bash
# core and api have no writable globals: planners of several workers share nothing that one could change under another.
# Usage: globals.sh BUILD SOURCES   Looks at the libraries of the layers core and api below BUILD; fails with every object in a writable section, but
# for constants of functions (`static const table = made();` in SOURCES): the first caller sets them, under the guard that the compiler makes.
set -euo pipefail
mapfile -t libraries < <(find "$1/core" "$1/api" -name "*.a")
[[ ${#libraries[@]} -gt 0 ]] || { echo "no libraries in $1"; exit 1; }

# constant NAME SOURCES: whether the sources declare a constant of a function by this name. One that is a pointer is `* const`.
constant() {
  grep -rhE "^ *static .*\b$1( =|;|\{|\(|\[)" "$2/core" "$2/api" | grep -qE "^ *static (const ([^=]*[^*=] )?|.*\* ?const )$1\b"
}
# objects LIBRARY: columns of objdump are value, flags, section, TAB, size, name. Relocated constants (.data.rel.ro) are write-protected.
objects() {
  objdump -tC "$1" | awk '(/ O \.(data|bss)/ || / \.(tdata|tbss)[^\t]*\t0*[1-9a-f]/) && !/ O \.data\.rel\.ro/ {
    sub(/^[^\t]*\t[0-9a-f]+ +(\.hidden )?/, ""); print }'
}
failed=0
for library in "${libraries[@]}"; do
  list=$(objects "$library" | sort -u)
  while read -r object; do
    [[ -n $object && ! $object =~ ^(guard\ variable\ for|DW\.ref\.|std::|boost::|nlohmann::|valijson::|Eigen::|__) ]] || continue
    grep -qxF "guard variable for $object" <<<"$list" && constant "${object##*::}" "$2" && continue
    echo "${library##*/}: $object can be written"
    failed=1
  done <<<"$list"
done
exit $failed
