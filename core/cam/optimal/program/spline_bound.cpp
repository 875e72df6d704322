/// The lower bound by weak duality, and what rounding takes from equalities and multipliers.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/cam/optimal/program/spline_program.hpp"

namespace bahnwerk::cam {

double position_bound(const LawTask& task, double upper) {
  double position = -1, velocity = -1, acceleration = -1;
  std::vector<std::pair<double, double>> known;  // time, |s| at most
  for (const LawTask::Condition& condition : task.conditions) {
    const double most = std::max(std::abs(condition.range.min), std::abs(condition.range.max));
    if (!std::isfinite(most)) continue;
    if (condition.order == 0) position = most;
    if (condition.order == 1) velocity = most;
    if (condition.order == 2) acceleration = most;
  }
  if (position < 0) return 0;
  const double t = task.cycle;
  upper /= task.groups.least_weight();  // what a weighted sum of peaks is at most, no peak exceeds
  if (task.weight[1] > 0) return position + upper / task.weight[1] * t;
  if (task.periodic) {  // such a law has its mean velocity somewhere, and no acceleration somewhere
    velocity = std::abs(task.travel) / t;
    acceleration = 0;
  }
  if (velocity < 0) return 0;
  if (task.weight[2] > 0) return position + (velocity + upper / task.weight[2] * t) * t;
  if (acceleration < 0 || !(task.weight[3] > 0)) return 0;
  return position + (velocity + (acceleration + upper / task.weight[3] * t) * t) * t;
}

/// Changes the multipliers least, in the last factors' measure, so that they become dual feasible but for rounding, as
/// long as the bound grows by it. Returns the bound.
double SplineProgram::settle_multipliers(const SplineResult& law) {
  std::vector<double> gx(point_.z.size()), ex(point_.y.size()), y(point_.y.size());
  double bound = lower_bound(law);
  for (int refinement = 0; refinement < 3; ++refinement) {
    const std::vector<double> last_y = point_.y, last_z = point_.z;
    DualValue dual = dual_value(band_, point_.y, point_.z);
    for (double& value : dual.residual) value = -value;
    std::fill(y.begin(), y.end(), 0.0);
    solve_refined(band_, band_.weights(), dual.residual, y);
    band_.multiply(dual.residual, gx, ex);
    for (std::size_t i = 0; i < point_.z.size(); ++i)
      point_.z[i] = std::max(point_.z[i] * 1e-3, point_.z[i] + band_.weights()[i] * gx[i]);
    for (std::size_t i = 0; i < y.size(); ++i) point_.y[i] += y[i];
    const double now = lower_bound(law);
    if (!(now > bound)) {  // rounding, or factors that failed
      point_.y = last_y;
      point_.z = last_z;
      break;
    }
    bound = now;
  }
  return bound;
}

/// Returns by order how much a law with a J that is not above the current one's may differ from it anywhere; infinite
/// where nothing limits that. A peak that counts is limited by J; else a derivative that is a number somewhere, or has
/// mean 0, changes no more than its own derivative allows.
std::array<double, limited_orders> SplineProgram::differences(const SplineResult& law) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::array<double, limited_orders> out{};
  out.fill(infinity);
  int smooth = limited_orders;  // order up to which derivatives are continuous
  for (std::size_t p = 0; p < task_.points(); ++p)
    if (task_.joint(p)) smooth = std::min(smooth, task_.continuity[p]);
  std::size_t positions = 0;
  for (const LawTask::Condition& condition : task_.conditions)
    if (condition.order == 0 && condition.range.fixed()) ++positions;
  for (std::size_t r = limited_orders - 1; r > 0; --r) {
    const bool known =
        task_.periodic || positions > r ||
        std::any_of(task_.conditions.begin(), task_.conditions.end(), [&](const LawTask::Condition& condition) {
          return condition.order == static_cast<int>(r) && condition.range.fixed();
        });
    if (counted(static_cast<int>(r)))
      out[r] = law.objective / (task_.groups.least_weight() * task_.weight[r]) + law.peaks[r];
    else if (r + 1 < limited_orders && known && smooth >= static_cast<int>(r))
      out[r] = task_.cycle * out[r + 1];
  }
  double bound = position_bound(task_, law.objective);
  for (std::size_t i = 0; i < basis_.size() && bound == 0; ++i) bound = std::max(bound, 1e3 * std::abs(point_.x[i]));
  out[0] = 2 * bound;
  return out;
}

/// Returns how far a law may be from the current one inside a section if their velocities differ by `speed` at most:
/// both pass the nearest position that is known.
double SplineProgram::reach(std::size_t section, double speed) const {
  double least = std::numeric_limits<double>::infinity();
  for (const LawTask::Condition& condition : task_.conditions) {
    if (condition.order != 0 || !std::isfinite(condition.range.max - condition.range.min)) continue;
    for (const double cycles : {-1.0, 0.0, 1.0}) {
      if (cycles != 0 && !task_.periodic) continue;
      const double at = times_[condition.point] + cycles * task_.cycle;
      const double far = std::max(std::abs(breaks_[section] - at), std::abs(breaks_[section + 1] - at));
      least = std::min(least, condition.range.max - condition.range.min + speed * far);
    }
  }
  return least;
}

