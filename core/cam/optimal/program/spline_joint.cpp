/// A step in coefficients and angles together.
#include <algorithm>

#include "core/base/progress.hpp"
#include "core/cam/optimal/program/spline_program.hpp"

namespace bahnwerk::cam {

JointStep SplineProgram::joint_step(const std::vector<LawSample>& samples, Progress progress) {
  initial_samples();
  for (const LawSample& sample : samples) samples_.push_back({sample});
  // The law at the times as they are is the start: it keeps all rows, with peaks above its own.
  point_.x.assign(band_.band_variables() + band_.borders(), 0);
  std::copy(reference_x_.begin(), reference_x_.end(), point_.x.begin());
  point_.y.assign(band_.equality_side().size(), 0);
  SplineResult law;
  set_usual_units();
  add_rows();
  evaluate(law, false);
  set_units(law);
  set_peaks(law, 1.1);
  add_rows();
  for (std::size_t i = 0; i < task_.points(); ++i) {
    if (time_border_[i] == BorderedRow::none) continue;
    const BorderedRow::Term change[] = {{time_border_[i], 1}};
    BorderedRow row;
    row.border = change;
    const double radius = reference_->radius[i];
    row.lower = std::max(-1.0, (task_.at[i].min - times_[i]) / radius);
    row.upper = std::min(1.0, (task_.at[i].max - times_[i]) / radius);
    band_.add_row(row);
    point_.x[band_.border_index(time_border_[i])] = std::clamp((row.lower + row.upper) / 2, -0.2, 0.2);
  }
  range_state_.resize(fixed_rows());
  set_point(0.05 / static_cast<double>(band_.rows()));
  InteriorPointOptions interior;
  interior.gap = 1e-8;
  interior.primal_residual = interior.dual_residual = 1e-8;
  interior.max_iterations = 50;
  interior.tick = [&] { progress.report("optimal law", 0); };
  const InteriorPointResult inner = solve_interior_point(band_, point_, interior);
  JointStep step;
  step.converged = inner.gap < 1e-3 && inner.primal_residual < 1e-4;
  step.times = times_;
  for (std::size_t i = 0; i < task_.points(); ++i)
    if (time_border_[i] != BorderedRow::none)
      step.times[i] = std::clamp(times_[i] + reference_->radius[i] * point_.x[band_.border_index(time_border_[i])],
                                 task_.at[i].min, task_.at[i].max);
  if (task_.largest_peak) step.objective = unit_objective_ * point_.x[band_.border_index(0)];
  for (std::size_t g = 0; g < task_.groups.count() && !task_.largest_peak; ++g)
    for (std::size_t r = 1; r < limited_orders; ++r)
      if (counted(static_cast<int>(r)))
        step.objective += unit_objective_ * peak_cost(g, r) * point_.x[band_.border_index(peak_border_[g][r])];
  return step;
}

}  // namespace bahnwerk::cam
