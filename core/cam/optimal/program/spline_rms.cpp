/// The second objective: the least RMS value of a derivative among the laws of least J.
#include <algorithm>
#include <cmath>

#include "core/base/progress.hpp"
#include "core/cam/optimal/program/spline_program.hpp"
#include "core/cam/optimal/task/extrema.hpp"
#include "core/numeric/gauss_legendre.hpp"

namespace bahnwerk::cam {
namespace {

constexpr double above = 1e-9;      // part of J that the second objective may cost
constexpr double tolerance = 3e-9;  // what the samples of a program may leave of it, beside the gap of the first one

}  // namespace

/// Adds ½ of the mean square of s^(order) to the objective, in parts of its value at the current law: by Gauss-Legendre
/// quadrature, which is exact for these degrees.
void SplineProgram::add_squares(int order) {
  const double scale = 1 / std::sqrt(std::max(mean_square(order), 1e-300) * task_.cycle);
  std::vector<double> weights;
  for (std::size_t section = 0; section < task_.sections(); ++section) {
    if (task_.is_given(section)) continue;
    for (std::size_t piece = 0; piece < basis_.section(section).pieces(); ++piece) {
      const double length = lengths_[section] * basis_.section(section).length(piece);
      for (const auto& [place, weight] : gauss_legendre<20>()) {
        law_weights(section, piece, (1 + place) / 2, order, weights);
        for (double& each : weights) each *= scale * std::sqrt(weight / 2 * length);
        BorderedRow row;
        set_row(section, weights, row);
        band_.add_square(row.first, row.weights);
      }
    }
  }
}

/// Returns the mean square of s^(order) of the current law over its free sections, in parts of the cycle.
double SplineProgram::mean_square(int order) const {
  double sum = 0;
  for (std::size_t section = 0; section < task_.sections(); ++section) {
    if (task_.is_given(section)) continue;
    for (std::size_t piece = 0; piece < basis_.section(section).pieces(); ++piece) {
      const double length = lengths_[section] * basis_.section(section).length(piece);
      const std::vector<double> b = derivative(section, piece, order);
      for (const auto& [place, weight] : gauss_legendre<20>()) {
        const double value = evaluate_bernstein(b, (1 + place) / 2);
        sum += weight / 2 * length * value * value;
      }
    }
  }
  return sum / task_.cycle;
}

SplineResult SplineProgram::least_rms(int order, const SplineResult& first, Progress progress) {
  constexpr int most_rounds = 15;
  initial_samples();
  initial_ = samples_.size();
  for (const LawSample& sample : first.samples) samples_.push_back({sample});
  point_.x.assign(band_.band_variables() + band_.borders(), 0);
  const std::vector<double> x = variables(first.coefficients);
  std::copy(x.begin(), x.end(), point_.x.begin());
  point_.y.assign(band_.equality_side().size(), 0);
  SplineResult result = first, best = first;
  set_usual_units();
  add_rows();
  evaluate(result, false);  // finds the extrema and the peaks of the first law
  set_units(result);
  set_peak_costs(0);
  objective_limit_ = (1 + above) * first.objective / unit_objective_;
  set_peaks(result, 1 + above / 2);
  add_rows();
  double least = mean_square(order);
  if (std::sqrt(least) < 1e-9 * LawTask::usual_peaks[order]) return first;  // a straight line but for rounding
  add_squares(order);
  for (const LawSample& sample : found_) samples_.push_back({sample});
  add_rows();
  set_point(1e-4 / static_cast<double>(std::max<std::size_t>(1, band_.rows())));
  double last = least;
  for (int round = 0; round < most_rounds; ++round) {
    InteriorPointOptions interior;
    interior.gap = 1e-9;
    interior.primal_residual = 1e-11;
    interior.dual_residual = 1e-8;
    interior.common_step = true;
    interior.max_iterations = 60;
    interior.tick = [&] { progress.report("second objective", 0); };
    solve_interior_point(band_, point_, interior);
    settle_equalities();
    evaluate(result, false);
    const double now = mean_square(order);
    if (!std::isfinite(now)) break;
    const bool holds = result.violation <= std::max(1e-10, first.violation) &&
                       result.objective <= first.objective * (1 + above + tolerance);
    if (holds && now < least) {
      least = now;
      best.coefficients = coefficients(point_.x);
      best.objective = result.objective;
      best.peaks = result.peaks;
      best.violation = result.violation;
    }
    if (holds && std::abs(now - last) <= 1e-7 * now) break;
    last = now;
    exchange();
    add_rows();
    set_point(1e-7 / static_cast<double>(point_.s.size()));
  }
  return best;
}

}  // namespace bahnwerk::cam