/// Returns a bound by weak duality: cᵀx ≥ value + residualᵀx for every x that is feasible. The residual's worth is
/// taken at the current law, less the largest difference of another law from it: that of the highest derivative that is
/// limited, as a sum of its values at points, and of the states below it.
double SplineProgram::lower_bound(const SplineResult& law) const {
  const DualValue dual = dual_value(band_, point_.y, point_.z);
  double bound = dual.value;
  std::array<double, limited_orders> apart = differences(law);
  std::size_t order = 0;
  while (order + 1 < limited_orders && std::isfinite(apart[order + 1])) ++order;
  std::map<const SectionBasis*, Eigen::PartialPivLU<Eigen::MatrixXd>> factors;  // factors of collocation matrices
  std::vector<double> weights;
  for (std::size_t section = 0; section < task_.sections(); ++section) {
    if (task_.is_given(section)) continue;  // the variables of a given section are 0
    const SectionBasis& basis = basis_.section(section);
    const auto size = static_cast<Eigen::Index>(basis.size() - order);
    auto known = factors.find(&basis);
    if (known == factors.end()) {
      Eigen::MatrixXd collocation(size, size);
      weights.resize(basis.size());
      const std::vector<double> sites = basis.sites(order);
      std::size_t piece = 0;
      for (Eigen::Index j = 0; j < size; ++j) {
        const double u = sites[static_cast<std::size_t>(j)];
        while (piece + 1 < basis.pieces() && u >= basis.begin(piece + 1)) ++piece;
        basis.weights(piece, (u - basis.begin(piece)) / basis.length(piece), order, weights.data());
        for (Eigen::Index k = 0; k < size; ++k) collocation(k, j) = weights[order + static_cast<std::size_t>(k)];
      }
      known = factors.emplace(&basis, collocation).first;
    }
    const double* const residual = dual.residual.data() + basis_.first(section);
    const double* const here = point_.x.data() + basis_.first(section);
    const double length = lengths_[section];
    const double reached = std::isfinite(apart[1]) ? std::min(apart[0], reach(section, apart[1])) : apart[0];
    Eigen::VectorXd own(size);
    for (std::size_t k = 0; k < basis.size(); ++k) {
      bound += residual[k] * here[k];
      const double by_coefficient = residual[k] / coefficient_of_variable(length, k);
      if (k >= order)
        own(static_cast<Eigen::Index>(k - order)) = by_coefficient;
      else
        bound -= std::abs(by_coefficient) * std::pow(length, k) * (k == 0 ? reached : apart[k]);
    }
    bound -= known->second.solve(own).lpNorm<1>() * std::pow(length, order) * (order == 0 ? reached : apart[order]);
  }
  for (std::size_t g = 0; g < task_.groups.count(); ++g)
    for (std::size_t r = 1; r < limited_orders; ++r)
      if (counted(static_cast<int>(r))) {
        bound -= std::max(0.0, -dual.residual[band_.border_index(peak_border_[g][r])]) * law.objective /
                 (unit_objective_ * peak_cost(g, r));  // peaks are not negative
        if (task_.largest_peak) break;
      }
  return bound * unit_objective_;
}

/// Takes out with the last factors what is missing in the equalities, whose multipliers may be large.
void SplineProgram::settle_equalities() {
  std::vector<double> gx(band_.inequality_side().size()), ex(point_.y.size()), x(point_.x.size());
  std::vector<double> kept;
  double least = std::numeric_limits<double>::infinity();
  for (int refinement = 0;; ++refinement) {
    band_.multiply(point_.x, gx, ex);
    double worst = 0;
    for (std::size_t i = 0; i < ex.size(); ++i) {
      ex[i] = band_.equality_side()[i] - ex[i];
      worst = std::max(worst, std::abs(ex[i]));
    }
    if (!(worst < least)) {  // rounding, or factors that failed
      if (!kept.empty()) point_.x = std::move(kept);
      return;
    }
    if (refinement == 6) return;
    least = worst;
    kept = point_.x;
    std::fill(x.begin(), x.end(), 0.0);
    band_.solve(x, ex);
    for (std::size_t i = 0; i < band_.band_variables(); ++i) point_.x[i] += x[i];
  }
}

/// Takes out the residuals that the interior-point method has left by the smoothest change: those of equalities where
/// its last factors were bad, and those of ranges and of limits at their samples, by as little as a program may.
void SplineProgram::settle_points() {
  constexpr double rounding = 1e-13, strong = 1e4;  // a row that is taken in weighs as much as many others
  const std::vector<double>& g = band_.inequality_side();
  std::vector<double> gx(g.size()), ex(point_.y.size()), x(point_.x.size()), y(point_.y.size());
  const std::vector<double> none(point_.y.size(), 0);
  std::vector<double> weights(g.size(), row_weight());
  for (int pass = 0; pass < 3; ++pass) {
    band_.multiply(point_.x, gx, ex);
    bool off = false;
    for (std::size_t i = 0; i < ex.size(); ++i) {
      y[i] = band_.equality_side()[i] - ex[i];
      off = off || std::abs(y[i]) > rounding;
    }
    std::vector<double> push(g.size(), 0);
    const auto settle = [&](std::size_t row) {
      for (const std::size_t side : {band_.upper_side(row), band_.lower_side(row)}) {
        if (side == BorderedRow::none || !(gx[side] - g[side] > rounding)) continue;
        weights[side] = strong;
        push[side] = strong * (g[side] - gx[side]);
        off = true;
      }
    };
    for (std::size_t i = 0; i < ranges_.size(); ++i) settle(i);
    for (std::size_t i = 0; i < samples_.size(); ++i)
      if (samples_[i].sample.limit) settle(fixed_rows() + i);
    if (!off || !band_.factor(weights)) return;
    std::fill(x.begin(), x.end(), 0.0);
    band_.add_transposed(push, none, x);
    solve_refined(band_, weights, x, y);
    for (std::size_t i = 0; i < band_.band_variables(); ++i) point_.x[i] += x[i];
  }
  settle_equalities();
}

}  // namespace bahnwerk::cam
