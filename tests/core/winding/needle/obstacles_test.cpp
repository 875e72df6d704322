#include "core/winding/needle/obstacles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "core/base/errors.hpp"
#include "core/numeric/random.hpp"
#include "core/winding/part/vec3.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double pi = std::numbers::pi;

StatorIron iron(const StatorPart& part) { return StatorIron(part, checked_slot(part)); }

TEST(StatorIron, OpeningIsAsWideAsTheTipsLeave) {
  for (int slots : {4, 12, 48, 60}) {
    StatorPart part;
    part.slots = slots;
    const StatorIron stator = iron(part);
    const double narrowest = 95.7 - 16.129 - 0.3;
    for (int n = 0; n < slots; n += 3) {
      const Vec3 middle = narrowest * radial(n * part.pitch()) + Vec3{0, 0, 100};
      EXPECT_NEAR(stator.distance(middle), 3.083 / 2, 1e-9) << slots;
      // 1 mm towards a tip and 0.4 mm outwards: to the half circle about (b_t/2, h + r_et).
      const Vec3 beside = turned({narrowest + 0.4, 1, 100}, n * part.pitch());
      EXPECT_NEAR(stator.distance(beside), std::hypot(3.683 / 2 - 1, 0.4) - 0.3, 1e-9);
    }
    // The axis is a bore's radius from all teeth; half a pitch beside a slot there is a tooth.
    const double bore = std::hypot(3.683 / 2, 95.7 - 16.129 - 0.6);
    EXPECT_NEAR(stator.distance({0, 0, 50}), std::hypot(3.683 / 2, narrowest) - 0.3, 1e-9) << "tips round inwards";
    EXPECT_NEAR(stator.distance((bore - 2) * radial(part.pitch() / 2) + Vec3{0, 0, 50}), 2, 1e-9);
    EXPECT_NEAR(stator.distance((bore + 1) * radial(part.pitch() / 2) + Vec3{0, 0, 50}), -1, 1e-9);
    // Above and below the stack.
    EXPECT_NEAR(stator.distance((bore + 3) * radial(part.pitch() / 2) + Vec3{0, 0, 212}), 2, 1e-12);
    EXPECT_NEAR(stator.distance({narrowest, 0, -4}), std::hypot(3.083 / 2, 4), 1e-9);
  }
}

TEST(StatorIron, WithOneSlotTheOthersAreIron) {
  Random random(46);
  const StatorPart part;
  const StatorIron stator = iron(part);
  const double pitch = part.pitch(), bore = part.heads.base_radius - part.slot.height;
  for (const int n : {0, 7, 47}) {
    const double slot = slot_azimuth(part, n);
    const OneSlot own(stator, slot);
    EXPECT_FALSE(own.convex());
    for (int i = 0; i < 2000; ++i) {
      const double aside = random.uniform(-pi, pi);
      const Vec3 p = random.uniform(bore + 0.5, 100) * radial(slot + aside) + Vec3{0, 0, random.uniform(-5, 215)};
      if (std::abs(aside) <= pitch / 2) {
        EXPECT_NEAR(own.distance(p), stator.distance(p), 1e-12);
      } else {
        EXPECT_LT(own.section_distance(p), 0) << aside;
      }
    }
  }
}

TEST(StatorIron, ChangesByNoMoreThanThePointMoves) {
  Random random(8);
  const StatorPart part;
  const StatorIron stator = iron(part);
  int inside = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p = random.uniform(70, 100) * radial(random.uniform(-pi, pi)) + Vec3{0, 0, random.uniform(-5, 215)};
    const Vec3 q = p + Vec3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    const double a = stator.distance(p), b = stator.distance(q);
    EXPECT_LE(std::abs(a - b), norm(p - q) + 1e-9);
    EXPECT_LE(stator.section_distance(p), a + 1e-12);
    EXPECT_NEAR(stator.distance(turned(p, 7 * part.pitch())), a, 1e-9) << "every slot alike";
    EXPECT_NEAR(stator.distance({p.x, -p.y, p.z}), a, 1e-9) << "slots are symmetric";
    inside += a < 0;
  }
  EXPECT_GT(inside, 1000);
}

