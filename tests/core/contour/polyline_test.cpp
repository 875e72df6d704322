#include "core/contour/polyline.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/base/errors.hpp"

namespace bahnwerk {
namespace {

TEST(Polyline, ClosedReturnsToItsStart) {
  const Contour open = polyline(2, {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}}, false, 100);
  const Contour closed = polyline(2, {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}}, true, 100);
  EXPECT_NEAR(open.path.length(), 20, 1e-12);
  EXPECT_NEAR(closed.path.length(), 20 + std::sqrt(200.0), 1e-12);
}

TEST(Polyline, NamesEveryBadPoint) {
  const double inf = std::numeric_limits<double>::infinity();
  try {
    polyline(2, {{0, 0, 0}, {inf, 0, 0}, {1, 1, 0}, {0, -inf, 0}}, false, 100);
    FAIL() << "accepted";
  } catch (const InvalidInput& e) {
    ASSERT_EQ(e.faults.size(), 2u);
    EXPECT_EQ(e.faults[0].place, (std::vector<std::string>{"contour", "points", "1"}));
    EXPECT_EQ(e.faults[1].place, (std::vector<std::string>{"contour", "points", "3"}));
  }
  EXPECT_THROW(polyline(2, {{0, 0, 0}}, false, 100), InvalidInput);
  EXPECT_THROW(polyline(2, {{0, 0, 0}, {0, 0, 0}}, true, 100), InvalidInput);
}

}  // namespace
}  // namespace bahnwerk
