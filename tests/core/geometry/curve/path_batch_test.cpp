/// A batch says what single points say: every kind of curve, odd counts, ends, panels' borders.
#include "core/geometry/curve/path_batch.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/line.hpp"
#include "core/geometry/curve/nurbs.hpp"
#include "core/geometry/path/path.hpp"
#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

void expect_same(const Segment& segment, double from, double to, std::size_t count) {
  PathBatch batch;
  batch.count = count;
  for (std::size_t i = 0; i < count; ++i)
    batch.u.set(i, count == 1 ? from : from + (to - from) * static_cast<double>(i) / static_cast<double>(count - 1));
  segment.at_parameters(batch);
  for (std::size_t i = 0; i < count; ++i) {
    const double u = batch.u[i];
    const PathPoint p = segment.at_parameter(u);
    EXPECT_NEAR(batch.s[i], segment.travelled(u), 1e-13 * segment.length());
    const double bend = norm(p.d2), twist = norm(p.d3);
    for (std::size_t k = 0; k < 3; ++k) {
      const bool flat = k == 2 && batch.planar;
      EXPECT_NEAR(flat ? 0 : batch.d1[k][i], p.d1[k], 1e-13);
      EXPECT_NEAR(flat ? 0 : batch.d2[k][i], p.d2[k], 1e-12 * (bend + 1e-3));
      EXPECT_NEAR(flat ? 0 : batch.d3[k][i], p.d3[k], 1e-11 * (twist + bend * bend + 1e-3));
    }
  }
}

TEST(PathBatch, EqualsSinglePoints) {
  Random random(5);
  std::vector<std::shared_ptr<const Curve>> curves;
  curves.push_back(std::make_shared<Line>(Vec{1, 2, 3}, Vec{4, -5, 6}));
  curves.push_back(std::make_shared<Arc>(Vec{3, 1, 0}, Vec{1, 0, 0}, Vec{0, 1, 0}, 7, -5.0));
  curves.push_back(std::make_shared<Arc>(Vec{3, 1, 2}, Vec{0, 0, 1}, Vec{0, 1, 0}, 7, 6.0, 3));
  for (const bool weights : {false, true})
    for (const double depth : {0.0, 1.0})
      for (std::size_t degree = 2; degree <= 7; ++degree) {
        std::vector<Vec> points;
        std::vector<double> w;
        for (std::size_t i = 0; i <= degree; ++i) {
          points.push_back({10.0 * static_cast<double>(i), random.uniform(-9, 9), depth * random.uniform(-9, 9)});
          w.push_back(weights ? random.uniform(0.5, 2) : 1);
        }
        curves.push_back(std::make_shared<Rational>(Rational::bezier(points, w)));
      }
  // Tangents that vanish at an end and inside.
  curves.push_back(std::make_shared<Rational>(Rational::from_power_basis({{0, 0, 10}, {0, 0, 0, 10}})));
  curves.push_back(std::make_shared<Rational>(Rational::from_power_basis({{0, 0, 10, 3}, {0, 0, 5, -10}})));
  for (const auto& curve : curves) {
    Path path;
    path.append(curve, 0);
    for (std::size_t i = 0; i < path.size(); ++i) {
      const double u0 = path[i].curve().begin(), u1 = path[i].curve().end();
      expect_same(path[i], u0, u1, 16);
      for (int n = 0; n < 40; ++n) {
        const double at = u0 + (u1 - u0) * random.uniform(), wide = (u1 - at) * std::pow(10, random.uniform(-4, 0));
        expect_same(path[i], at, at + wide, 1 + random.below(16));
      }
    }
  }
}

}  // namespace
}  // namespace bahnwerk
