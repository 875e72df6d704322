#!/usr/bin/env bash
# An #include only ever points down: fails on the first one that does not. A layer is a folder with a file layers.txt, and all below it that is no layer
# of its own. The file names what the layer may include beside its own files, one per line:
#   core/base/       a folder with all that is below it
#   api/*            the headers of a folder without those below it
#   core/a/b.hpp     one header
#   <Eigen/ <nlopt.h> headers of a library; in core and api, none that is not named
# CMake links a layer of core with the layers that its file names.
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
exit $bad
