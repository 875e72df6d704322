#include "core/geometry/curve/curvature.hpp"

#include "tests/core/geometry/support.hpp"

namespace bahnwerk {
namespace {

using testing::expect_near;

TEST(ByArcLength, ParabolaInClosedForm) {
  // (u, u²): κ = 2/(1 + 4u²)^{3/2}, dκ/ds = −24 u/(1 + 4u²)³.
  for (double u = -2; u <= 2; u += 0.1) {
    const double q = 1 + 4 * u * u;
    const Jet point = by_arc_length({{u, u * u, 0}, {1, 2 * u, 0}, {0, 2, 0}, {}});
    EXPECT_NEAR(norm(point.d1), 1, 1e-15);
    EXPECT_NEAR(dot(point.d1, point.d2), 0, 1e-15);
    EXPECT_NEAR(curvature(point), 2 / (q * std::sqrt(q)), 1e-15);
    EXPECT_NEAR(curvature_rate(point), -24 * u / (q * q * q), 1e-14);
    EXPECT_NEAR(dot(point.d1, point.d3), -dot(point.d2, point.d2), 1e-15);
  }
}

TEST(ByArcLength, DoesNotDependOnTheParameter) {
  // The same space curve (v, v², v³) over v and over u with v = u + 0.3 u³.
  const auto plain = [](double v) {
    return Jet{{v, v * v, v * v * v}, {1, 2 * v, 3 * v * v}, {0, 2, 6 * v}, {0, 0, 6}};
  };
  for (double u = -1; u <= 1; u += 0.1) {
    const double v = u + 0.3 * u * u * u, v1 = 1 + 0.9 * u * u, v2 = 1.8 * u, v3 = 1.8;
    const Jet h = plain(v);
    const Jet chained{h.value, v1 * h.d1, v1 * v1 * h.d2 + v2 * h.d1,
                      v1 * v1 * v1 * h.d3 + 3 * v1 * v2 * h.d2 + v3 * h.d1};
    const Jet a = by_arc_length(h), b = by_arc_length(chained);
    expect_near(a.d1, b.d1, 1e-14);
    expect_near(a.d2, b.d2, 1e-13);
    expect_near(a.d3, b.d3, 1e-12);
  }
}

TEST(Curvature, StraightIsZero) {
  const Jet point = by_arc_length({{}, {3, 4, 0}, {}, {}});
  EXPECT_EQ(curvature(point), 0);
  EXPECT_EQ(curvature_rate(point), 0);
}

}  // namespace
}  // namespace bahnwerk
