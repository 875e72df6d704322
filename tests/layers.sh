#!/usr/bin/env bash
# An #include only ever points down: fails on the first one that does not. A layer is a folder with a file layers.txt, and all below it that is no layer
# of its own. The file names what the layer may include beside its own files, one per line:
#   core/base/       a folder with all that is below it
#   api/*            the headers of a folder without those below it
#   core/a/b.hpp     one header
#   <Eigen/ <nlopt.h> headers of a library; in core and api, none that is not named
# CMake links a layer of core with the layers that its file names.
# Folders make no circles, inside a layer as well: where files of one folder include files of another, no chain of includes leads back. A folder holds its own
# files alone, not those of folders below it. Circles that are still there stand in tests/circles.txt, which only gets shorter.
set -euo pipefail
cd "${1:-.}"
declare -A allowed libraries
bad=0
for list in $(find core api server -name layers.txt); do
  layer=${list%/*} allowed[$layer]="" libraries[$layer]=""
  while read -r entry; do
    case $entry in
      "" | \#*) continue ;;
      \<*) libraries[$layer]+=" ${entry#<}" ;;
      *) allowed[$layer]+=" $entry" ;;
    esac
  done <"$list"
done
# layer_of FILE: the layer that the file belongs to, or nothing; sets $layer
layer_of() {
  layer=${1%/*}
  while [[ -z ${allowed[$layer]+named} && $layer == */* ]]; do layer=${layer%/*}; done
  [[ -n ${allowed[$layer]+named} ]] || layer=""
}
# permits HEADER ENTRY…
permits() {
  local header=$1 entry
  shift
  for entry; do
    case $entry in
      */) [[ $header == "$entry"* ]] && return 0 ;;
      */\*) [[ ${header%/*} == "${entry%/\*}" ]] && return 0 ;;
      *) [[ $header == "$entry" ]] && return 0 ;;
    esac
  done
  return 1
}
set -f # entries end with *
for layer in "${!allowed[@]}"; do
  for entry in ${allowed[$layer]}; do
    [[ -e ${entry%\*} ]] || { echo "$layer/layers.txt names $entry, which does not exist"; bad=1; }
  done
done
while IFS=: read -r file line include; do
  layer_of "$file"
  own=$layer
  [[ -n $own ]] || { echo "$file belongs to no layer: no folder above it has a layers.txt"; bad=1; continue; }
  if [[ $include == *\"* ]]; then
    header=${include#*\"} header=${header%\"*}
    layer_of "$header"
    [[ $layer == "$own" ]] || permits "$header" ${allowed[$own]} || { echo "$file:$line includes $header, which $own may not"; bad=1; }
  else
    header=${include#*<} header=${header%>*}
    # A header of the language has neither a folder nor a suffix.
    [[ $own == server* || $header != *[/.]* ]] && continue
    ok=0
    for entry in ${libraries[$own]}; do [[ $header == "${entry%>}" || ($entry == */ && $header == "$entry"*) ]] && ok=1; done
    [[ $ok == 1 ]] || { echo "$file:$line includes <$header>, which $own may not"; bad=1; }
  fi
done < <(grep -RnE '^#include ["<]' core api server --include='*.hpp' --include='*.ipp' --include='*.cpp' | grep -vE '#include <[a-z_]+>')

{ grep -RnE '^#include "(core|api|server)/' core api server --include='*.hpp' --include='*.ipp' --include='*.cpp' || true; } | sort -t: -k1,1 -k2,2n |
  awk -v known="$(cat tests/circles.txt 2>/dev/null)" '
  function folder(file) { sub(/\/[^\/]*$/, "", file); return file }
  # chain(from, to): folders on the shortest chain of includes, each followed by a blank; empty: there is none.
  function chain(from, to, queue, before, head, tail, here, list, n, i, path) {
    queue[head = tail = 1] = from; before[from] = ""
    while (head <= tail) {
      here = queue[head++]
      if (here == to) {
        for (path = to " "; here != from; path = here " " path) here = before[here]
        return path
      }
      n = split(next_to[here], list, " ")
      for (i = 1; i <= n; ++i)
        if (!(list[i] in before) && !((here SUBSEP list[i]) in excused)) { before[list[i]] = here; queue[++tail] = list[i] }
    }
    return ""
  }
  BEGIN { split(known, lines, "\n"); for (i in lines) if (lines[i] !~ /^#/ && split(lines[i], ends, " ") == 2) excused[ends[1], ends[2]] = 1 }
  {
    split($0, part, ":"); header = $0; sub(/^[^"]*"/, "", header); sub(/".*/, "", header)
    from = folder(part[1]); to = folder(header)
    if (from == to) next
    if (!((from SUBSEP to) in include)) { include[from, to] = part[1] ":" part[2] " includes " header; next_to[from] = next_to[from] " " to; edges[++count] = from SUBSEP to }
  }
  END {
    for (e = 1; e <= count; ++e) {
      if (edges[e] in excused) continue
      split(edges[e], ends, SUBSEP)
      back = chain(ends[2], ends[1])
      if (back == "") continue
      bad = 1
      n = split(back, at, " "); text = include[edges[e]]; least = ends[1]
      for (i = 1; i < n; ++i) { text = text ", " include[at[i], at[i + 1]]; if (at[i] < least) least = at[i] }
      if (least == ends[1] && !(text in told)) { told[text]; print "folders make a circle: " text }
    }
    for (e in excused) {
      split(e, ends, SUBSEP)
      if (!(e in include) || chain(ends[2], ends[1]) == "") { print "tests/circles.txt names a circle of " ends[1] " and " ends[2] " that is gone"; bad = 1 }
    }
    exit bad
  }' || bad=1
exit $bad
