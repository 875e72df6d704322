#include "core/winding/needle/clearance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/base/errors.hpp"
#include "core/numeric/random.hpp"
#include "core/winding/part/space.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double pi = std::numbers::pi;
SilentProgress silent;

NeedleMove still(Space tip, double phi, double psi = 0) { return {{tip, phi, psi}, {tip, phi, psi}}; }

TEST(Clearance, InTheMiddleOfTheOpeningIsHalfOfWhatIsLeft) {
  const StatorPart part;
  const StatorIron iron(part, checked_slot(part));
  for (const double width : {0.5, 2.6, 3.083, 4.0}) {
    // Through the whole slot: 3.083 mm less the needle (Fig. 4.16 with 2.6 mm: 0.24 mm to either side).
    NeedleMove down = still({85, 0, 205}, 0);
    down.to.tip.z = 5;
    const Clearance c = clearance({down}, {width, 60}, {&iron}, 1e-6, silent);
    EXPECT_NEAR(c.minimum, (3.083 - width) / 2, 1e-6) << width;
    EXPECT_NEAR(85 - c.along, 95.7 - 16.429, 0.01) << "between the tooth tips";
  }
}

TEST(Clearance, IsFoundBetweenTheEndsOfAMove) {
  const Block post(0, 10, 12, -1, 1, 0, 20);
  // Past the post at 3 mm, with the needle along the axis; nearest in the middle of the move.
  NeedleMove past = still({15, -40, 10}, 0, -pi / 2);
  past.to.tip.y = 41;
  const Clearance c = clearance({still({60, 0, 0}, 0), past}, {2, 30}, {&post}, 1e-4, silent);
  EXPECT_NEAR(c.minimum, 2, 1.1e-4);
  EXPECT_EQ(c.move, 1u);
  // A round end: over the post's corner at (3, 0, 4) from its centre.
  const Clearance over = clearance({still({15, 0, 23}, 0, pi / 2)}, {2, 30}, {&post}, 1e-6, silent);
  EXPECT_NEAR(over.minimum, 5 - 1, 1.1e-6);
  EXPECT_NEAR(over.along, 1, 1e-6);
  // An arc about the axis at 15 mm, seen from the post's corner (12, 1).
  NeedleMove round = still({0, -15, 10}, -pi / 2, -pi / 2);
  round.arc = true;
  round.sweep = pi;
  round.to.phi = pi / 2;
  EXPECT_NEAR(clearance({round}, {2, 30}, {&post}, 1e-6, silent).minimum, 15 - std::hypot(12, 1) - 1, 1.1e-6);
  EXPECT_NEAR(norm(round.at(0.5).tip - Space{15, 0, 10}), 0, 1e-12);
}

// Against dense samples, for moves in, through and out of slots with swivelling needles.
TEST(Clearance, IsTheLeastOfADenseSample) {
  Random random(11);
  const StatorPart part;
  const StatorIron iron(part, checked_slot(part));
  const std::vector<Block> posts = tool_posts(part, {}, {0, 5});
  std::vector<const Obstacle*> obstacles{&iron};
  for (const Block& b : posts) obstacles.push_back(&b);
  int touching = 0;
  for (int round = 0; round < 40; ++round) {
    NeedleMove move;
    for (NeedlePose* p : {&move.from, &move.to}) {
      p->tip = random.uniform(60, 104) * radial(random.uniform(-0.02, 0.02)) + Space{0, 0, random.uniform(-30, 40)};
      p->phi = random.uniform(-0.1, 0.1);
      p->psi = random.uniform(-pi / 2, 0);
    }
    const NeedleShape needle{random.uniform(0.2, 3), random.uniform(10, 40)};
    const double tolerance = 0.01;
    const Clearance c = clearance({move}, needle, obstacles, tolerance, silent);
    double least = std::numeric_limits<double>::infinity();
    const int n = 100;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) {
        const NeedlePose pose = move.at(i / double(n));
        const double s = needle.width / 2 + j / double(n) * (needle.length - needle.width / 2);
        for (const Obstacle* o : obstacles)
          least = std::min(least, o->distance(pose.tip - s * pose.direction()) - needle.width / 2);
      }
    EXPECT_GE(least, c.minimum - tolerance) << round;
    const NeedlePose where = move.at(c.at);
    EXPECT_NEAR(obstacles.at(c.obstacle)->distance(where.tip - c.along * where.direction()) - needle.width / 2,
                c.minimum, 1e-12)
        << "reached where it is reported";
    touching += c.minimum < 0;
  }
  EXPECT_GT(touching, 5);
  EXPECT_LT(touching, 40);
}

