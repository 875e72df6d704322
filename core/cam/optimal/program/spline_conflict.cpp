/// Why no law exists: the least violation of ranges and limits.
#include <algorithm>
#include <cmath>

#include "core/base/progress.hpp"
#include "core/cam/optimal/program/spline_program.hpp"

namespace bahnwerk::cam {

LawConflict SplineProgram::find_conflict(Progress progress) {
  LawConflict conflict;
  initial_samples();
  if (!find_start()) {
    // The multipliers of a contradiction grow along the null vector of the conditions.
    conflict.values = true;
    double most = 0;
    for (const double y : start_multipliers_) most = std::max(most, std::abs(y));
    for (std::size_t i = 0; i < start_multipliers_.size(); ++i) {
      if (!(std::abs(start_multipliers_[i]) > 1e-3 * most)) continue;
      if (equality_condition_[i] != BorderedRow::none) conflict.conditions.push_back(equality_condition_[i]);
      if (i >= left_out_.size()) continue;
      for (const std::size_t section : left_out_[i])
        for (std::size_t c = 0; c < task_.conditions.size(); ++c)
          if (const LawTask::Condition& each = task_.conditions[c];
              each.point == section && each.range.fixed() && each.order < static_cast<int>(SectionBasis::states))
            conflict.conditions.push_back(c);
    }
    std::sort(conflict.conditions.begin(), conflict.conditions.end());
    conflict.conditions.erase(std::unique(conflict.conditions.begin(), conflict.conditions.end()),
                              conflict.conditions.end());
    return conflict;
  }
  SplineResult law;
  evaluate(law, false);
  const std::vector<double> smooth(point_.x.begin(),
                                   point_.x.begin() + static_cast<std::ptrdiff_t>(band_.band_variables()));
  give_ = band_.add_border(1);
  set_units(law);
  const SplineResult smooth_law = law;
  constexpr double little = 1e-4;  // cost of the peaks, for a law that is bounded
  set_peak_costs(little);
  double give = 1 + 2 * law.violation;
  InteriorPointOptions interior;
  interior.gap = 1e-6;
  interior.primal_residual = interior.dual_residual = 1e-7;
  interior.tick = [&] { progress.report("optimal law", 0); };
  for (int round = 0; round < 4; ++round) {
    add_rows();
    point_.x.assign(band_.band_variables() + band_.borders(), 0);
    std::copy(smooth.begin(), smooth.end(), point_.x.begin());
    std::fill(point_.y.begin(), point_.y.end(), 0.0);
    set_peaks(smooth_law, 1.2);
    const std::vector<double>& g = band_.inequality_side();
    std::vector<double> gx(g.size()), ex(point_.y.size());
    band_.multiply(point_.x, gx, ex);
    for (std::size_t i = 0; i < g.size(); ++i) give = std::max(give, 1.1 * (gx[i] - g[i]));
    point_.x[band_.border_index(give_)] = give;
    for (Sampled& sampled : samples_) sampled.upper = sampled.lower = -1;
    for (Sampled& sampled : range_state_) sampled.upper = sampled.lower = -1;
    set_point(0.2 * (1 + give) / static_cast<double>(std::max<std::size_t>(1, band_.rows())));
    solve_interior_point(band_, point_, interior);
    conflict.violation = point_.x[band_.border_index(give_)];
    evaluate(law, false);
    if (conflict.violation > 1e-3) break;
    exchange();
  }
  double most = 0;
  for (const double z : point_.z) most = std::max(most, z);
  const auto taken = [&](std::size_t row) {
    for (const std::size_t side : {band_.upper_side(row), band_.lower_side(row)})
      if (side != BorderedRow::none && point_.z[side] > 1e-2 * most) return true;
    return false;
  };
  for (std::size_t i = 0; i < ranges_.size(); ++i)
    if (taken(i)) conflict.conditions.push_back(ranges_[i]);
  for (std::size_t i = 0; i < samples_.size() && fixed_rows() + i < band_.rows(); ++i) {
    const LawSample& sample = samples_[i].sample;
    const std::pair<std::size_t, int> limit{sample.section, sample.order};
    if (sample.limit && taken(fixed_rows() + i) &&
        std::find(conflict.limits.begin(), conflict.limits.end(), limit) == conflict.limits.end())
      conflict.limits.push_back(limit);
  }
  return conflict;
}

}  // namespace bahnwerk::cam
