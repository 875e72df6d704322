#include "core/cam/classical/classical_sections.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/errors.hpp"
#include "core/cam/classical/half_law.hpp"
#include "tests/core/cam/problems.hpp"

namespace bahnwerk::cam {
namespace {

using namespace testing_problems;
constexpr double pi = std::numbers::pi;

CamLaw law_of(const GivenSection& given) {
  std::vector<LawPiece> pieces;
  for (const auto& b : given.bernstein) pieces.push_back({0, b});
  return {given.breaks, pieces, false};
}
CamLaw unit_law(ClassicalLaw law, std::optional<double> inflection = std::nullopt) {
  SectionEnds ends;
  ends.to[0] = 1;
  return law_of(classical_section(law, inflection, 0, 1, ends));
}

TEST(ClassicalSections, CoefficientsAreThoseOfTheTextbooks) {
  const struct {
    ClassicalLaw law;
    double cv, ca, cj;
  } table[] = {
      {ClassicalLaw::polynomial_345, 1.875, 10 / std::sqrt(3.0), 60},
      {ClassicalLaw::polynomial_4567, 2.1875, 7.513188, 52.5},
      {ClassicalLaw::inclined_sine, 2, 2 * pi, 4 * pi * pi},
      {ClassicalLaw::modified_sine, 4 * pi / (4 + pi), 4 * pi * pi / (4 + pi), 16 * pi * pi * pi / (4 + pi)},
      {ClassicalLaw::modified_trapezoid, 2, 8 * pi / (2 + pi), 32 * pi * pi / (2 + pi)},
      {ClassicalLaw::simple_harmonic, pi / 2, pi * pi / 2, pi * pi * pi / 2},
      {ClassicalLaw::quadratic, 2, 4, 0},
      {ClassicalLaw::straight, 1, 0, 0},
      {ClassicalLaw::gutman_1, 2, 2 * pi, 4 * pi * pi},
  };
  for (const auto& row : table) {
    const CamLaw law = unit_law(row.law);
    const char* name = name_of<ClassicalLaw>(row.law, classical_laws);
    EXPECT_NEAR(law.peak(1).value, row.cv, 1e-6) << name;
    EXPECT_NEAR(law.peak(2).value, row.ca, 1e-6) << name;
    EXPECT_NEAR(law.peak(3).value, row.cj, 1e-5) << name;
    EXPECT_NEAR(law.evaluate(1, 0), 1, 1e-14) << name;
  }
  EXPECT_NEAR(unit_law(ClassicalLaw::modified_sine).peak(1).value, 1.7596, 5e-5);
  EXPECT_NEAR(unit_law(ClassicalLaw::modified_sine).peak(2).value, 5.5280, 5e-5);
  EXPECT_NEAR(unit_law(ClassicalLaw::modified_trapezoid).peak(2).value, 4.8881, 5e-5);
}

TEST(ClassicalSections, LawsBetweenDwellAndReversalHaveTheirClosedForms) {
  const double lambda = 2 - std::numbers::sqrt2, mu = 1 - lambda, v = 1 / (lambda / 2 + 2 * mu / pi);
  for (const ClassicalLaw each :
       {ClassicalLaw::harmonic_combination_from_dwell, ClassicalLaw::harmonic_combination_to_dwell}) {
    const CamLaw law = unit_law(each);
    EXPECT_NEAR(law.peak(1).value, v, 1e-12);
    EXPECT_NEAR(law.peak(2).value, pi * v / (2 * mu), 1e-9);
    EXPECT_NEAR(law.peak(3).value, pi * pi * v / (2 * lambda * lambda), 1e-7);
  }
  // 8 z³ − 12 z⁴ + 6 z⁵ − z⁶: f″ = −6 at the end, f‴ = 48 at the begin; f″ = 0 at z = 0.5528.
  const CamLaw law = unit_law(ClassicalLaw::polynomial_3456_from_dwell);
  const double z = 1 - 1 / std::sqrt(5.0);
  EXPECT_NEAR(law.peak(1).value, z * z * (24 + z * (-48 + z * (30 - 6 * z))), 1e-12);
  EXPECT_NEAR(law.peak(2).value, 6, 1e-12);
  EXPECT_NEAR(law.peak(3).value, 48, 1e-12);
  EXPECT_NEAR(law.evaluate(1, 2), -6, 1e-12);
}

TEST(ClassicalSections, SineStraightCombinationHasNortonsCoefficients) {
  for (const SineStraight f : {SineStraight{0.25, 0.5, 0.25}, {0.1, 0.3, 0.6}, {0.3, 0.1, 0.6}, {0.5, 0, 0.5}}) {
    SectionEnds ends;
    ends.to[0] = 1;
    const CamLaw law = law_of(classical_section(ClassicalLaw::sine_straight_combination, std::nullopt, 0, 1, ends, f));
    const double ca = 4 * pi * pi / ((pi * pi - 8) * (f.b * f.b - f.d * f.d) - 2 * pi * (pi - 2) * f.b + pi * pi);
    EXPECT_NEAR(law.peak(2).value, ca, 1e-9);
    EXPECT_NEAR(law.peak(1).value, ca * ((f.b + f.d) / pi + f.c / 2), 1e-11);
    EXPECT_NEAR(law.peak(3).value, ca * pi / std::min(f.b, f.d), 1e-6);
  }
}

TEST(ClassicalSections, GutmansLawIsItsSeries) {
  const CamLaw law = unit_law(ClassicalLaw::gutman_2);
  for (double z = 0; z <= 1; z += 0.013)
    EXPECT_NEAR(law.evaluate(z, 0), z - 15 / (32 * pi) * std::sin(2 * pi * z) - std::sin(6 * pi * z) / (96 * pi),
                1e-13);
}

TEST(ClassicalSections, PiecesOfALawJoinSmoothly) {
  for (const auto& entry : classical_laws)
    for (const double inflection : {0.5, 0.35}) {
      if (entry.value == ClassicalLaw::straight || !whole_law(entry.value).empty()) continue;
      const CamLaw law = unit_law(entry.value, inflection);
      const int order = entry.value == ClassicalLaw::quadratic ? 1 : 2;
      for (std::size_t i = 0; i + 1 < law.pieces(); ++i)
        for (int r = 0; r <= order; ++r)
          EXPECT_NEAR(law.in_piece(i, 1, r), law.in_piece(i + 1, 0, r), 1e-10) << entry.name << " " << i << " " << r;
      EXPECT_NEAR(law.evaluate(inflection, 0), inflection, 1e-13) << entry.name;
      if (order == 2) {
        EXPECT_NEAR(law.evaluate(inflection, 2), 0, 1e-9) << entry.name;
      }
    }
}

TEST(ClassicalSections, MotionToMotionKeepsTheVelocitiesAtItsEnds) {
  SectionEnds ends;
  ends.from[0] = 5, ends.from[1] = 10, ends.to[0] = 65, ends.to[1] = -20;
  for (const auto& entry : classical_laws) {
    if (entry.value == ClassicalLaw::straight || !whole_law(entry.value).empty()) continue;
    const CamLaw law = law_of(classical_section(entry.value, std::nullopt, 2, 5, ends));
    EXPECT_NEAR(law.evaluate(2, 0), 5, 1e-12) << entry.name;
    EXPECT_NEAR(law.evaluate(2, 1), 10, 1e-11) << entry.name;
    EXPECT_NEAR(law.evaluate(5, 0), 65, 1e-12) << entry.name;
    EXPECT_NEAR(law.evaluate(5, 1), -20, 1e-11) << entry.name;
  }
}

TEST(ClassicalSections, TheQuinticTakesAccelerationsTheSepticJerks) {
  SectionEnds ends;
  ends.from[0] = 1, ends.from[1] = 2, ends.from[2] = -3, ends.from[3] = 4;
  ends.to[0] = 9, ends.to[1] = -1, ends.to[2] = 6, ends.to[3] = -7;
  for (const auto& [law, orders] : {std::pair{ClassicalLaw::polynomial_345, 3}, {ClassicalLaw::polynomial_4567, 4}}) {
    const CamLaw found = law_of(classical_section(law, std::nullopt, 0, 2, ends));
    for (int r = 0; r < orders; ++r) {
      EXPECT_NEAR(found.in_piece(0, 0, r), ends.from[r], 1e-12);
      EXPECT_NEAR(found.in_piece(0, 1, r), ends.to[r], 1e-12);
    }
  }
}

TEST(ClassicalSections, AStraightNeighbourGivesTheVelocity) {
  MotionLawProblem p = problem(30, false, {rest(0, 0), point(10, 2, {number(5)}), rest(30, 0)});
  p.points[1].values = {number(5)};
  p.points[0].law = ClassicalLaw::modified_sine;
  p.points[1].law = ClassicalLaw::straight;
  p.points[2].values = {number(25)};
  const auto given = classical_sections(p, {0, 10, 30});
  EXPECT_NEAR(given[0]->end_value(true, 1), 1, 1e-13);
  EXPECT_NEAR(given[1]->end_value(false, 1), 1, 1e-13);
}

TEST(ClassicalSections, LawsThatDoNotJoinAreNamed) {
  MotionLawProblem p = problem(20, false, {rest(0, 0), point(10, 2, {number(5)}), rest(20, 9)});
  p.points[0].values = {number(0)}, p.points[2].values = {number(9)};
  p.points[0].law = p.points[1].law = ClassicalLaw::quadratic;
  try {
    classical_sections(p, {0, 10, 20});
    FAIL();
  } catch (const InvalidInput& invalid) {
    EXPECT_EQ(invalid.faults[0].place, (std::vector<std::string>{"points", "1", "continuity"}));
  }
  p.points[1].continuity = 1;
  EXPECT_NO_THROW(classical_sections(p, {0, 10, 20}));
  p.points[1].values = {Range{4, 5}};
  EXPECT_THROW(classical_sections(p, {0, 10, 20}), InvalidInput);
}

TEST(ClassicalSections, TheDoubleHarmonicLeavesADwellAndEndsInAReversal) {
  const CamLaw law = [] {
    const auto made = [](ClassicalLaw each, double begin, double from, double to) {
      SectionEnds ends;
      ends.from[0] = from, ends.to[0] = to;
      return classical_section(each, {}, begin, begin + 1, ends);
    };
    const GivenSection rise = made(ClassicalLaw::double_harmonic_from_dwell, 0, 0, 1),
                       back = made(ClassicalLaw::double_harmonic_to_dwell, 1, 1, 0);
    std::vector<double> breaks = rise.breaks;
    breaks.insert(breaks.end(), back.breaks.begin() + 1, back.breaks.end());
    std::vector<LawPiece> pieces;
    for (const auto& b : rise.bernstein) pieces.push_back({0, b});
    for (const auto& b : back.bernstein) pieces.push_back({1, b});
    return CamLaw(breaks, pieces, true);
  }();
  EXPECT_NEAR(law.peak(1).value, pi * 3 * std::sqrt(3.0) / 8, 1e-9);  // Cv 2.04 [Norton]
  EXPECT_NEAR(law.peak(2).value, pi * pi, 1e-9);                      // Ca 9.87
  EXPECT_NEAR(law.evaluate(0, 2), 0, 1e-9);
  for (const double t : {0.999999999, 1.000000001}) EXPECT_NEAR(law.evaluate(t, 2), -pi * pi, 1e-6);
  for (double t = 0; t <= 1; t += 0.1) {
    EXPECT_NEAR(law.evaluate(t, 0), (1 - std::cos(pi * t)) / 2 - (1 - std::cos(2 * pi * t)) / 8, 1e-13);
    EXPECT_NEAR(law.evaluate(2 - t - 1e-12, 0), law.evaluate(t, 0), 1e-10);
  }
}

}  // namespace
}  // namespace bahnwerk::cam
