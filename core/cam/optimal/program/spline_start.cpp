/// Start of the interior-point method: the smoothest law, units, slacks and multipliers.
#include <algorithm>
#include <cmath>

#include "core/cam/optimal/program/spline_program.hpp"

namespace bahnwerk::cam {

/// Factor that keeps the squares of rows to the order of the equalities.
double SplineProgram::row_weight() const {
  double steepest = 1;
  std::vector<double> weights;
  for (const int order : {1, 2, 3})
    for (std::size_t section = 0; section < task_.sections(); ++section)
      for (const double v : {0.0, 1.0}) {
        law_weights(section, v == 0 ? 0 : basis_.section(section).pieces() - 1, v, order, weights);
        for (const double weight : weights)
          steepest = std::max(steepest, std::abs(weight) / unit_[static_cast<std::size_t>(order)]);
      }
  return 1 / (steepest * steepest);
}

/// Finds the smoothest law with the values and continuity, ranges in their middle, in the sense of least squares.
bool SplineProgram::find_start() {
  set_usual_units();
  add_rows();
  const std::size_t sides = band_.inequality_side().size();
  std::vector<double> weights(sides, row_weight()), target(sides, 0);
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    const std::size_t upper = band_.upper_side(i), lower = band_.lower_side(i);
    const double above = upper != BorderedRow::none ? band_.inequality_side()[upper] : 0;
    const double below = lower != BorderedRow::none ? -band_.inequality_side()[lower] : 0;
    const bool both = upper != BorderedRow::none && lower != BorderedRow::none;
    const double aim = both ? (above + below) / 2 : upper != BorderedRow::none ? above : below;
    constexpr double strong = 1;
    if (upper != BorderedRow::none) weights[upper] = strong, target[upper] = strong * aim;
    if (lower != BorderedRow::none) weights[lower] = strong, target[lower] = -strong * aim;
  }
  if (!band_.factor(weights)) return false;
  const std::size_t variables = band_.band_variables() + band_.borders();
  point_.x.assign(variables, 0);
  point_.y.assign(band_.equality_side().size(), 0);
  std::vector<double> gx(sides), ex(point_.y.size()), x(variables), y(point_.y.size()), push(sides);
  for (int refinement = 0; refinement < 3; ++refinement) {
    band_.multiply(point_.x, gx, ex);
    for (std::size_t i = 0; i < sides; ++i) push[i] = target[i] - weights[i] * gx[i];
    std::fill(x.begin(), x.end(), 0.0);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = -point_.y[i];
    band_.add_transposed(push, y, x);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = band_.equality_side()[i] - ex[i];
    band_.solve(x, y);
    for (std::size_t i = 0; i < variables; ++i) point_.x[i] += x[i];
    for (std::size_t i = 0; i < y.size(); ++i) point_.y[i] += y[i];
  }
  band_.multiply(point_.x, gx, ex);
  double worst = 0;
  for (std::size_t i = 0; i < ex.size(); ++i) worst = std::max(worst, std::abs(ex[i] - band_.equality_side()[i]));
  start_multipliers_ = point_.y;
  std::fill(point_.y.begin(), point_.y.end(), 0.0);
  return worst < 1e-7;
}

void SplineProgram::set_usual_units() {
  for (std::size_t r = 0; r < limited_orders; ++r) unit_[r] = LawTask::usual_peaks[r];
  peak_unit_.assign(task_.groups.count(), unit_);
}

void SplineProgram::set_units(const SplineResult& law) {
  unit_[0] = LawTask::usual_peaks[0];
  if (task_.largest_peak) {  // the limits, in the ratio in which the first law exceeds them
    double most = 0;
    for (std::size_t r = 1; r < limited_orders; ++r) most = std::max(most, task_.weight[r] * law.peaks[r]);
    unit_objective_ = most > 0 ? most : 1;
    for (std::size_t r = 1; r < limited_orders; ++r)
      unit_[r] = counted(static_cast<int>(r)) ? unit_objective_ / task_.weight[r] : LawTask::usual_peaks[r];
    peak_unit_.assign(1, unit_);
    band_.set_border_cost(0, 1);
    return;
  }
  unit_objective_ = 0;
  for (std::size_t r = 1; r < limited_orders; ++r) {
    unit_[r] = LawTask::usual_peaks[r];
    if (!counted(static_cast<int>(r))) continue;
    unit_[r] = std::max(law.peaks[r], 1e-4 * LawTask::usual_peaks[r]);
    for (std::size_t g = 0; g < task_.groups.count(); ++g) {
      peak_unit_[g][r] = std::max(law.group_peaks[g][r], 1e-4 * LawTask::usual_peaks[r]);
      unit_objective_ += task_.groups.weight[g] * task_.weight[r] * peak_unit_[g][r];
    }
  }
  set_peak_costs(1);
}

