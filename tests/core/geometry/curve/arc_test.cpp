#include "core/geometry/curve/arc.hpp"

#include <limits>
#include <numbers>

#include "tests/core/geometry/support.hpp"

namespace bahnwerk {
namespace {

using testing::expect_near;
using testing::fault_places;
using Places = std::vector<std::string>;
constexpr double pi = std::numbers::pi;

TEST(Arc, DerivativesOfArcAndHelix) {
  const double c = std::cos(0.4), s = std::sin(0.4);
  const Arc arc({3, -2, 1}, {c, s, 0}, {-s, c, 0}, 7, 2.5);
  const Arc helix({3, -2, 1}, {c, 0, s}, {0, 1, 0}, 7, -4, 11);
  for (const Arc* a : {&arc, &helix}) {
    testing::expect_consistent([&](double u) { return a->at(u); }, 0, 1, 1e-11);
    for (double u = 0; u <= 1; u += 0.1) EXPECT_NEAR(norm(a->at(u).d1), a->speed(u), 1e-13 * a->speed(u));
  }
  EXPECT_NEAR(helix.length(), std::hypot(28, 11), 1e-13);
}

TEST(Arc, ThroughTurnsTheAskedWay) {
  const Vec up{0, 0, 1};
  const Arc ccw = Arc::through({10, 0, 0}, {0, 10, 0}, {}, up, true);
  EXPECT_NEAR(ccw.sweep(), pi / 2, 1e-15);
  const Arc cw = Arc::through({10, 0, 0}, {0, 10, 0}, {}, up, false);
  EXPECT_NEAR(cw.sweep(), -3 * pi / 2, 1e-15);
  expect_near(ccw.at(0.5).value, Vec{10 * std::sqrt(0.5), 10 * std::sqrt(0.5), 0}, 1e-14);
  expect_near(cw.at(1).value, Vec{0, 10, 0}, 1e-14);
  const Arc from_below = Arc::through({10, 0, 0}, {0, 10, 0}, {}, -up, true);
  expect_near(from_below.at(1.0 / 3).value, Vec{0, -10, 0}, 1e-14);
  const Arc half = Arc::through({10, 0, 0}, {-10, 0, 0}, {}, up, false);
  expect_near(half.at(0.5).value, Vec{0, -10, 0}, 1e-14);
}

TEST(Arc, EqualPointsAreAFullCircleAndClimbing) {
  const Arc circle = Arc::through({10, 0, 0}, {10, 0, 0}, {}, {0, 0, 2}, true);
  EXPECT_EQ(circle.sweep(), 2 * pi);
  expect_near(circle.at(1).value, Vec{10, 0, 0}, 1e-14);
  const Arc helix = Arc::through({10, 0, 1}, {10, 0, 6}, {0, 0, 77}, {0, 0, 1}, false);
  EXPECT_EQ(helix.sweep(), -2 * pi);
  EXPECT_EQ(helix.rise(), 5);
  expect_near(helix.centre(), Vec{0, 0, 1}, 0);
  expect_near(helix.at(1).value, Vec{10, 0, 6}, 1e-13);
  EXPECT_NEAR(helix.length(), std::hypot(20 * pi, 5), 1e-12);
}

TEST(Arc, MovesARoundedCentreOntoTheBisector) {
  Random random(11);
  for (int i = 0; i < 2000; ++i) {
    const double r = std::pow(10.0, random.uniform(-1, 3)), a = random.uniform(0, 2 * pi);
    const double turn = random.uniform(0.3, 6), size = random.uniform(0, 0.0049);
    const Vec centre{random.uniform(-100, 100), random.uniform(-100, 100), 0};
    const Vec from = centre + r * Vec{std::cos(a), std::sin(a), 0},
              to = centre + r * Vec{std::cos(a + turn), std::sin(a + turn), 0};
    const Vec rounded = centre + size * Vec{std::cos(5 * a), std::sin(5 * a), 0};
    const Arc arc = Arc::through(from, to, rounded, {0, 0, 1}, true);
    expect_near(arc.at(0).value, from, 1e-13 * (100 + r));
    expect_near(arc.at(1).value, to, 1e-13 * (100 + r));
    // Minimal: along the chord alone.
    EXPECT_NEAR(norm(cross(arc.centre() - rounded, to - from)), 0, 1e-10 * norm(to - from));
    EXPECT_NEAR(arc.sweep(), turn, 0.05 / std::min(r, 1.0));
  }
}

TEST(Arc, ShortArcsOfLargeRadiusKeepTheirDigits) {
  const double r = 1e5, x = 1e-3, y = r - std::sqrt(r * r - x * x);
  const Arc arc = Arc::through({0, 0, 0}, {x, y, 0}, {0, r, 0}, {0, 0, 1}, true);
  EXPECT_NEAR(arc.length(), r * std::asin(x / r), 1e-15);
  expect_near(arc.at(1).value, Vec{x, y, 0}, 1e-17);
}

TEST(Arc, RejectsWhatIsNoArc) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const Vec up{0, 0, 1};
  EXPECT_EQ(fault_places([&] { Arc::through({10, 0, 0}, {0, 10.02, 0}, {}, up, true); }), Places{"/arc/center"});
  EXPECT_EQ(fault_places([&] { Arc::through({10, 0, 0}, {0, 10.009, 0}, {}, up, true); }), Places{});
  EXPECT_EQ(fault_places([&] { Arc::through({1, 1, 0}, {1, 1, 0}, {1, 1, 0}, up, true); }), Places{"/arc/center"});
  EXPECT_EQ(fault_places([&] { Arc::through({1, 1, 0}, {1, 1.005, 0}, {1, 1, 0}, up, true); }), Places{"/arc/center"});
  EXPECT_EQ(fault_places([&] { Arc::through({nan, 0, 0}, {0, 10, 0}, {}, up, true); }), Places{"/arc"});
  EXPECT_EQ(fault_places([&] { Arc::through({10, 0, 0}, {0, inf, 0}, {}, up, true); }), Places{"/arc"});
  EXPECT_EQ(fault_places([&] { Arc::through({10, 0, 0}, {0, 10, 0}, {}, {}, true); }), Places{"/arc/normal"});
  // Almost closed, but radially: no circle of about this radius passes through both.
  EXPECT_EQ(fault_places([&] { Arc::through({10, 0, 0}, {10.005, -0.001, 0}, {}, up, true); }), Places{"/arc/center"});
}

}  // namespace
}  // namespace bahnwerk
