#include "core/geometry/spline/search/link_variables.hpp"

#include <gtest/gtest.h>

#include "core/geometry/spline/spline_arc.hpp"
#include "tests/core/geometry/spline/spline_support.hpp"

namespace bahnwerk {
namespace {

LinkEnds stator() {
  const auto slot = BezierPiece::line({40, 0, -30, 0, 0}, {40, 0, 30, 0, 0});
  const auto head = spline_arc({52, 6, 40, 0, 1.5}, {}, {0, 0, 1}, 1.2, {0, 0, 0, 1.2, 0}).front();
  return {slot.at(1), head.at(0)};
}
std::vector<double> random_variables(Random& random, const LinkVariables& variables) {
  std::vector<double> gamma;
  for (std::size_t i = 0; i < variables.size(); ++i)
    gamma.push_back(variables.order(i) == 1 ? random.uniform(0.3, 3) : random.uniform(-3, 3));
  return gamma;
}

TEST(LinkVariables, BothShapesGiveTheSameLinkAndTheVariablesBack) {
  Random random(3);
  for (std::size_t k = 1; k <= 4; ++k)
    for (int i = 0; i < 20; ++i) {
      const LinkVariables variables(k, stator());
      const auto gamma = random_variables(random, variables);
      const auto own = link(k, stator(), variables.own(gamma)),
                 scaled = link(k, variables.ends(), variables.scaled(gamma));
      for (const double v : {0.0, 0.2, 0.7, 1.0}) EXPECT_LE(testing::distance(own.at(v)[0], scaled.at(v)[0]), 1e-9);
      const auto back = variables.of(variables.own(gamma));
      for (std::size_t j = 0; j < gamma.size(); ++j) EXPECT_NEAR(back[j], gamma[j], 1e-9 * (1 + std::abs(gamma[j])));
    }
}

// γ₁ is the speed at the joint in units of the chord, and control points are linear in the highest γ.
TEST(LinkVariables, AreDerivativesByLengthInUnitsOfTheChord) {
  const LinkVariables variables(3, stator());
  auto gamma = variables.straight();
  gamma[0] = 2;
  EXPECT_NEAR(norm(place(link(3, stator(), variables.own(gamma)).at(0)[1])), 2 * variables.chord(), 1e-9);
  Random random(4);
  const auto a = random_variables(random, variables), b = random_variables(random, variables);
  std::vector<double> middle;
  for (std::size_t j = 0; j < a.size(); ++j) middle.push_back(j % 3 == 2 ? (a[j] + b[j]) / 2 : a[j]);
  auto other = a;
  for (std::size_t j = 0; j < a.size(); ++j)
    if (j % 3 == 2) other[j] = b[j];
  const auto p = link(3, variables.ends(), variables.scaled(a)).points(),
             q = link(3, variables.ends(), variables.scaled(other)).points(),
             m = link(3, variables.ends(), variables.scaled(middle)).points();
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t d = 0; d < 5; ++d) EXPECT_NEAR(m[i][d], (p[i][d] + q[i][d]) / 2, 1e-9);
}

TEST(LinkVariables, AreWithinTheirBoundsForEveryShape) {
  const LinkVariables variables(3, stator());
  const auto gamma = variables.of({{1e-3, 50, -1e5, 0}, {1e6, 0, 0, 0}, {}});
  for (std::size_t i = 0; i < gamma.size(); ++i) {
    EXPECT_GE(gamma[i], LinkVariables::lower(variables.order(i)));
    EXPECT_LE(gamma[i], LinkVariables::upper(variables.order(i)));
  }
}

}  // namespace
}  // namespace bahnwerk
