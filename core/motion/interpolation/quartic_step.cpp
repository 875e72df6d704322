#include "core/motion/interpolation/quartic_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/numeric/bisection.hpp"

namespace bahnwerk {
namespace {

/// The equation in units of the first-order step: both sides divided by (l N)².
struct Quartic {
  double a4, a3, a2, a1;  // a0 = −1
  double at(double x) const { return -1 + x * (a1 + x * (a2 + x * (a3 + x * a4))); }
  double slope(double x) const { return a1 + x * (2 * a2 + x * (3 * a3 + x * 4 * a4)); }
};

/// Extrema of f inside (from, end), ascending: at most one between two zeros of its second derivative.
struct Turns {
  std::array<double, 3> at{};
  std::size_t count = 0;
};
Turns turns(const Quartic& f, double from, double end) {
  const double root = std::sqrt(std::max(0.0, 9 * f.a3 * f.a3 - 24 * f.a4 * f.a2)), half = -3 * f.a3;
  std::array<double, 2> bends{(half - root) / (12 * f.a4), (half + root) / (12 * f.a4)};
  if (f.a4 == 0) bends = {-f.a2 / (3 * f.a3), end};
  if (bends[0] > bends[1]) std::swap(bends[0], bends[1]);
  Turns found;
  double low = from;
  for (const double border : {bends[0], bends[1], end}) {
    if (!(border > low && border <= end)) continue;
    const bool rises = f.slope(low) > 0;
    if (rises != (f.slope(border) > 0) && found.count < found.at.size())
      found.at[found.count++] = bisect(low, border, 0, 100, [&](double x) { return (f.slope(x) > 0) == rises; }).low;
    low = border;
  }
  return found;
}

}  // namespace

std::optional<double> quartic_step(const QuotientJet& at, double length, double most) {
  const double reach = length * at.n0, unit = reach / norm(at.z1);
  const Vec z1 = (unit / reach) * at.z1, z2 = (unit * unit / reach) * at.z2;
  const double n1 = unit * at.n1 / at.n0, n2 = unit * unit * at.n2 / at.n0;
  const Quartic f{(dot(z2, z2) - n2 * n2) / 4, dot(z1, z2) - n1 * n2, dot(z1, z1) - n1 * n1 - n2, -2 * n1};

  // The first change of sign: nearly always within one and a half first-order steps.
  const double end = most / unit;
  double low = 0, high = std::min(end, 1.5);
  if (!(f.at(high) >= 0)) {
    const Turns turning = turns(f, 0, end);
    high = 0;
    for (std::size_t i = 0; i <= turning.count && !(f.at(high) >= 0); ++i)
      low = high, high = i < turning.count ? turning.at[i] : end;
    if (!(f.at(high) >= 0)) return std::nullopt;
  }
  double x = std::clamp(1.0, low, high);
  constexpr int most_steps = 100;
  for (int i = 0; i < most_steps; ++i) {
    const double value = f.at(x);
    (value < 0 ? low : high) = x;
    double next = x - value / f.slope(x);
    if (!(next >= low && next <= high)) next = (low + high) / 2;
    const bool done = std::abs(next - x) <= 1e-15 * x;
    x = next;
    if (done) break;
  }
  return std::min(most, unit * x);
}

}  // namespace bahnwerk
