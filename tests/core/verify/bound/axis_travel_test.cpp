// Times and speeds of single axes against closed forms and against motions that exist.
#include "core/verify/bound/axis_travel.hpp"

#include <gtest/gtest.h>

#include <random>

namespace bahnwerk::verify {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

TEST(AxisTravel, ClosedForms) {
  EXPECT_EQ(travel_time(0, 0, 0, 100, 10), 0);
  EXPECT_NEAR(travel_time(0, 0, 1, 100, unlimited), 2 * std::sqrt(1 / 100.0), 1e-15);  // accelerates, brakes
  EXPECT_NEAR(travel_time(0, 0, 4, 100, 10), 4 / 10.0 + 10 / 100.0, 1e-15);            // cruises in between
  EXPECT_NEAR(travel_time(0, 200, 1, 100, unlimited), std::sqrt(200.0) / 100, 1e-15);  // accelerates all the way
  EXPECT_NEAR(travel_time(25, 25, 2, 100, 5), 2 / 5.0, 1e-15);                         // at the limit throughout
  EXPECT_NEAR(travel_time(1e4, 1e4, 2, 100, 5), 2 / 5.0, 1e-15);                       // no faster than that
}

TEST(AxisTravel, NoMotionIsFasterThanTravelTime) {
  // Speed up by a, cruise, brake: with any share of the acceleration it takes longer.
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> share(0, 1);
  for (int i = 0; i < 2000; ++i) {
    const double a = 100, v0 = 10 * share(random), top = v0 + 10 * share(random), v1 = top * share(random),
                 up = a * (0.1 + 0.9 * share(random)), down = a * (0.1 + 0.9 * share(random)), hold = share(random);
    const double way = (top * top - v0 * v0) / (2 * up) + top * hold + (top * top - v1 * v1) / (2 * down);
    const double time = (top - v0) / up + hold + (top - v1) / down;
    EXPECT_LE(travel_time(v0 * v0, v1 * v1, way, a, top), time * (1 + 1e-13));
    EXPECT_LE(travel_time(v0 * v0, v1 * v1, way, a, unlimited), time * (1 + 1e-13));
  }
}

/// Speeds at the ends are upper bounds: what no motion over the way can have counts for less.
TEST(AxisTravel, EndsThatNoMotionJoinsCostNothing) {
  const double way = 1e-5, a = 9000, b = 6400;
  for (const double more : {1e-6, 1.0, 12.8, 1e4}) {
    const double most = std::sqrt(b + 2 * a * way);  // what can still brake to √b, or what √b can reach
    EXPECT_LE(travel_time(b + more, b, way, a, unlimited),
              2 * way / (std::min(most, std::sqrt(b + more)) + 80) * (1 + 1e-12));
    EXPECT_NEAR(travel_time(b, b + more, way, a, unlimited), travel_time(b + more, b, way, a, unlimited), 1e-15);
    EXPECT_NEAR(travel_time(b + more, b, way, a, 80), way / 80, 1e-12 * way);  // no end is above the limit
  }
}

template <int N>
void expect_slowest() {
  std::mt19937_64 random(N);
  std::uniform_real_distribution<double> size(0, 100);
  for (int i = 0; i < 500; ++i) {
    const auto some = [&] { return LanesOf<8>::type::each([&](std::size_t) { return size(random); }); };
    const auto e0 = some(), e1 = some(), way = some(), a = some(), v = some();
    std::array<double, N> p[5];
    double longest = 0;
    for (std::size_t k = 0; k < N; ++k) {
      p[0][k] = e0[k], p[1][k] = e1[k], p[2][k] = k == static_cast<std::size_t>(i) % (N + 1) ? 0 : way[k];
      p[3][k] = a[k], p[4][k] = i % 3 ? 0.3 * v[k] : unlimited;
      longest = std::max(longest, travel_time(p[0][k], p[1][k], p[2][k], p[3][k], p[4][k]));
    }
    EXPECT_NEAR(slowest<N>(lanes(p[0]), lanes(p[1]), lanes(p[2]), lanes(p[3]), lanes(p[4])), longest, 1e-14 * longest);
  }
}
TEST(AxisTravel, TheSlowestAxisCounts) {
  expect_slowest<2>();
  expect_slowest<3>();
  expect_slowest<8>();
}

TEST(AxisTravel, TheTightestConditionCounts) {
  BoundNode<2> a, b;
  a.tangent = {0.6, 0.8}, b.tangent = {0.8, -0.6};
  BoundCell<2> cell;
  cell.kind = BoundCell<2>::Kind::curved;
  cell.energy = {10, 1000};
  EXPECT_NEAR(across(cell, a, b, 100), (0.36 * 100 + 10) / 0.64, 1e-12);
  cell.energy = {1000, 10};
  EXPECT_NEAR(across(cell, a, b, 100), (0.64 * 100 + 10) / 0.36, 1e-12);
  b.tangent = {1, 0};  // of an axis that stands still there is nothing to say
  EXPECT_NEAR(across(cell, a, b, 100), 0.36 * 100 + 1000, 1e-12);
  b.rounding_error = 1;
  EXPECT_EQ(across(cell, a, b, 100), unlimited);
  cell.kind = BoundCell<2>::Kind::joint;
  EXPECT_EQ(across(cell, a, b, 100), 100);
}

}  // namespace
}  // namespace bahnwerk::verify
