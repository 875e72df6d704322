#!/usr/bin/env bash
# layers.sh has to fail on includes that point up or sideways, and on a folder that it does not know.
set -euo pipefail
layers=$(dirname "$0")/layers.sh
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
# expect <0|1> <file> <include>
expect() {
  rm -rf "${tree:?}"/*
  mkdir -p "$tree"/{core,api,server} "$(dirname "$tree/$2")"
  echo "#include \"$3\"" >"$tree/$2"
  local got=0
  "$layers" "$tree" >/dev/null || got=1
  [[ $got == "$1" ]] || { echo "$2 including $3: got $got, not $1"; exit 1; }
}
expect 0 core/verify/verifier.cpp core/motion/law/time_law.hpp
expect 0 core/verify/law/law_checks.cpp core/verify/rounding.hpp
expect 1 core/verify/verifier.cpp core/motion/law/trajectory.hpp
expect 1 core/verify/bound/lower_bound.cpp core/motion/acceleration/acceleration_limited.hpp
expect 1 core/motion/jerk/solver.cpp core/verify/verifier.hpp
expect 1 core/motion/profile/profile.cpp core/motion/grid/grid.hpp
expect 1 core/geometry/region/region.hpp core/winding/margin.hpp
expect 1 core/contour/contour.hpp core/plan/contour_plan.hpp
expect 1 api/job.cpp core/motion/jerk/jerk_limited.hpp
expect 1 server/http/router.cpp core/plan/contour_plan.hpp
expect 1 server/store/codec.cpp server/http/router.hpp
expect 1 core/elsewhere/thing.cpp core/base/errors.hpp
