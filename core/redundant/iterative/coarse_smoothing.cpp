#include "core/redundant/iterative/coarse_smoothing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace bahnwerk {
namespace {

constexpr double inside = 1 - 1e-6;  // share of the limits that fits keep

/// Returns the largest quotient of a derivative's control point and its limit.
double use_of_limits(const CoarseTask& task, const FitRows& fit, const std::vector<double>& y) {
  double most = 0;
  for (std::size_t order = 1; order <= std::min<std::size_t>(3, fit.space.degree()); ++order) {
    const double limit = task.limits.of(static_cast<int>(order));
    if (!(limit < unlimited)) continue;
    SplineRow row;
    for (std::size_t i = 0; i + order < fit.space.size(); ++i) {
      if (!fit.space.control(order, i, row)) continue;
      const VariableRow of = fit.ends.reduced(row);
      double sum = of.offset;
      for (std::size_t r = 0; r < of.count; ++r) sum += of.weights[r] * y[of.first + r];
      most = std::max(most, std::abs(sum) / limit);
    }
  }
  return most;
}

}  // namespace

SymmetricBand<> energy(const FitRows& fit, std::vector<double>& linear) {
  constexpr std::array<double, 4> node{-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                       0.8611363115940526};
  constexpr std::array<double, 4> weight{0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                         0.3478548451374538};
  SymmetricBand<> h(fit.ends.variables(), fit.space.degree());
  linear.assign(fit.ends.variables(), 0);
  const std::vector<double>& k = fit.space.knots();
  std::size_t span = 0;
  for (std::size_t i = fit.space.degree(); i < fit.space.size(); ++i) {
    const double half = 0.5 * (k[i + 1] - k[i]), middle = 0.5 * (k[i + 1] + k[i]);
    if (!(half > 0)) continue;
    for (std::size_t q = 0; q < node.size(); ++q) {
      const VariableRow row = fit.ends.reduced(fit.space.at(middle + half * node[q], 2, span));
      h.add(row.first, row.count, row.weights.data(), weight[q] * half);
      for (std::size_t r = 0; r < row.count; ++r)
        linear[row.first + r] += weight[q] * half * row.weights[r] * row.offset;
    }
  }
  return h;
}

std::optional<std::vector<double>> smoothing_spline(const CoarseTask& task, const FitRows& fit,
                                                    const std::function<void()>& tick) {
  std::vector<double> right, linear;
  const SymmetricBand<> normal = fit.normal(task, right), rough = energy(fit, linear);
  const auto at = [&](double ratio) -> std::optional<std::vector<double>> {  // λ/(1 − λ)
    if (tick) tick();
    SymmetricBand<> sum = normal;
    sum.add(rough, ratio);
    if (!sum.factor()) return std::nullopt;
    std::vector<double> y = right;
    for (std::size_t i = 0; i < y.size(); ++i) y[i] -= ratio * linear[i];
    sum.solve(y);
    if (fit.largest_error(task, y) > task.tolerance) return std::nullopt;
    return y;
  };
  constexpr double decade = 10, highest = 8, lowest = -14;
  double exponent = highest;
  std::optional<std::vector<double>> best;
  for (; exponent >= lowest && !best; --exponent) best = at(std::pow(decade, exponent));
  if (!best) return at(0);
  double low = exponent + 1, high = low + 1;
  for (int i = 0; i < 8; ++i) {
    const double middle = 0.5 * (low + high);
    if (auto y = at(std::pow(decade, middle))) {
      best = std::move(y);
      low = middle;
    } else {
      high = middle;
    }
  }
  return best;
}

std::vector<double> relieved(const CoarseTask& task, const FitRows& fit, std::vector<double> y,
                             const std::function<void()>& tick) {
  double least = use_of_limits(task, fit, y);
  if (least <= inside) return y;
  std::vector<double> right, linear;
  const SymmetricBand<> normal = fit.normal(task, right), rough = energy(fit, linear);
  double error_size = 0, rough_size = 0;
  for (std::size_t i = 0; i < normal.size(); ++i) error_size += normal.at(i, i), rough_size += rough.at(i, i);
  if (!(rough_size > 0)) return y;
  const auto at = [&](double exponent) -> std::optional<std::vector<double>> {
    if (tick) tick();
    const double ratio = error_size / rough_size * std::pow(10.0, exponent);
    SymmetricBand<> sum = normal;
    sum.add(rough, ratio);
    if (!sum.factor()) return std::nullopt;
    std::vector<double> z = right;
    for (std::size_t i = 0; i < z.size(); ++i) z[i] -= ratio * linear[i];
    sum.solve(z);
    if (fit.largest_error(task, z) > task.tolerance) return std::nullopt;
    return z;
  };
  constexpr int lowest = -5, highest = 5, halvings = 5;
  std::vector<double> best = y;
  double low = lowest - 1.0, high = low;  // not smooth enough; smooth enough, or out of tolerance
  const auto enough = [&](double exponent) {
    std::optional<std::vector<double>> z = at(exponent);
    if (!z) return true;
    const double use = use_of_limits(task, fit, *z);
    if (use < least || use <= inside) least = use, best = std::move(*z);
    return use <= inside;
  };
  for (int exponent = lowest; exponent <= highest && high == low; ++exponent) {
    if (enough(exponent))
      high = exponent;
    else
      low = high = exponent;
  }
  for (int i = 0; i < halvings && high > low; ++i) {
    const double middle = 0.5 * (low + high);
    (enough(middle) ? high : low) = middle;
  }
  return best;
}

}  // namespace bahnwerk
