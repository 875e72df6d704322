#!/usr/bin/env bash
# The house has floors and an #include only ever points down: fails on the first include that does not.
set -euo pipefail
cd "${1:-.}"
declare -A below=(
  [core/numeric]=""
  [core/curve]="core/numeric"
  [core/contour]="core/machine core/curve core/numeric"
  [core/machine]="core/curve core/numeric"
  [core/motion]="core/contour core/machine core/curve core/numeric"
  [core/winding]="core/numeric"
  [core/verify]="core/motion/law core/motion/trajectory core/motion/limits core/contour core/machine core/winding/region core/winding/edge core/winding/point core/winding/margin core/curve core/numeric"
  [core]="core/"
  [api]="core api"
  [server]="api core server"
)
bad=0
while IFS=: read -r file _ include; do
  target=${include#*\"}; target=${target%\"*}
  case $file in core/*/*) floor=$(cut -d/ -f1,2 <<<"$file") ;; core/*) floor=core ;; *) floor=${file%%/*} ;; esac
  [[ $target == core/*.hpp && $target != core/*/* ]] && continue  # core's own shared headers (progress, errors, plan)
  [[ $floor != core && $target == "$floor"/* ]] && continue
  ok=0
  for allowed in ${below[$floor]:-}; do [[ $target == "$allowed"* ]] && ok=1; done
  if [[ $ok == 0 ]]; then echo "$file includes $target: arrow points up"; bad=1; fi
done < <(grep -RnE '^#include "' core api server --include='*.hpp' --include='*.cpp')
exit $bad
