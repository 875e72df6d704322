#!/usr/bin/env bash
# layers.sh has to fail on includes that point up or sideways, on libraries that a layer may not use, on a folder without a layer, and on a layers.txt that
# names what does not exist. Works on a tree with the project's own layers and headers, all of them empty.
set -euo pipefail
root=$(realpath "$(dirname "$0")/..")
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
cd "$root"
find core api server -type d -print0 | (cd "$tree" && xargs -0 mkdir -p)
find core api server -name '*.hpp' -print0 | (cd "$tree" && xargs -0 touch)
find core api server -name layers.txt -exec cp --parents {} "$tree" \;
# expect <0|1> <what is told of>
expect() {
  local got=0
  tests/layers.sh "$tree" >/dev/null || got=1
  [[ $got == "$1" ]] || { echo "$2: got $got, not $1"; exit 1; }
}
# including <0|1> <file> <include>: the file is there with that include alone
including() {
  local include="\"$3\""
  [[ $3 != \<* ]] || include=$3
  mkdir -p "$tree/${2%/*}"
  echo "#include $include" >"$tree/$2"
  expect "$1" "$2 including $3"
  : >"$tree/$2"
}
including 0 core/verify/verifier.cpp core/motion/law/time_law.hpp
including 0 core/verify/law/law_checks.cpp core/verify/rounding.hpp
including 1 core/verify/verifier.cpp core/motion/law/trajectory.hpp
including 1 core/verify/bound/lower_bound.cpp core/motion/acceleration/acceleration_limited.hpp
including 1 core/motion/jerk/solver.cpp core/verify/verifier.hpp
including 1 core/motion/profile/profile.cpp core/motion/grid/grid.hpp
including 1 core/geometry/region/region.hpp core/winding/margin.hpp
including 1 core/contour/contour.hpp core/plan/contour_plan.hpp
including 1 api/job.cpp core/motion/jerk/jerk_limited.hpp
including 1 api/kinds/fill_factor/fill_factor.cpp api/kinds/winding/winding.hpp
including 1 api/kinds/probe_path/probe_path.cpp core/winding/wire.hpp
including 0 api/kinds/winding/winding.cpp api/problem.hpp
including 1 server/http/router.cpp core/plan/contour_plan.hpp
including 1 server/store/codec.cpp server/http/router.hpp
# A folder's own headers without those below it.
including 0 core/redundant/iterative/iterative.cpp core/redundant/coarse_fine.hpp
including 1 core/redundant/iterative/iterative.cpp core/redundant/known/split_path.hpp
# Libraries.
including 0 core/cam/law_table.cpp '<Eigen/Dense>'
including 1 core/contour/builder.cpp '<Eigen/Dense>'
including 1 core/plan/contour_plan.cpp '<nlohmann/json.hpp>'
including 1 core/base/progress.cpp '<pthread.h>'
including 0 core/base/progress.cpp '<vector>'
# A folder that belongs to no layer, until it has a list.
including 1 core/elsewhere/thing.cpp core/base/errors.hpp
echo '#include "core/base/errors.hpp"' >"$tree/core/elsewhere/thing.cpp"
echo core/base/ >"$tree/core/elsewhere/layers.txt"
expect 0 "a new layer"
echo core/base/nothing.hpp >>"$tree/core/elsewhere/layers.txt"
expect 1 "a list that names what does not exist"
