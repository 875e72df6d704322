#include "core/geometry/curve/reversed.hpp"

#include <cmath>

#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/line.hpp"
#include "core/geometry/curve/rational.hpp"
#include "core/geometry/path/path.hpp"
#include "tests/core/geometry/support.hpp"

namespace bahnwerk {
namespace {

void expect_reversed(const Curve& curve) {
  const auto back = reversed(curve);
  ASSERT_EQ(back->kind(), curve.kind());
  EXPECT_EQ(back->begin(), 0);
  EXPECT_EQ(back->end(), 1);
  const double width = curve.end() - curve.begin();
  for (int i = 0; i <= 20; ++i) {
    const double x = i / 20.0;
    const Jet a = curve.at(curve.begin() + width * x), b = back->at(1 - x);
    testing::expect_near(b.value, a.value, 1e-13);
    testing::expect_near(b.d1, -width * a.d1, 1e-12);
    testing::expect_near(b.d2, width * width * a.d2, 1e-11);
    testing::expect_near(b.d3, -width * width * width * a.d3, 1e-10);
  }
}

TEST(Reversed, EveryKindRunsFromItsEnd) {
  expect_reversed(Line({1, 2, 3}, {-4, 0, 7}));
  for (const double sweep : {0.7, -2.5, 6.0}) expect_reversed(Arc({3, -1, 2}, {0.6, 0.8, 0}, {0, 0, 1}, 4, sweep, 1.5));
  const Rational plain = Rational::bezier({{0, 0}, {3, 1}, {4, -2}, {7, 5}}),
                 weighted = Rational::bezier({{0, 0, 1}, {3, 1, 0}, {4, -2, 2}}, {1, 0.4, 2});
  expect_reversed(plain);
  expect_reversed(weighted);
  expect_reversed(plain.restricted(0.2, 0.7, 0.7));
  expect_reversed(weighted.restricted(0.4, 1, 0.6));
}

/// A tangent that vanishes at the begin vanishes at the end then, and the path has as many segments.
TEST(Reversed, KeepsVanishingTangents) {
  Path path, back;
  path.append(std::make_shared<const Rational>(Rational::bezier({{0, 0, 0}, {0, 0, 0}, {4, 5, 0}, {2, 9, 0}})), 0);
  ASSERT_EQ(path.size(), 1u);
  back.append(reversed(path[0].curve()), 0);
  ASSERT_EQ(back.size(), 1u);
  EXPECT_NEAR(back.length(), path.length(), 1e-12 * path.length());
  EXPECT_EQ(back[0].cusp_end(), path[0].cusp_begin());
  for (const double s : {0.0, 0.1, 3.0}) EXPECT_LE(norm(back.at(back.length() - s).value - path.at(s).value), 1e-9);
}

}  // namespace
}  // namespace bahnwerk