/// Makes the objective J times a factor.
void SplineProgram::set_peak_costs(double factor) {
  for (std::size_t g = 0; g < task_.groups.count(); ++g)
    for (std::size_t r = 1; r < limited_orders; ++r)
      if (counted(static_cast<int>(r))) band_.set_border_cost(peak_border_[g][r], factor * peak_cost(g, r));
}

/// Sets the shared peaks to `factor` times those of a law.
void SplineProgram::set_peaks(const SplineResult& law, double factor) {
  double most = 0;
  for (std::size_t r = 1; r < limited_orders; ++r)
    if (counted(static_cast<int>(r))) most = std::max(most, law.peaks[r] / unit_[r]);
  for (std::size_t g = 0; g < task_.groups.count(); ++g)
    for (std::size_t r = 1; r < limited_orders; ++r)
      if (counted(static_cast<int>(r)))
        point_.x[band_.border_index(peak_border_[g][r])] =
            factor * (task_.largest_peak ? most : law.group_peaks[g][r] / peak_unit_[g][r]);
}

/// Starts with the first law, peaks above its own, `above` times as far, and multipliers of one complementarity.
/// Farther inside, where slacks differ little, the multipliers' sum is that of the costs.
void SplineProgram::center(double above) {
  point_.x = start_;
  for (std::size_t k = band_.band_variables(); k < point_.x.size(); ++k) point_.x[k] *= above;
  std::fill(point_.y.begin(), point_.y.end(), 0.0);
  for (Sampled& sampled : samples_) sampled.upper = sampled.lower = -1;
  for (Sampled& sampled : range_state_) sampled.upper = sampled.lower = -1;
  double mu = 0.2 / static_cast<double>(std::max<std::size_t>(1, band_.rows()));
  if (above > 1) {
    const std::vector<double>& g = band_.inequality_side();
    std::vector<double> gx(g.size()), ex(point_.y.size());
    band_.multiply(point_.x, gx, ex);
    double sum = 0;
    for (std::size_t i = 0; i < g.size(); ++i) sum += 1 / std::max(g[i] - gx[i], 1e-3);
    mu = 1 / sum;
  }
  set_point(mu);
}

/// Sets slacks and multipliers for the rows as they are: a row keeps its own, a new one gets s z = mu.
void SplineProgram::set_point(double mu) {
  const std::vector<double>& g = band_.inequality_side();
  std::vector<double> gx(g.size()), ex(point_.y.size());
  band_.multiply(point_.x, gx, ex);
  point_.s.assign(g.size(), 0);
  point_.z.assign(g.size(), 0);
  const auto set = [&](std::size_t side, double multiplier) {
    if (side == BorderedRow::none) return;
    double& slack = point_.s[side];
    slack = std::max(g[side] - gx[side], std::sqrt(mu) * 1e-2);
    const double centred = mu / slack;
    point_.z[side] = multiplier < 0 ? centred : std::max(multiplier, 0.1 * centred);
    // A large multiplier stays: the dual residual of a smaller one would be of its size, that of a row is tiny.
    if (point_.z[side] > 10 * centred) slack = 10 * mu / point_.z[side];
  };
  static const Sampled unknown{};
  for (std::size_t row = 0; row < band_.rows(); ++row) {
    const Sampled& from = row >= fixed_rows() + samples_.size() ? unknown
                          : row < fixed_rows()                  ? range_state_[row]
                                                                : samples_[row - fixed_rows()];
    set(band_.upper_side(row), from.upper);
    set(band_.lower_side(row), from.lower);
  }
}

}  // namespace bahnwerk::cam
