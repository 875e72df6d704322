#!/usr/bin/env bash
# An #include only ever points down: fails on the first one that does not. Each layer names what it may include: a folder
# (it ends with /) with all that is below it, or an exact header. A layer may include its own files.
set -euo pipefail
cd "${1:-.}"
declare -A allowed=(
  [core/base]=""
  [core/numeric]=""
  [core/numeric/optimise]="core/base/ core/numeric/"
  [core/geometry/curve]="core/base/ core/numeric/"
  [core/geometry/path]="core/geometry/curve/ core/base/ core/numeric/"
  [core/geometry/region]="core/base/"
  [core/geometry/spline]="core/geometry/curve/ core/numeric/ core/base/"
  [core/geometry/spline/search]="core/geometry/spline/ core/numeric/ core/base/"
  [core/drawing]="core/geometry/"
  [core/machine]="core/geometry/curve/ core/numeric/ core/base/errors.hpp"
  [core/contour]="core/machine/ core/geometry/curve/ core/geometry/path/ core/numeric/large_pages.hpp core/base/"
  [core/motion/axes]="core/contour/contour.hpp core/machine/ core/geometry/curve/ core/geometry/path/ core/numeric/ core/base/"
  [core/motion/law]="core/motion/axes/ core/contour/contour.hpp core/machine/ core/geometry/path/ core/numeric/ core/base/"
  [core/motion/interpolation]="core/motion/axes/ core/motion/law/ core/machine/limits.hpp core/geometry/curve/ core/geometry/path/ core/base/"
  [core/motion/grid]="core/motion/axes/ core/contour/contour.hpp core/machine/ core/geometry/path/ core/numeric/ core/base/"
  [core/motion/setpoints]="core/motion/axes/ core/motion/interpolation/ core/motion/law/ core/contour/contour.hpp core/machine/ core/base/"
  [core/motion/relaxation]="core/numeric/ core/base/"
  [core/motion/profile]="core/motion/law/ core/machine/ core/base/"
  [core/motion/acceleration]="core/motion/axes/ core/motion/grid/ core/motion/law/ core/contour/contour.hpp core/machine/ core/geometry/path/ core/numeric/ core/base/"
  [core/motion/jerk]="core/motion/profile/ core/motion/axes/ core/motion/grid/ core/motion/law/ core/contour/contour.hpp core/machine/ core/numeric/ core/base/"
  [core/motion/natural]="core/motion/axes/ core/motion/law/ core/geometry/path/ core/geometry/curve/ core/machine/ core/contour/contour.hpp core/base/"
  [core/motion/feed]="core/motion/axes/ core/motion/grid/ core/motion/law/ core/motion/profile/ core/geometry/path/ core/geometry/curve/ core/machine/ core/contour/contour.hpp core/numeric/golden_section.hpp core/numeric/optimise/optimise.hpp core/base/"
  [core/redundant]="core/geometry/curve/line.hpp core/geometry/curve/reversed.hpp core/geometry/path/path.hpp core/motion/axes/ core/motion/law/ core/motion/acceleration/acceleration_limited.hpp core/motion/jerk/jerk_limited.hpp core/motion/profile/profile.hpp core/contour/contour.hpp core/machine/ core/numeric/ core/base/"
  [core/redundant/known]="core/redundant/ core/geometry/curve/line.hpp core/geometry/path/path.hpp core/motion/axes/ core/motion/law/ core/motion/acceleration/acceleration_limited.hpp core/motion/jerk/jerk_limited.hpp core/motion/profile/profile.hpp core/contour/contour.hpp core/machine/ core/numeric/ core/base/"
  # The table of methods is above them all.
  [core/redundant/methods]="core/redundant/ core/base/"
  [core/redundant/iterative]="core/redundant/ core/motion/axes/ core/motion/law/ core/motion/grid/sections.hpp core/motion/acceleration/acceleration_limited.hpp core/motion/jerk/jerk_limited.hpp core/contour/contour.hpp core/machine/ core/geometry/curve/ core/geometry/path/ core/numeric/ core/base/"
  [core/cam]="core/motion/axes/motion.hpp core/numeric/ core/base/"
  [core/winding]="core/drawing/ core/geometry/region/ core/geometry/spline/ core/geometry/curve/vec.hpp core/numeric/golden_section.hpp core/numeric/random.hpp core/numeric/taylor.hpp core/base/"
  [core/probe]="core/motion/axes/motion.hpp core/motion/axes/spline_motion.hpp core/machine/ core/geometry/curve/vec.hpp core/numeric/ core/base/"
  [core/probe/straight]="core/probe/ core/motion/profile/ core/motion/axes/spline_motion.hpp core/machine/ core/geometry/curve/vec.hpp core/numeric/ core/base/"
  [core/probe/arcs]="core/probe/ core/motion/profile/ core/motion/law/time_law.hpp core/motion/axes/spline_motion.hpp core/machine/ core/geometry/curve/vec.hpp core/numeric/ core/base/"
  [core/probe/spline]="core/probe/ core/motion/profile/ core/motion/axes/spline_motion.hpp core/machine/ core/geometry/curve/vec.hpp core/numeric/ core/base/"
  [core/probe/optimal]="core/probe/ core/motion/profile/ core/motion/axes/spline_motion.hpp core/machine/ core/geometry/curve/vec.hpp core/numeric/ core/base/"
  # The verifier sees what the user gave and the finished motion, no planner. The relaxation gives the bound multipliers,
  # of which any are valid.
  [core/verify]="core/motion/axes/axis_path.hpp core/motion/axes/motion.hpp core/motion/axes/path_task.hpp core/motion/law/time_law.hpp core/contour/contour.hpp
    core/machine/machine.hpp core/machine/kinematics.hpp core/machine/tool.hpp
    core/motion/relaxation/relaxation.hpp core/motion/relaxation/weak_form.hpp core/motion/relaxation/splines.hpp core/motion/relaxation/windows.hpp
    core/probe/problem.hpp core/probe/probe_motion.hpp core/winding/margin.hpp core/geometry/region/region.hpp core/cam/problem.hpp core/cam/classical/classical_law.hpp
    core/geometry/curve/arc.hpp core/geometry/curve/curve.hpp core/geometry/curve/rational.hpp core/geometry/curve/vec.hpp core/geometry/path/matched.hpp core/geometry/path/path.hpp core/geometry/path/rough_shape.hpp
    core/numeric/lanes.hpp core/numeric/large_pages.hpp core/numeric/peak.hpp core/numeric/polynomial.hpp
    core/base/"
  [core/plan]="core/verify/ core/cam/ core/winding/ core/motion/axes/ core/motion/interpolation/ core/motion/law/ core/motion/setpoints/ core/motion/acceleration/acceleration_limited.hpp core/motion/jerk/jerk_limited.hpp core/motion/natural/natural_law.hpp core/motion/feed/ core/motion/profile/speed_profile.hpp
    core/redundant/methods/method_table.hpp core/redundant/redundancy.hpp core/redundant/coarse_fine.hpp core/redundant/energy.hpp
    core/probe/ core/contour/ core/machine/ core/drawing/ core/geometry/ core/numeric/random.hpp core/numeric/taylor.hpp core/base/"
  [api]="core/plan/ core/base/ core/cam/problem.hpp core/cam/cam_law.hpp core/cam/solution.hpp core/cam/law_table.hpp core/cam/table/controller_table.hpp core/cam/spline/active_set.hpp core/cam/spline/spline_faults.hpp
    core/contour/contour.hpp core/contour/builder.hpp core/contour/polyline.hpp core/contour/dxf.hpp core/contour/gcode.hpp core/machine/ core/redundant/redundancy.hpp core/redundant/coarse_fine.hpp core/redundant/joint.hpp core/redundant/known/lag_compensation.hpp core/redundant/methods/method_table.hpp
    core/probe/problem.hpp core/probe/probe_motion.hpp core/winding/wire.hpp core/winding/slot/slot.hpp core/winding/slot/coil_sides.hpp core/winding/laying/laying_regions.hpp core/winding/laying/windable.hpp core/winding/layout/count_bound.hpp core/winding/part/part.hpp"
  [server]="api/ core/base/errors.hpp core/base/progress.hpp"
  [server/runtime]="api/job.hpp"
  [server/store]="server/runtime/ api/job.hpp api/planned_job.hpp api/problem.hpp api/setpoints.hpp core/base/progress.hpp"
  [server/http]="server/runtime/ server/store/store.hpp api/accept.hpp api/pointer.hpp api/problem.hpp"
  [server/jobs]="server/runtime/ server/store/store.hpp server/store/changes.hpp api/job.hpp api/planned_job.hpp api/problem.hpp core/base/errors.hpp core/base/progress.hpp"
  [server/routes]="server/http/ server/jobs/ server/runtime/ server/store/store.hpp api/"
  [server/cli]="server/service.hpp server/http/message.hpp server/http/uri.hpp server/runtime/ api/base64.hpp api/planned_job.hpp api/problem.hpp api/setpoints.hpp core/base/errors.hpp core/base/progress.hpp"
)
bad=0
while IFS=: read -r file line include; do
  target=${include#*\"}; target=${target%\"*}
  layer=${file%/*}
  while [[ -z ${allowed[$layer]+named} && $layer == */* ]]; do layer=${layer%/*}; done
  if [[ -z ${allowed[$layer]+named} ]]; then echo "$file belongs to no layer of $0"; bad=1; continue; fi
  target_layer=${target%/*}
  while [[ -z ${allowed[$target_layer]+named} && $target_layer == */* ]]; do target_layer=${target_layer%/*}; done
  [[ $target_layer == "$layer" ]] && continue
  # server/*.cpp puts the parts together.
  [[ $layer == server && $target == server/* ]] && continue
  ok=0
  for entry in ${allowed[$layer]}; do
    if [[ $target == "$entry" || ($entry == */ && $target == "$entry"*) ]]; then ok=1; fi
  done
  if [[ $ok == 0 ]]; then echo "$file:$line includes $target, which $layer may not"; bad=1; fi
done < <(grep -RnE '^#include "' core api server --include='*.hpp' --include='*.cpp')
exit $bad
