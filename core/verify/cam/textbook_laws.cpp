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

/// The displacement of SCCA's zones [Norton], with a straight part in the middle where b + c + d < 1.
double sine_straight(const cam::SineStraight& f, double z) {
  if (z > 0.5) return 1 - sine_straight(f, 1 - z);
  const double b = f.b, d = f.d, q = (b + f.c) / 2, bb = b * b * (1 / 8.0 - 1 / (pi * pi));
  const double velocity = b / pi + f.c / 2 + d / pi;  // velocity in the middle, for an acceleration of 1
  if (velocity == 0) return z;
  const auto third = [&](double x) {
    const double turn = d > 0 ? std::cos(pi / d * (x - q)) : 1;
    return (b / pi + f.c / 2) * x + d * d / (pi * pi) * (1 - turn) + bb - q * q / 2;
  };
  const double end = q + d / 2, ca = 0.5 / (third(end) + velocity * (0.5 - end));
  if (z >= end) return 0.5 - ca * velocity * (0.5 - z);
  if (z >= q) return ca * third(z);
  if (z >= b / 2) return ca * (z * z / 2 + b * (1 / pi - 0.5) * z + bb);
  return ca * (b * z / pi - b * b / (pi * pi) * std::sin(pi * z / b));
}

/// Half a period of a sine of acceleration up to λ, then a quarter; the velocities are the same at λ.
double harmonic_combination(double z, double lambda) {
  const double mu = 1 - lambda, v = 2 * pi / (pi * lambda + 4 * mu);
  if (z < lambda) return v * (z / 2 - lambda / (2 * pi) * std::sin(pi * z / lambda));
  return 1 - 2 * v * mu / pi * (1 - std::cos(pi / 2 * (1 - z) / mu));
}

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
    case ClassicalLaw::polynomial_3456_from_dwell:
      return z * z * z * (8 + z * (-12 + z * (6 - z)));
    case ClassicalLaw::polynomial_3456_to_dwell:
      return 1 - symmetric(ClassicalLaw::polynomial_3456_from_dwell, 1 - z);
    case ClassicalLaw::straight:
    case ClassicalLaw::sine_straight_combination:
    case ClassicalLaw::harmonic_combination_from_dwell:
    case ClassicalLaw::harmonic_combination_to_dwell:
      return z;
  }
  return z;
}

}  // namespace

double textbook_law(ClassicalLaw law, double z, std::optional<double> inflection, const cam::SineStraight& fractions) {
  const double smooth = std::sqrt(2.0) / (1 + std::sqrt(2.0));  // λ with a continuous jerk
  if (law == ClassicalLaw::harmonic_combination_from_dwell) return harmonic_combination(z, inflection.value_or(smooth));
  if (law == ClassicalLaw::harmonic_combination_to_dwell)
    return 1 - harmonic_combination(1 - z, 1 - inflection.value_or(1 - smooth));
  const auto f = [&](double x) {
    return law == ClassicalLaw::sine_straight_combination ? sine_straight(fractions, x) : symmetric(law, x);
  };
  const double lambda = inflection.value_or(0.5);
  if (law == ClassicalLaw::straight || lambda == 0.5) return f(z);
  if (z <= lambda) return 2 * lambda * f(z / (2 * lambda));
  return 1 - 2 * (1 - lambda) * f((1 - z) / (2 * (1 - lambda)));
}

void check_textbook_laws(const cam::MotionLawProblem& problem, const LawToVerify& law, Verification& out) {
  constexpr double tolerance = 1e-9;
  constexpr int places = 200;
  Check check{named(CheckGroup::limit, "classical law", ""), tolerance, 0, 0, true};
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
                                  h * textbook_law(*from.law, z, from.inflection, from.fractions)) /
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
