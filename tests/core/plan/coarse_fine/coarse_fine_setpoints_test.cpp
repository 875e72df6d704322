#include "core/plan/coarse_fine/coarse_fine_setpoints.hpp"

#include <gtest/gtest.h>

#include <iterator>
#include <memory>

#include "core/contour/builder.hpp"
#include "core/motion/axes/spline_motion.hpp"

namespace bahnwerk {
namespace {

TEST(CoarseFineSetpoints, FineColumnsAreTheHeadsLessTheCoarseOnesInEveryRow) {
  ContourBuilder b(2, {1, 2, 0});
  b.block(Mode::cut, 3);
  b.line({4, 6, 0});
  const Contour contour = b.finish();
  TimeLaw law;  // 5 mm at 2.5 mm/s
  law.append({0, 2, 0, 5, 2.5, 0, 0, 0, 0});
  const auto head = std::make_shared<const PathMotion>(std::make_shared<const CartesianAxisPath>(contour.path, 2), law);
  // Half of the head's displacement, from rest to rest: x = 3 τ² − 2 τ³ with τ = t/2.
  const auto half = [](double begin, double way) { return Polynomial{begin, 0, way * 0.75, -way * 0.25}; };
  const auto coarse =
      std::make_shared<const SplineMotion>(std::vector<SplineMotion::Piece>{{2, {half(1, 3), half(2, 4)}}});
  const Machine machine{{AxisLimits("x", 100), AxisLimits("y", 100)}, 0.5};
  const CoarseFineSetpoints rows(head, coarse, contour, machine, 4);
  const char* names[] = {"x",  "y",  "vx", "vy",  "ax",  "ay",  "s",   "v",   "mode", "block", "xc",
                         "yc", "xf", "yf", "vxc", "vyc", "vxf", "vyf", "axc", "ayc",  "axf",   "ayf"};
  ASSERT_EQ(rows.columns().size(), std::size(names));
  for (std::size_t i = 0; i < std::size(names); ++i) EXPECT_EQ(rows.columns()[i].name, names[i]);
  EXPECT_EQ(rows.columns()[20].unit, "mm/s²");
  ASSERT_EQ(rows.count(), 5u);
  for (std::size_t k = 0; k < 5; ++k) {
    double row[22];
    rows.read(k, 1, row);
    const double t = 0.5 * static_cast<double>(k), way = t * t * (0.75 - 0.25 * t);
    EXPECT_NEAR(row[10], 1 + 3 * way, 1e-14) << k;
    EXPECT_NEAR(row[11], 2 + 4 * way, 1e-14) << k;
    EXPECT_NEAR(row[14], 3 * t * (1.5 - 0.75 * t), 1e-14) << k;
    EXPECT_NEAR(row[19], 4 * (1.5 - 1.5 * t), 1e-14) << k;
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t order = 0; order < 3; ++order)
        EXPECT_EQ(row[12 + 4 * order + i], row[2 * order + i] - row[10 + 4 * order + i]) << k;
  }
}

}  // namespace
}  // namespace bahnwerk
