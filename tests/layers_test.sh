#!/usr/bin/env bash
# layers.sh has to fail on includes that point up or sideways, on libraries that a layer may not use, on a folder without a layer, on a layers.txt that
# names what does not exist, and on circles between folders. Works on a tree with the project's own layers and headers, all of them empty.
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
including 0 core/verify/law/verifier.cpp core/motion/law/time_law.hpp
including 0 core/verify/law/law_checks.cpp core/verify/rounding.hpp
including 1 core/verify/law/verifier.cpp core/motion/law/trajectory.hpp
including 1 core/verify/bound/lower_bound.cpp core/motion/acceleration/acceleration_limited.hpp
including 1 core/motion/jerk/solver.cpp core/verify/law/verifier.hpp
including 1 core/motion/profile/profile.cpp core/motion/grid/grid.hpp
including 1 core/geometry/region/region.hpp core/winding/margin.hpp
including 1 core/contour/contour.hpp core/plan/contour/contour_plan.hpp
including 1 api/documents/job.cpp core/motion/jerk/jerk_limited.hpp
including 1 api/kinds/fill_factor/fill_factor.cpp api/kinds/winding/winding.hpp
including 1 api/kinds/probe_path/probe_path.cpp core/winding/wire.hpp
including 0 api/kinds/winding/winding.cpp api/problem.hpp
including 1 server/http/router.cpp core/plan/contour/contour_plan.hpp
including 1 server/store/codec.cpp server/http/router.hpp
# A folder's own headers without those below it.
including 0 core/redundant/iterative/iterative.cpp core/redundant/coarse_fine.hpp
including 1 core/redundant/iterative/iterative.cpp core/redundant/known/split_path.hpp
# Libraries.
including 0 core/cam/law_table.cpp '<Eigen/Dense>'
including 1 core/contour/builder.cpp '<Eigen/Dense>'
including 1 core/plan/contour/contour_plan.cpp '<nlohmann/json.hpp>'
including 1 core/base/progress.cpp '<pthread.h>'
including 0 core/base/progress.cpp '<vector>'
# A folder that belongs to no layer, until it has a list.
including 1 core/elsewhere/thing.cpp core/base/errors.hpp
echo '#include "core/base/errors.hpp"' >"$tree/core/elsewhere/thing.cpp"
echo core/base/ >"$tree/core/elsewhere/layers.txt"
expect 0 "a new layer"
echo core/base/nothing.hpp >>"$tree/core/elsewhere/layers.txt"
expect 1 "a list that names what does not exist"
# Circles between folders of one layer, of two folders and of three, a folder and the one that holds it among them.
# circle <what has to be said> <file> <include> …: these files are there with these includes alone
circle() {
  local said=$1 told file
  shift
  for ((k = 1; k < $#; k += 2)); do file=${!k} header=$((k + 1)) && echo "#include \"${!header}\"" >"$tree/$file"; done
  told=$(tests/layers.sh "$tree") || true
  for ((k = 1; k < $#; k += 2)); do file=${!k} && : >"$tree/$file"; done
  [[ $told == "$said" ]] || { echo "layers.sh says '$told', not '$said'"; exit 1; }
}
sed -i '$d' "$tree/core/elsewhere/layers.txt"
to=core/winding/path/link_search.hpp from=core/winding/needle/solid.hpp
circle "" core/winding/path/payout.cpp $from core/winding/path/post_passage.hpp $from
circle "folders make a circle: core/winding/needle/payout.cpp:1 includes $to, $to:1 includes $from" core/winding/needle/payout.cpp $to $to $from
circle "folders make a circle: core/winding/wire.hpp:1 includes $from, core/winding/needle/solid.cpp:1 includes core/winding/margin.hpp" \
  core/winding/wire.hpp $from core/winding/needle/solid.cpp core/winding/margin.hpp
circle "folders make a circle: core/winding/needle/a.cpp:1 includes $to, core/winding/path/b.cpp:1 includes core/winding/slot/slot.hpp, core/winding/slot/c.cpp:1 includes $from" \
  core/winding/needle/a.cpp $to core/winding/path/b.cpp core/winding/slot/slot.hpp core/winding/slot/c.cpp $from
# One that is known passes, and has to be there.
mkdir "$tree/tests"
echo "core/winding/needle core/winding/path" >"$tree/tests/circles.txt"
circle "" core/winding/needle/payout.cpp $to $to $from
circle "tests/circles.txt names a circle of core/winding/needle and core/winding/path that is gone" core/winding/needle/payout.cpp $to
