#include "core/plan/probe/probe_setpoints.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "core/probe/resting_motion.hpp"

namespace bahnwerk {

ProbeSetpoints::ProbeSetpoints(std::shared_ptr<const ProbeProblem> problem, ProbeMotion motion, std::size_t cycles)
    : MotionSetpoints(std::make_shared<const RestingMotion>(motion.motion, problem->points.back()), problem->machine,
                      cycles),
      problem_(std::move(problem)),
      motion_(std::move(motion)) {
  for (const AxisLimits& axis : problem_->machine.axes) add_column({"j" + axis.name, axis.unit + "/s³"});
  add_column({"deviation", "mm"});
  add_column({"v", "mm/s"});
}

void ProbeSetpoints::write(Row& row, double* out) const {
  const std::size_t n = problem_->dimension();
  const SplineMotion& motion = *motion_.motion;
  const MotionState x = row.last ? RestingMotion(motion_.motion, problem_->points.back()).final_state()
                                 : motion.evaluate(row.t, row.piece);
  Vec position, velocity;
  for (std::size_t k = 0; k < n; ++k) {
    position[k] = x[0][k], velocity[k] = x[1][k];
    for (std::size_t order = 0; order < 4; ++order) out[order * n + k] = x[order][k];
  }
  const auto& t = motion_.times;
  const auto passed = static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), row.t) - t.begin());
  const std::size_t edge = row.last ? problem_->edges() - 1 : std::clamp<std::size_t>(passed, 1, problem_->edges()) - 1;
  out[4 * n] = distance_from_edge(position, problem_->points[edge], problem_->points[edge + 1]);
  out[4 * n + 1] = norm(velocity);
}

}  // namespace bahnwerk
