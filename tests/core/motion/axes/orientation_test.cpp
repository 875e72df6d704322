// Angles along a path by arc length, against differences of themselves.
#include "core/motion/axes/orientation.hpp"

#include <gtest/gtest.h>

#include <complex>

#include "core/base/errors.hpp"
#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/line.hpp"
#include "core/geometry/curve/rational.hpp"
#include "needle_loop.hpp"

namespace bahnwerk {
namespace {

std::shared_ptr<const Curve> line(Vec from, Vec to) { return std::make_shared<Line>(from, to); }

TEST(Orientation, DerivativesAreByArcLength) {
  Path path;  // a curve of uneven speed, angles of uneven weight
  path.append(
      std::make_shared<Rational>(Rational::bezier({{0, 0, 0}, {5, 20, 4}, {30, 10, 0}, {40, 40, 9}}, {1, 2, 0.7, 1})),
      0);
  const Orientation turn(
      path,
      {std::make_shared<Rational>(Rational::bezier({{0.3, 0, 0}, {0.9, 0.2, 0}, {1.4, -0.5, 0}}, {1, 0.6, 1.3}))});
  const Segment& segment = path[0];
  for (const double part : {0.1, 0.35, 0.6, 0.9}) {
    const double s = part * segment.length(), h = 0.01;
    const auto at = [&](double ds) { return turn.tool(segment, 0, segment.parameter(s + ds)); };
    const ToolJet here = at(0);
    for (const auto angle : {&ToolJet::phi, &ToolJet::psi}) {
      const auto slope = [&](double AngleJet::*what) {
        return (8 * ((at(h).*angle).*what - (at(-h).*angle).*what) -
                ((at(2 * h).*angle).*what - (at(-2 * h).*angle).*what)) /
               (12 * h);
      };
      EXPECT_NEAR((here.*angle).d1, slope(&AngleJet::value), 1e-9);
      EXPECT_NEAR((here.*angle).d2, slope(&AngleJet::d1), 1e-9);
      EXPECT_NEAR((here.*angle).d3, slope(&AngleJet::d2), 1e-9);
    }
    EXPECT_LE(norm(here.position.value - segment.at(s).value), 1e-12);
    EXPECT_EQ(turn.pose(segment, 0, segment.parameter(s)).phi, here.phi.value);
  }
}

TEST(Orientation, ParameterIsProportionalToLengthOnLinesAndArcs) {
  Path path;
  path.append(std::make_shared<Arc>(Vec{}, Vec{1, 0, 0}, Vec{0, 1, 0}, 20, 2.0), 0);
  const Orientation turn(path, {line({0.5, 0.1, 0}, {2.5, 0.1, 0})});
  const ToolJet tool = turn.tool(path[0], 0, 0.25);
  EXPECT_NEAR(tool.phi.value, 1, 1e-15);
  EXPECT_NEAR(tool.phi.d1, 1 / 20.0, 1e-15);
  EXPECT_EQ(tool.phi.d2, 0);
  EXPECT_EQ(tool.psi.d1, 0);
}

/// At complex parameters, by the quotient itself.
TEST(Orientation, TurnsAreBoundedInTheComplexPlane) {
  Path path;
  path.append(line({0, 0, 0}, {50, 0, 0}), 0);
  const std::vector<double> w{1, 0.6, 1.3};
  const std::vector<Vec> p{{0.3, 0, 0}, {0.9, 0.2, 0}, {1.4, -0.5, 0}};
  const Orientation turn(path, {std::make_shared<Rational>(Rational::bezier(p, w))});
  using Complex = std::complex<double>;
  const auto at = [&](Complex u) {
    Complex sum, x, y;
    const Complex b[] = {(1.0 - u) * (1.0 - u), 2.0 * u * (1.0 - u), u * u};
    for (std::size_t i = 0; i < 3; ++i) sum += b[i] * w[i], x += b[i] * w[i] * p[i].x, y += b[i] * w[i] * p[i].y;
    return std::array{x / sum, y / sum};
  };
  for (const double u : {0.0, 0.4, 1.0})
    for (const double radius : {0.01, 0.1, 0.3}) {
      const double most = turn.turn_within(0, u, radius);
      const auto here = at(u);
      double largest = 0;
      for (int i = 0; i < 64; ++i) {
        const auto there = at(u + std::polar(radius, 0.1 * i));
        largest = std::max(largest, std::sqrt(std::norm(there[0] - here[0]) + std::norm(there[1] - here[1])));
      }
      EXPECT_LE(largest, most * (1 + 1e-12));
      EXPECT_LE(most, 2.5 * largest) << u << ' ' << radius;
    }
  EXPECT_TRUE(std::isinf(turn.turn_within(0, 0.5, 10)));
  Path two = path;
  const Orientation still(two, {line({1, 2, 0}, {1, 2, 0})});
  EXPECT_EQ(still.turn_within(0, 0.5, 10), 0);
}

TEST(Orientation, AnglesThatDoNotFitAreRefused) {
  Path path;
  path.append(line({0, 0, 0}, {50, 0, 0}), 0);
  path.append(line({50, 0, 0}, {50, 30, 0}), 1);
  EXPECT_THROW(Orientation(path, {line({0, 0, 0}, {1, 0, 0})}), std::invalid_argument);
  EXPECT_THROW(Orientation(path, {line({0, 0, 0}, {1, 0, 0}), line({1.1, 0, 0}, {2, 0, 0})}), InvalidInput);
  EXPECT_NO_THROW(Orientation(path, {line({0, 0, 0}, {1, 0, 0}), line({1, 0, 0}, {2, 0, 0})}));
  Path cusped;  // its parametric tangent vanishes where it begins
  cusped.append(std::make_shared<Rational>(Rational::bezier({{0, 0, 0}, {0, 0, 0}, {20, 9, 0}, {40, 0, 0}})), 0);
  EXPECT_THROW(Orientation(cusped, {line({0, 0, 0}, {1, 0, 0})}), InvalidInput);
  EXPECT_NO_THROW(Orientation(cusped, {line({1, 0, 0}, {1, 0, 0})}));
}

}  // namespace
}  // namespace bahnwerk