// What the pivot shift is for: beside the slot's middle a needle that swivels about the opening keeps its distance.
TEST(Clearance, PivotShiftOpensTheSlotsSides) {
  const StatorPart part;
  const StatorIron iron(part, checked_slot(part));
  const Space pivot{95.7 - 16.429, 0, 0}, along{0, 0, -1};
  int better = 0;
  for (const double depth : {8.0, 10.0, 12.0})
    for (const double x : {-1.2, -0.6, 0.6, 1.2}) {
      const Space place{79.3 + depth, x, 100};
      const auto with = [&](std::optional<double> limit) {
        const NeedlePose pose = slot_support(place, along, 2, 1, pivot, limit).pose;
        return clearance({still(pose.tip, pose.phi)}, {2.6, 60}, {&iron}, 1e-6, silent).minimum;
      };
      const double straight = with(std::nullopt), shifted = with(0.3);
      EXPECT_GT(shifted, straight);
      better += straight < 0 && shifted > 0;
      EXPECT_NEAR(straight, with(0.0), 1e-9) << "no shift allowed";
    }
  EXPECT_GT(better, 5) << "places that only the shift makes accessible";
}

TEST(Clearance, OfAWholeCoilAsksAndEnds) {
  const StatorPart part;
  const Slot slot = checked_slot(part);
  const std::vector<Coil> coils{{0, 5}};
  const LayingRegions regions = coil_regions(part, slot, coils[0]);
  const NeedleLayout layouts = needle(regions, 0.45, slot.tension_point, silent);
  const auto pieces =
      support_points(part, coils, turns_of({regions}, layouts, layouts[0].wires.size(), 0.45), NeedleModel{});
  const StatorIron iron(part, slot);
  struct Counting final : Progress {
    void report(std::string_view, double, std::string_view) override { ++calls; }
    int calls = 0;
  } counting;
  std::vector<NeedleMove> moves = straight_links(pieces);
  EXPECT_EQ(moves.size(), 2 * pieces.size() - 1);
  const Clearance c = clearance(moves, {2.6, 60}, {&iron}, 0.01, counting);
  EXPECT_GT(counting.calls, 0);
  EXPECT_LT(counting.calls, 2000) << "two million looks at 0.2 µs";
  EXPECT_LT(c.minimum, (3.083 - 2.6) / 2 + 0.01);
}

TEST(Clearance, ImpossibleNeedlesAreRefused) {
  const auto refused = [](NeedleShape shape) -> std::string {
    try {
      clearance({}, shape, {}, 0.01, silent);
    } catch (const InvalidInput& e) {
      return e.faults.at(0).place.back();
    }
    return "";
  };
  EXPECT_EQ(refused({0, 60}), "width");
  EXPECT_EQ(refused({2.6, 2}), "length");
  EXPECT_EQ(refused({2.6, std::numeric_limits<double>::infinity()}), "length");
  EXPECT_EQ(refused({2.6, 60}), "");
  EXPECT_TRUE(std::isinf(clearance({}, {2.6, 60}, {}, 0.01, silent).minimum));
  EXPECT_THROW(clearance({}, {2.6, 60}, {}, 0, silent), std::invalid_argument);
}

}  // namespace
}  // namespace bahnwerk::winding
