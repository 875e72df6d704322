#include "core/verify/cam/textbook_laws.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/verify/cam/law_polynomial.hpp"
#include "core/verify/cam/law_verifier.hpp"

namespace bahnwerk::verify {
namespace {

using cam::ClassicalLaw;
constexpr double pi = std::numbers::pi;

double symmetric(ClassicalLaw law, double z) {
  const double harmonic = 2 * pi * z;
  switch (law) {
    case ClassicalLaw::polynomial_345:
      return z * z * z * (10 + z * (-15 + 6 * z));
    case ClassicalLaw::polynomial_4567:
      return z * z * z * z * (35 + z * (-84 + z * (70 - 20 * z)));
    case ClassicalLaw::modified_sine:
      if (z < 0.125) return (pi * z - std::sin(4 * pi * z) / 4) / (4 + pi);
      if (z > 0.875) return (4 + pi * z - std::sin(4 * pi * z) / 4) / (4 + pi);
      return (2 + pi * z - 2.25 * std::sin((4 * pi * z + pi) / 3)) / (4 + pi);
    case ClassicalLaw::modified_trapezoid: {
      if (z > 0.5) return 1 - symmetric(law, 1 - z);
      const double c = 1 / (2 + pi);
      if (z < 0.125) return c * (2 * z - std::sin(4 * pi * z) / (2 * pi));
      if (z < 0.375) return c * (4 * pi * z * z + (2 - pi) * z + pi / 16 - 1 / (2 * pi) + 0 * z);
      return c * ((2 * pi + 2) * z - std::sin(4 * pi * z - pi) / (2 * pi) - pi / 2);
    }
    case ClassicalLaw::inclined_sine:
    case ClassicalLaw::gutman_1:
      return z - std::sin(harmonic) / (2 * pi);
    case ClassicalLaw::simple_harmonic:
      return (1 - std::cos(pi * z)) / 2;
    case ClassicalLaw::quadratic:
      return z < 0.5 ? 2 * z * z : 1 - 2 * (1 - z) * (1 - z);
    case ClassicalLaw::gutman_2:
      return z - 15 / (32 * pi) * std::sin(harmonic) - std::sin(3 * harmonic) / (96 * pi);
    case ClassicalLaw::gutman_3: {
      // Weights 7/8, 5/72 and 3/200 in proportion.
      const double a = 7.0 / 8, b = 5.0 / 72, c = 3.0 / 200, sum = a + b + c;
      return z - (a * std::sin(harmonic) + b * std::sin(3 * harmonic) / 3 + c * std::sin(5 * harmonic) / 5) /
                     (2 * pi * sum);
    }
    case ClassicalLaw::double_harmonic_from_dwell:
      return (1 - std::cos(pi * z)) / 2 - (1 - std::cos(harmonic)) / 8;
    case ClassicalLaw::double_harmonic_to_dwell:
      return 1 - symmetric(ClassicalLaw::double_harmonic_from_dwell, 1 - z);
    case ClassicalLaw::straight:
      return z;
  }
  return z;
}

}  // namespace

double textbook_law(ClassicalLaw law, double z, double inflection) {
  if (law == ClassicalLaw::straight || inflection == 0.5) return symmetric(law, z);
  if (z <= inflection) return 2 * inflection * symmetric(law, z / (2 * inflection));
  const double rest = 1 - inflection;
  return 1 - 2 * rest * symmetric(law, (1 - z) / (2 * rest));
}

void check_textbook_laws(const cam::MotionLawProblem& problem, const LawToVerify& law, Verification& out) {
  constexpr double tolerance = 1e-9;
  constexpr int places = 200;
  Check check{{CheckedQuantity::named, 0, "", "classical law"}, tolerance, 0, 0, true};
  bool any = false;
  for (std::size_t s = 0; s < problem.sections(); ++s) {
    const cam::MotionPoint &from = problem.points[s], &to = problem.points[problem.end_point(s)];
    if (!from.law) continue;
    std::size_t first = 0, last = 0;
    for (std::size_t i = 0; i < law.sections.size(); ++i) {
      if (law.sections[i] < s) first = i + 1;
      if (law.sections[i] <= s) last = i;
    }
    // Rests: the law's own velocity, acceleration and jerk at its ends say so, as its published coefficients have them.
    const auto rests = [&](std::size_t piece, bool end) {
      const double T = law.breaks[piece + 1] - law.breaks[piece];
      const auto v = derivative_coefficients(law.bernstein[piece], T, 1);
      const auto [least, most] = std::minmax_element(law.bernstein[piece].begin(), law.bernstein[piece].end());
      return std::abs(end ? v.back() : v.front()) <= 1e-9 * static_cast<double>(v.size()) * (*most - *least) / T;
    };
    const bool straight = *from.law == ClassicalLaw::straight;
    if (!straight && !(rests(first, false) && rests(last, true))) continue;
    const double more = problem.periodic && s + 1 == problem.points.size() ? problem.travel : 0;
    const double s0 = from.value(0).min, h = to.value(0).min + more - s0;
    const bool with_states = *from.law == ClassicalLaw::polynomial_345 || *from.law == ClassicalLaw::polynomial_4567;
    bool higher = false;
    for (const auto* point : {&from, &to})
      for (int r = 2; r < 4; ++r) higher = higher || (point->value(r).fixed() && point->value(r).min != 0);
    if (h == 0 || (with_states && higher)) continue;
    any = true;
    const double begin = law.breaks[first], end = law.breaks[last + 1];
    std::size_t piece = first;
    for (int k = 0; k <= places; ++k) {
      const double z = static_cast<double>(k) / places, t = begin + z * (end - begin);
      while (piece < last && t > law.breaks[piece + 1]) ++piece;
      const double x = std::clamp((t - law.breaks[piece]) / (law.breaks[piece + 1] - law.breaks[piece]), 0.0, 1.0);
      const double off = std::abs(bernstein_sum(law.bernstein[piece], x) - s0 -
                                  h * textbook_law(*from.law, z, from.inflection.value_or(0.5))) /
                         std::abs(h);
      const double allowed = tolerance + 1e-14 * std::abs(s0 / h);
      if (off / allowed >= check.value / check.limit) check.value = off, check.limit = allowed, check.at = t;
    }
  }
  if (!any) return;
  check.passed = check.value <= check.limit;
  out.add(std::move(check));
}

}  // namespace bahnwerk::verify
