#include "core/cam/classical/half_law.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace bahnwerk::cam {
namespace {

constexpr double pi = std::numbers::pi;

/// de Casteljau.
double value(const HalfLawPiece& piece, double z) {
  std::vector<double> b = piece.bernstein;
  const double x = (z - piece.begin) / (piece.end - piece.begin);
  for (std::size_t n = b.size(); n-- > 1;)
    for (std::size_t i = 0; i < n; ++i) b[i] += x * (b[i + 1] - b[i]);
  return b[0];
}
double value(const std::vector<HalfLawPiece>& half, double z) {
  const auto at = std::find_if(half.begin(), half.end(), [&](const HalfLawPiece& p) { return z <= p.end; });
  return value(at == half.end() ? half.back() : *at, z);
}

TEST(HalfLaw, EveryLawRisesFromRestToTheMiddle) {
  for (const auto& law : classical_laws) {
    if (law.value == ClassicalLaw::straight || !whole_law(law.value).empty()) {
      EXPECT_THROW(half_law(law.value), std::logic_error);
      continue;
    }
    const auto half = half_law(law.value);
    EXPECT_EQ(half.front().begin, 0) << law.name;
    EXPECT_EQ(half.back().end, 0.5) << law.name;
    for (std::size_t i = 1; i < half.size(); ++i) {
      EXPECT_EQ(half[i].begin, half[i - 1].end) << law.name;
      EXPECT_NEAR(half[i].bernstein.front(), half[i - 1].bernstein.back(), 1e-14) << law.name;
    }
    EXPECT_NEAR(half.front().bernstein.front(), 0, 1e-14) << law.name;
    EXPECT_NEAR(half.front().bernstein[1], 0, 1e-14) << law.name << ": it begins at rest";
    EXPECT_NEAR(half.back().bernstein.back(), 0.5, 1e-14) << law.name;
    double before = 0;
    for (int i = 1; i <= 200; ++i) {
      const double now = value(half, i / 400.0);
      EXPECT_GE(now, before - 1e-14) << law.name;
      before = now;
    }
  }
}

TEST(HalfLaw, ValuesAreThoseOfTheFormulas) {
  const auto gutman = [](double z, std::initializer_list<std::pair<int, double>> terms) {
    double f = z;
    for (const auto& [k, c] : terms) f -= c / (2 * pi * k) * std::sin(2 * pi * k * z);
    return f;
  };
  // n = 3: c_k ∝ (1 − k/8)/k² over k = 1, 3, 5.
  const double c1 = 7 / 8.0, c3 = 5 / 8.0 / 9, c5 = 3 / 8.0 / 25, sum = c1 + c3 + c5;
  for (double z = 0; z <= 0.5; z += 0.01) {
    EXPECT_NEAR(value(half_law(ClassicalLaw::polynomial_345), z), z * z * z * (10 + z * (-15 + 6 * z)), 1e-14);
    EXPECT_NEAR(value(half_law(ClassicalLaw::polynomial_4567), z), z * z * z * z * (35 + z * (-84 + z * (70 - 20 * z))),
                1e-14);
    EXPECT_NEAR(value(half_law(ClassicalLaw::simple_harmonic), z), (1 - std::cos(pi * z)) / 2, 1e-14);
    EXPECT_NEAR(value(half_law(ClassicalLaw::quadratic), z), 2 * z * z, 1e-14);
    EXPECT_NEAR(value(half_law(ClassicalLaw::inclined_sine), z), gutman(z, {{1, 1}}), 1e-14);
    EXPECT_NEAR(value(half_law(ClassicalLaw::gutman_2), z), gutman(z, {{1, 15 / 16.0}, {3, 1 / 16.0}}), 1e-14);
    EXPECT_NEAR(value(half_law(ClassicalLaw::gutman_3), z), gutman(z, {{1, c1 / sum}, {3, c3 / sum}, {5, c5 / sum}}),
                4e-15);
  }
}

TEST(HalfLaw, TheMiddleVelocityIsTheLawsCv) {
  const std::pair<ClassicalLaw, double> table[] = {{ClassicalLaw::polynomial_345, 1.875},
                                                   {ClassicalLaw::polynomial_4567, 2.1875},
                                                   {ClassicalLaw::modified_sine, 4 * pi / (4 + pi)},
                                                   {ClassicalLaw::modified_trapezoid, 2},
                                                   {ClassicalLaw::inclined_sine, 2},
                                                   {ClassicalLaw::simple_harmonic, pi / 2},
                                                   {ClassicalLaw::quadratic, 2},
                                                   {ClassicalLaw::gutman_2, 2}};
  for (const auto& [law, cv] : table)
    EXPECT_NEAR(middle_velocity(half_law(law)), cv, 1e-12) << name_of<ClassicalLaw>(law, classical_laws);
}

TEST(HalfLaw, SineStraightCombinationContainsTheLawsOfItsFamily) {
  const std::pair<SineStraight, ClassicalLaw> members[] = {{{0.25, 0.5, 0.25}, ClassicalLaw::modified_trapezoid},
                                                           {{0.25, 0, 0.75}, ClassicalLaw::modified_sine},
                                                           {{0.5, 0, 0.5}, ClassicalLaw::inclined_sine},
                                                           {{0, 0, 1}, ClassicalLaw::simple_harmonic},
                                                           {{0, 1, 0}, ClassicalLaw::quadratic}};
  for (const auto& [fractions, law] : members)
    for (double z = 0; z <= 0.5; z += 0.01)
      EXPECT_NEAR(value(half_law(ClassicalLaw::sine_straight_combination, fractions), z), value(half_law(law), z),
                  1e-14)
          << name_of<ClassicalLaw>(law, classical_laws) << " " << z;
  const auto line = half_law(ClassicalLaw::sine_straight_combination, {0, 0, 0});
  for (double z = 0; z <= 0.5; z += 0.01) EXPECT_NEAR(value(line, z), z, 1e-15);
}

TEST(HalfLaw, HarmonicCombinationHasAContinuousJerkAtItsOwnInflection) {
  const double lambda = 2 - std::numbers::sqrt2;
  const auto third = [](const HalfLawPiece& piece, double x) {
    const double h = piece.end - piece.begin, d = 1e-3 * h, z = piece.begin + x * h;
    const double side = x > 0.5 ? -1 : 1;
    return (value(piece, z + 3 * side * d) - 3 * value(piece, z + 2 * side * d) + 3 * value(piece, z + side * d) -
            value(piece, z)) /
           (side * d * d * d);
  };
  const auto law = whole_law(ClassicalLaw::harmonic_combination_from_dwell);
  EXPECT_EQ(law[0].end, lambda);
  EXPECT_NEAR(third(law[0], 1), third(law[1], 0), 0.1);
  const auto other = whole_law(ClassicalLaw::harmonic_combination_from_dwell, 0.4);
  EXPECT_GT(std::abs(third(other[0], 1) - third(other[1], 0)), 10);
}

TEST(HalfLaw, LawsToADwellAreThoseFromADwellBackwards) {
  const std::pair<ClassicalLaw, ClassicalLaw> pairs[] = {
      {ClassicalLaw::double_harmonic_from_dwell, ClassicalLaw::double_harmonic_to_dwell},
      {ClassicalLaw::harmonic_combination_from_dwell, ClassicalLaw::harmonic_combination_to_dwell},
      {ClassicalLaw::polynomial_3456_from_dwell, ClassicalLaw::polynomial_3456_to_dwell}};
  for (const auto& [from, to] : pairs) {
    EXPECT_EQ(whole_law(from).back().bernstein.back(), 1) << name_of<ClassicalLaw>(from, classical_laws);
    EXPECT_EQ(whole_law(to).front().bernstein.front(), 0) << name_of<ClassicalLaw>(to, classical_laws);
    for (double z = 0; z <= 1; z += 0.01)
      EXPECT_NEAR(value(whole_law(to), z), 1 - value(whole_law(from), 1 - z), 1e-14);
  }
}

}  // namespace
}  // namespace bahnwerk::cam