TEST(StatorIron, SharpTipsAndImpossibleBores) {
  StatorPart sharp;
  sharp.slot.tip_corner_radius = 0;
  EXPECT_NEAR(iron(sharp).distance({95.7 - 16.129, 0, 100}), 3.683 / 2, 1e-9);
  StatorPart thin;
  thin.heads.base_radius = 16.5;
  thin.slots = 6;
  thin.slot.base_radius = 16.28;
  EXPECT_THROW(iron(thin), InvalidInput);
}

TEST(Block, DistanceInClosedForm) {
  const Block block(pi / 2,
                    {.inner = 10, .outer = 14, .left = -1, .right = 3, .low = 0, .high = 6});  // along y; left is −x
  EXPECT_NEAR(block.distance({-1, 12, 3}), -2, 1e-12);
  EXPECT_NEAR(block.distance({-1, 12, 7}), 1, 1e-12);
  EXPECT_NEAR(block.distance({1 + 3, 14 + 4, 3}), 5, 1e-12) << "off an edge";
  EXPECT_NEAR(block.distance({-3 - 2, 10 - 3, 6 + 6}), 7, 1e-12) << "off a corner";
  EXPECT_NEAR(block.distance({-2.5, 12, 3}), -0.5, 1e-12);
}

TEST(Block, LiesBehindThePlaneAtItsNearestPoint) {
  Random random(9);
  const Block block(0.4, {.inner = 10, .outer = 14, .left = -1, .right = 3, .low = 0, .high = 6});
  const auto any = [&] { return Vec3{random.uniform(4, 18), random.uniform(-4, 14), random.uniform(-5, 12)}; };
  int inside = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p = any(), q = any(), n = block.away(p);
    EXPECT_NEAR(norm(n), 1, 1e-12);
    EXPECT_GE(block.distance(q), block.distance(p) + dot(n, q - p) - 1e-9);
    inside += block.distance(p) < 0;
  }
  EXPECT_GT(inside, 300);
}

TEST(ToolPosts, StandBehindBothSlotsTowardsTheCoilsMiddle) {
  const StatorPart part;
  for (const Coil coil : {Coil{3, 5}, Coil{3, -5}, Coil{40, 24}}) {
    const std::vector<Block> posts = tool_posts(part, {.width = 4, .thickness = 3, .height = 20}, coil);
    ASSERT_EQ(posts.size(), 4u);
    const LayingRegions regions = coil_regions(part, checked_slot(part), coil);
    // The wires' corner lies on the post's outer face, in its middle.
    const Vec3 first = regions.at[1].begin.place({0, 0}), second = regions.at[1].end.place({0, 0});
    EXPECT_NEAR(posts[0].distance(first), 0, 1e-12);
    EXPECT_NEAR(posts[2].distance(second), 0, 1e-12);
    EXPECT_NEAR(posts[0].distance(1.02 * first + Vec3{0, 0, 0.02 * 15.5}), 0.02 * 99.971, 1e-6);
    EXPECT_NEAR(posts[1].distance(regions.at[3].end.place({0, 0})), 0, 1e-12);
    EXPECT_NEAR(posts[3].distance(regions.at[3].begin.place({0, 0})), 0, 1e-12);
  }
  try {
    tool_posts(part, {.width = 0, .thickness = 3, .height = -1}, {0, 5});
    ADD_FAILURE();
  } catch (const InvalidInput& e) {
    ASSERT_EQ(e.faults.size(), 2u);
    EXPECT_EQ(e.faults[0].place.back(), "width");
    EXPECT_EQ(e.faults[1].place.back(), "height");
  }
}

}  // namespace
}  // namespace bahnwerk::winding
