#include "core/geometry/curve/nurbs.hpp"

#include <limits>

#include "tests/core/geometry/support.hpp"

namespace bahnwerk {
namespace {

using testing::expect_near;
using testing::fault_places;
using Places = std::vector<std::string>;

TEST(Nurbs, PiecesAgreeWithTheIndependentEvaluation) {
  Random random(31);
  for (int i = 0; i < 1500; ++i) {
    const Nurbs curve = testing::random_nurbs(random);
    const auto spans = curve.spans();
    const auto pieces = curve.pieces();
    ASSERT_EQ(spans.size(), pieces.size());
    for (std::size_t k = 0; k < spans.size(); ++k) {
      const auto [a, b] = spans[k];
      const double width = b - a;
      Jet size;  // the largest of each kind on the piece, in x
      size.value.x = pieces[k].extent();
      for (double t = 0; t <= 1; t += 0.03125) {
        const Jet jet = pieces[k].at(t);
        size.d1.x = std::max({size.d1.x, norm(jet.d1), size.value.x});
        size.d2.x = std::max({size.d2.x, norm(jet.d2), size.d1.x});
        size.d3.x = std::max({size.d3.x, norm(jet.d3), size.d2.x});
      }
      for (double t : {0.0, 0.1, 0.5, 0.77, 0.999}) {
        const Jet x = curve.at(a + t * width), y = pieces[k].at(t);
        expect_near(x.value, y.value, 1e-12 * size.value.x, "value");
        expect_near(width * x.d1, y.d1, 1e-12 * size.d1.x, "d1");
        expect_near(width * width * x.d2, y.d2, 1e-11 * size.d2.x, "d2");
        expect_near(width * width * width * x.d3, y.d3, 1e-10 * size.d3.x, "d3");
      }
    }
    if (HasFailure()) FAIL() << "curve " << i;
  }
}

TEST(Nurbs, DerivativesAgreeWithDifferences) {
  Random random(32);
  for (int i = 0; i < 200; ++i) {
    const Nurbs curve = testing::random_nurbs(random);
    const auto [a, b] = curve.spans().front();
    testing::expect_consistent([&, c = &curve](double u) { return c->at(u); }, a, b, 1e-9);
    if (HasFailure()) FAIL() << "curve " << i;
  }
}

Nurbs circle(double r, Vec centre) {
  const double h = std::sqrt(0.5);
  std::vector<Vec> points;
  for (const auto& [x, y] :
       std::vector<std::pair<int, int>>{{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}})
    points.push_back(centre + r * Vec{double(x), double(y), 0});
  return {2, points, {1, h, 1, h, 1, h, 1, h, 1}, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}};
}

TEST(Nurbs, CircleOfRationalQuadratics) {
  const Nurbs curve = circle(10, {3, 4, 0});
  for (double u = 0; u <= 4; u += 0.01) {
    const Jet jet = curve.at(u);
    EXPECT_NEAR(norm(jet.value - Vec{3, 4, 0}), 10, 1e-13);
    const double speed = norm(jet.d1);
    EXPECT_NEAR(norm(cross(jet.d1, jet.d2)) / (speed * speed * speed), 0.1, 1e-13);
  }
  EXPECT_EQ(curve.pieces().size(), 4U);
}

TEST(Nurbs, AnUnclampedUniformCubicIsTheCardinalSpline) {
  const Nurbs curve{3, {{0, 0, 0}, {6, 0, 0}, {6, 6, 0}, {0, 6, 0}, {0, 0, 0}}, {}, {0, 1, 2, 3, 4, 5, 6, 7, 8}};
  EXPECT_EQ(curve.begin(), 3);
  EXPECT_EQ(curve.end(), 5);
  expect_near(curve.at(3).value, Vec{5, 1, 0}, 1e-14);  // (P₀ + 4 P₁ + P₂)/6
  expect_near(curve.at(3).d1, Vec{3, 3, 0}, 1e-14);     // (P₂ − P₀)/2
  expect_near(curve.at(5).value, Vec{1, 5, 0}, 1e-14);
}

TEST(Nurbs, FaultsAreFoundWhereTheyAre) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vec> p4{{0, 0, 0}, {1, 1, 0}, {2, 0, 0}, {3, 1, 0}};
  const auto faults = [](std::size_t degree, std::vector<Vec> points, std::vector<double> weights,
                         std::vector<double> knots) {
    return fault_places([&] { Nurbs(degree, points, weights, knots); });
  };
  EXPECT_EQ(faults(3, p4, {}, {0, 0, 0, 0, 1, 1, 1, 1}), Places{});
  EXPECT_EQ(faults(0, p4, {}, {}), Places{"/nurbs/degree"});
  EXPECT_EQ(faults(17, p4, {}, {}), Places{"/nurbs/degree"});
  EXPECT_EQ(faults(3, {{0, 0, 0}}, {}, {0, 0, 0, 1, 1}), Places{"/nurbs/points"});
  EXPECT_EQ(faults(3, p4, {}, {0, 0, 0, 1, 1, 1, 1}), Places{"/nurbs/knots"});
  EXPECT_EQ(faults(3, p4, {}, {0, 0, 0, 0.5, 0.4, 1, 1, 1}), Places{"/nurbs/knots/4"});
  EXPECT_EQ(faults(3, p4, {}, {0, 0, 0, nan, 1, 1, 1, 1}), (Places{"/nurbs/knots/3"}));
  EXPECT_EQ(faults(3, p4, {}, {0, 0, 0, 0, 0, 1, 1, 1}), Places{"/nurbs/knots"});
  EXPECT_EQ(faults(3, p4, {}, {1, 1, 1, 1, 1, 1, 1, 1}), Places{"/nurbs/knots"});
  EXPECT_EQ(faults(3, p4, {1, 1, 1, -1}, {0, 0, 0, 0, 1, 1, 1, 1}), Places{"/nurbs/weights/3"});
  EXPECT_EQ(faults(3, p4, {1, 1, 0, nan}, {0, 0, 0, 0, 1, 1, 1, 1}), (Places{"/nurbs/weights/2", "/nurbs/weights/3"}));
  EXPECT_EQ(faults(3, p4, {1, 1}, {0, 0, 0, 0, 1, 1, 1, 1}), Places{"/nurbs/weights"});
  EXPECT_EQ(faults(1, {{0, 0, 0}, {nan, 0, 0}}, {}, {0, 0, 1, 1}), Places{"/nurbs/points/1"});
  EXPECT_EQ(faults(1, p4, {}, {0, 0, 1, 1, 2, 2}), Places{"/nurbs/knots/3"});            // torn
  EXPECT_EQ(faults(1, {p4[0], p4[1], p4[1], p4[2]}, {}, {0, 0, 1, 1, 2, 2}), Places{});  // held together
  EXPECT_EQ(faults(1, {p4[0], p4[1], p4[1], p4[1], p4[2]}, {}, {0, 0, 1, 1, 1, 2, 2}), Places{"/nurbs/knots/4"});
}

}  // namespace
}  // namespace bahnwerk
