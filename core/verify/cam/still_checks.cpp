#include "core/verify/cam/still_checks.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "core/verify/cam/law_polynomial.hpp"
#include "core/verify/cam/law_verifier.hpp"

namespace bahnwerk::verify {
namespace {

/// Romberg's rule over trapezoids with n, 2n … 32n steps, of which one turns the mode by half a radian at most: errors
/// are below 1e-9 of the integrand's peak times the interval for accelerations up to degree 19.
std::complex<double> response(const std::vector<double>& a, double begin, double duration, std::complex<double> rate,
                              double until) {
  const auto value = [&](double x) { return bernstein_sum(a, x) * std::exp(rate * (begin + x * duration - until)); };
  constexpr int levels = 6;
  int steps = std::max(8, static_cast<int>(std::ceil(std::abs(rate) * duration / 0.5)));
  std::complex<double> row[levels];
  for (int level = 0; level < levels; ++level, steps *= 2) {
    std::complex<double> sum = 0;  // sum over the places that the level before lacks
    if (level == 0) sum = (value(0) + value(1)) / 2.0;
    for (int k = 1; k < steps; k += level == 0 ? 1 : 2) sum += value(static_cast<double>(k) / steps);
    std::complex<double> now = sum / static_cast<double>(steps) + (level == 0 ? 0 : row[0] / 2.0);
    double power = 1;
    for (int k = 0; k < level; ++k) {
      power *= 4;
      const std::complex<double> better = now + (now - row[k]) / (power - 1);
      row[k] = now;
      now = better;
    }
    row[level] = now;
  }
  return row[levels - 1] * duration;
}

}  // namespace

void check_still_points(const cam::MotionLawProblem& problem, const LawToVerify& law, Verification& out) {
  std::vector<std::size_t> still;
  for (std::size_t p = 0; p < problem.points.size(); ++p)
    if (problem.points[p].still) still.push_back(p);
  if (still.empty() || problem.vibration.empty()) return;
  constexpr double tolerance = 1e-7;
  Check worst{named(CheckGroup::limit, "residual vibration", ""), tolerance, 0, 0, true};
  const double scale = law.cycle_duration / problem.length;
  for (std::size_t k = 0; k < still.size(); ++k) {
    const bool wraps = k + 1 == still.size();
    if (wraps && !problem.periodic) break;
    const double from = law.at[still[k]] * scale;
    const double to = wraps ? law.at[still[0]] * scale + law.cycle_duration : law.at[still[k + 1]] * scale;
    for (const cam::VibrationMode& mode : problem.vibration) {
      const double omega = 2 * std::numbers::pi * mode.frequency;
      const std::complex<double> rate(mode.damping * omega, omega * std::sqrt(1 - mode.damping * mode.damping));
      std::complex<double> sum = 0;
      for (int turn = 0; turn < 2; ++turn)
        for (std::size_t i = 0; i < law.bernstein.size(); ++i) {
          const double begin = law.breaks[i] + turn * law.cycle_duration,
                       end = law.breaks[i + 1] + turn * law.cycle_duration;
          if (turn == 1 && !problem.periodic) continue;
          if (begin < from - 1e-9 * law.cycle_duration || end > to + 1e-9 * law.cycle_duration) continue;
          sum += response(derivative_coefficients(law.bernstein[i], end - begin, 2), begin, end - begin, rate, to);
        }
      const double left = std::abs(sum) * omega / std::max(law.peaks[2], 1e-300);
      if (left > worst.value) worst.value = left, worst.at = to;
    }
  }
  worst.passed = worst.value <= worst.limit;
  out.add(std::move(worst));
}

}  // namespace bahnwerk::verify
