#include "core/contour/gcode/moves/mover.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "core/numeric/random.hpp"

namespace bahnwerk::gcode {
namespace {

constexpr double pi = std::numbers::pi;

TEST(Mover, ARadiusHasTheCentreOfTheArcItMeans) {
  Random random(2);
  for (int i = 0; i < 300; ++i) {
    const double r = random.uniform(0.5, 20), begin = random.uniform(-pi, pi),
                 sweep = random.uniform(0.05, 2 * pi - 0.05);
    if (std::abs(sweep - pi) < 1e-3) continue;
    ArcMove how;
    how.plane = static_cast<Plane>(random.below(3));
    how.counter_clockwise = random.chance(0.5);
    const double turn = how.counter_clockwise ? sweep : -sweep, rise = random.uniform(-2, 2);
    const auto place = [&](double angle, double height) {
      const double u = r * std::cos(angle), v = r * std::sin(angle);
      return how.plane == Plane::xy   ? Vec{u, v, height}
             : how.plane == Plane::zx ? Vec{v, height, u}
                                      : Vec{height, u, v};
    };
    const Vec from = place(begin, 1), to = place(begin + turn, 1 + rise);
    const char* why = "";
    const auto centre = centre_by_radius(from, to, sweep < pi ? r : -r, how, why);
    ASSERT_TRUE(centre) << why;
    const RadiiOfArc radii = radii_of_arc(from, to, *centre, how.plane);
    EXPECT_NEAR(radii.begin, r, 1e-9);
    EXPECT_NEAR(radii.end, r, 1e-9);
    EXPECT_NEAR(arc_length(from, to, *centre, how), std::hypot(r * sweep, rise), 1e-6) << i;
    how.turns = 3;
    EXPECT_NEAR(arc_length(from, to, *centre, how), std::hypot(r * (sweep + 4 * pi), rise), 1e-6) << i;
  }
}

TEST(Mover, ARadiusThatMeansNoArcIsRefusedWithTheReason) {
  const auto reason = [](Vec to, double radius) {
    const char* why = nullptr;
    return centre_by_radius({}, to, radius, {}, why) ? std::string() : std::string(why);
  };
  EXPECT_NE(reason({0, 0, 3}, 1).find("full circle"), std::string::npos) << "the way along the normal is no chord";
  EXPECT_NE(reason({1, 0, 0}, 0).find("zero"), std::string::npos);
  EXPECT_NE(reason({3, 0, 0}, 1).find("too small"), std::string::npos);
  EXPECT_EQ(reason({2.01, 0, 0}, 1), "") << "half a turn, within the tolerance";
}

TEST(Mover, AFullCircleHasItsWholeLength) {
  EXPECT_NEAR(arc_length({3, 0, 0}, {3, 0, 0}, {}, {}), 6 * pi, 1e-12);
  ArcMove twice;
  twice.turns = 2;
  EXPECT_NEAR(arc_length({3, 0, 0}, {3, 0, 5}, {}, twice), std::hypot(12 * pi, 5), 1e-12);
}

// Both arcs of a turn whose radii differ: they meet with one tangent, and begin and end perpendicular to the radii.
TEST(Mover, HalvesMeetWithOneTangentAndStayNearTheSpiral) {
  Random random(6);
  int split = 0;
  for (int i = 0; i < 300; ++i) {
    ArcMove how;
    how.counter_clockwise = random.chance(0.5);
    const double r1 = random.uniform(1, 10), r2 = r1 + random.uniform(-0.01, 0.01), sweep = random.uniform(pi, 2 * pi);
    const double turn = how.counter_clockwise ? sweep : -sweep;
    const Vec from{r1, 0, 0}, to{r2 * std::cos(turn), r2 * std::sin(turn), 2};
    const auto halves = halves_of_arc(from, to, {}, how);
    if (!halves) continue;
    ++split;
    const auto flat = [](Vec v) { return Vec{v.x, v.y, 0}; };
    const Vec meet = flat(halves->middle), first = flat(halves->first), second = flat(halves->second);
    EXPECT_NEAR(norm(meet - first), norm(flat(from) - first), 1e-12);
    EXPECT_NEAR(norm(meet - second), norm(flat(to) - second), 1e-12);
    EXPECT_NEAR(norm(cross(meet - first, meet - second)), 0, 1e-10) << "one tangent";
    EXPECT_NEAR(norm(cross(from, from - first)), 0, 1e-10);
    EXPECT_NEAR(norm(cross(flat(to), flat(to) - second)), 0, 1e-10);
    EXPECT_NEAR(norm(meet), (r1 + r2) / 2, std::abs(r1 - r2)) << "the spiral's middle";
    EXPECT_EQ(halves->middle.z, 1);
  }
  EXPECT_GT(split, 30);
  EXPECT_FALSE(halves_of_arc({1, 0, 0}, {0, 1, 0}, {}, {Plane::xy, true})) << "less than half a turn";
  EXPECT_FALSE(halves_of_arc({1, 0, 0}, {0, -1, 0}, {}, {Plane::xy, true})) << "radii do not differ";
}

TEST(Mover, RepeatedPlacesAreNoMovesAndFlatContoursDoNotClimb) {
  Mover mover(true);
  mover.start({0, 0, 9});
  mover.use(Mode::cut, 10);
  mover.line({0, 0, 9});
  EXPECT_FALSE(mover.climbs());
  mover.line({5, 0, 4});
  EXPECT_TRUE(mover.climbs()) << "as programmed";
  mover.line({5, 0, 4});
  const Contour contour = mover.finish();
  ASSERT_EQ(contour.path.size(), 1u);
  EXPECT_EQ(contour.path.length(), 5) << "its heights are set to 0";
}

TEST(Mover, ABlockBeginsWhereModeOrFeedChange) {
  Mover mover(false);
  mover.start({});
  mover.use(Mode::cut, 10), mover.line({1, 0, 0});
  mover.use(Mode::cut, 10), mover.line({2, 0, 0});
  mover.use(Mode::cut, 20), mover.line({3, 0, 0});
  mover.use(Mode::position, 20), mover.line({4, 0, 0});
  EXPECT_EQ(mover.position().x, 4);
  EXPECT_EQ(mover.builder().blocks(), 3u);
}

}  // namespace
}  // namespace bahnwerk::gcode
