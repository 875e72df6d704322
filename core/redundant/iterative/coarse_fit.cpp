#include "core/redundant/iterative/coarse_fit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/redundant/iterative/approximation.hpp"
#include "core/redundant/iterative/band_program.hpp"
#include "core/redundant/iterative/coarse_smoothing.hpp"

namespace bahnwerk {
namespace {

constexpr double inside = 1 - 1e-6;      // share of the limits that programs keep
constexpr double violation_price = 1e3;  // price of an excess of all limits, in units of the fit's energy
constexpr double noise = 1e-4;           // relative excess of limits that counts as rounding

/// Scales the problem: positions are counted from the first one in units of the tolerance, and limits are 1.
class Programs {
 public:
  Programs(const CoarseTask& task, const FitRows& fit, const CoarseFitOptions& options)
      : task_(task), fit_(fit), options_(options), middle_(task.positions.front()), scale_(task.tolerance) {}

  std::optional<std::vector<double>> quadratic(const std::vector<double>& start, bool& limits_met) const {
    std::vector<double> linear;
    SymmetricBand<> h = energy(fit_, linear);
    BandProgram program = positions();
    for (std::size_t order = 1; order <= 3; ++order) limits(program, order, 1);
    // The energy is relative to that of the start; the linear part, which fixed control points leave, becomes one more
    // row.
    const std::vector<double> y = scaled(start);
    std::vector<double> hy(y.size(), 0.0);
    h.multiply(y, hy);
    double size = 0;
    for (std::size_t i = 0; i < y.size(); ++i) size += y[i] * hy[i];
    if (!(size > 0)) size = 1;
    program.quadratic.add(h, 1 / size);
    program.linear = linear_part(h, linear, size);
    program.price = violation_price;
    const BandSolution s = solve(program, y, program_options());
    limits_met = s.w <= noise;
    return back(s);
  }

  std::optional<std::vector<double>> linear(const std::vector<double>& start, bool& limits_met) const {
    for (const bool with_velocity : {true, false}) {
      BandProgram program = positions();
      limits(program, 2, 0);
      if (with_velocity) limits(program, 1, -1);
      if (with_velocity) limits(program, 3, -1);
      program.price = 1;
      const BandSolution s = solve(program, scaled(start), program_options());
      if (auto y = back(s)) {
        limits_met = with_velocity && s.w <= 1;
        return y;
      }
    }
    return std::nullopt;
  }

 private:
  BandProgramOptions program_options() const {
    BandProgramOptions o;
    o.tick = options_.tick;
    return o;
  }

  std::vector<double> scaled(const std::vector<double>& y) const {
    std::vector<double> z = y;
    for (double& v : z) v = (v - middle_) / scale_;
    return z;
  }

  std::optional<std::vector<double>> back(const BandSolution& s) const {
    std::vector<double> y = s.y;
    for (double& v : y) v = middle_ + scale_ * v;
    if (!(fit_.largest_error(task_, y) <= task_.tolerance * (1 + 1e-6))) return std::nullopt;
    return y;
  }

  /// Returns the row of the scaled variables for `row`, whose variables are in mm, with its constant in `offset`.
  static double constant(const VariableRow& row, double middle) {
    double sum = row.offset;
    for (std::size_t r = 0; r < row.count; ++r) sum += row.weights[r] * middle;
    return sum;
  }

  std::vector<double> linear_part(const SymmetricBand<>& h, const std::vector<double>& linear, double size) const {
    std::vector<double> shift(linear.size(), middle_), g(linear.size(), 0.0);
    h.multiply(shift, g);  // rows at the ends only: f″ of a constant is 0
    for (std::size_t i = 0; i < g.size(); ++i) g[i] = (g[i] + linear[i]) / (scale_ * size);
    return g;
  }

  BandProgram positions() const {
    BandProgram program{SymmetricBand<>(fit_.ends.variables(), fit_.space.degree()), {}, {}, 0};
    program.rows.reserve(2 * fit_.rows.size());
    const double step = task_.time(1), bulge = task_.limits.acceleration * step * step / 8;
    const double between = std::min(bulge, 0.25 * (task_.limits.highest - task_.limits.lowest));
    for (std::size_t i = 0; i < fit_.rows.size(); ++i) {
      const VariableRow& row = fit_.rows[i];
      const double place = constant(row, middle_), x = task_.positions[i + 1], give = inside * scale_;
      // Where the tool's path permits, the spline also stays within the coarse axis' range, between samples as well.
      const double lowest = std::clamp(task_.limits.lowest + between, x - give, x + give),
                   highest = std::clamp(task_.limits.highest - between, x - give, x + give);
      program.rows.push_back(
          {row, (std::max(x - give, lowest) - place) / scale_, (std::min(x + give, highest) - place) / scale_, 0});
    }
    return program;
  }

  /// Adds |derivative| ≤ limit. `elastic` > 0 is the row's elasticity; 0 stands for ≤ w limits; < 0 makes the row hard.
  void limits(BandProgram& program, std::size_t order, double elastic) const {
    const double limit = task_.limits.of(static_cast<int>(order));
    if (!(limit < unlimited) || order > fit_.space.degree()) return;
    const auto add = [&](const SplineRow& spline_row) {
      VariableRow row = fit_.ends.reduced(spline_row);
      if (row.count == 0) return;
      const double fixed = constant(row, middle_) / limit;
      for (std::size_t r = 0; r < row.count; ++r) row.weights[r] *= scale_ / limit;
      const double most = elastic == 0 ? 0 : inside;
      program.rows.push_back({row, -most - fixed, most - fixed, elastic < 0 ? 0 : elastic == 0 ? 1 : elastic});
    };
    if (options_.sampled_limits) {
      std::size_t span = 0;
      for (std::size_t i = 0; i < task_.positions.size(); ++i) add(fit_.space.at(task_.time(i), order, span));
    } else {
      SplineRow row;
      for (std::size_t i = 0; i + order < fit_.space.size(); ++i)
        if (fit_.space.control(order, i, row)) add(row);
    }
  }

  const CoarseTask& task_;
  const FitRows& fit_;
  const CoarseFitOptions& options_;
  double middle_, scale_;
};

}  // namespace

std::optional<CoarseFit> fit_coarse(const CoarseTask& task, const CoarseFitOptions& options) {
  std::optional<Approximation> a = approximate(task, options);
  if (!a) return std::nullopt;
  CoarseFit fit;
  std::optional<std::vector<double>> y;
  if (options.smoothing == CoarseSmoothing::smoothing_spline) {
    y = smoothing_spline(task, a->rows, options.tick);
    if (!y && options.approximation != CoarseApproximation::least_squares) {
      // With knots of another approximation, least squares (λ = 0) need not be within tolerance [Bock 4.3.1].
      CoarseFitOptions own = options;
      own.approximation = CoarseApproximation::least_squares;
      if (std::optional<Approximation> b = approximate(task, own)) {
        a = std::move(b);
        y = smoothing_spline(task, a->rows, options.tick);
      }
    }
  } else if (options.smoothing == CoarseSmoothing::quadratic_program) {
    y = Programs(task, a->rows, options).quadratic(a->variables, fit.limits_met);
  } else if (options.smoothing == CoarseSmoothing::linear_program) {
    y = Programs(task, a->rows, options).linear(a->variables, fit.limits_met);
  } else if (options.approximation == CoarseApproximation::least_squares) {
    y = relieved(task, a->rows, a->variables, options.tick);
  }
  if (!y) y = std::move(a->variables);
  fit.error = a->rows.largest_error(task, *y);
  fit.knots = a->knots;
  fit.spline = a->rows.space.spline(a->rows.ends.controls(*y));
  return fit;
}

}  // namespace bahnwerk
