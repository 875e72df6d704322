#include "core/winding/needle/channel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/numeric/random.hpp"
#include "core/winding/needle/clearance.hpp"
#include "core/winding/needle/rotor_obstacles.hpp"
#include "core/winding/wire.hpp"
#include "tests/core/winding/needle/quiet_support.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double pi = std::numbers::pi;
Progress silent;

Vec3 unit(Vec3 a) { return (1 / norm(a)) * a; }

double proven(const NeedlePose& from, const NeedlePose& to, const NeedleShape& needle, const Obstacle& obstacle) {
  return clearance(std::vector<NeedleMove>{{from, to}}, needle, {&obstacle}, 0.02, silent).minimum;
}

TEST(Room, IsTheProvenClearance) {
  const StatorPart part;
  const StatorIron iron(part, checked_slot(part));
  Random random(3);
  for (int i = 0; i < 40; ++i) {
    const NeedleShape needle{random.uniform(0.3, 2.6), random.uniform(10, 60)};
    const NeedlePose pose{
        {random.uniform(78, 94), random.uniform(-2, 2), random.uniform(20, 190)}, random.uniform(-0.2, 0.2), 0};
    EXPECT_NEAR(room(pose, needle, {&iron}), proven(pose, pose, needle, iron), 0.021) << i;
    EXPECT_NEAR(slot_room(pose, pose, 0, 210, needle, iron), room(pose, needle, {&iron}), 1e-3) << i;
  }
}

TEST(Room, AlongALineIsTheLeastOfIt) {
  const StatorPart part;
  const StatorIron iron(part, checked_slot(part));
  Random random(8);
  for (int i = 0; i < 20; ++i) {
    const NeedleShape needle{1.6, 60};
    const auto pose = [&](double z) {
      return NeedlePose{{random.uniform(80, 92), random.uniform(-1.5, 1.5), z}, random.uniform(-0.1, 0.1), 0};
    };
    const NeedlePose from = pose(205), to = pose(5);
    const double all = proven(from, to, needle, iron);
    EXPECT_NEAR(room(from, to, needle, {&iron}), all, 0.04) << i;
    EXPECT_NEAR(slot_room(from, to, 5, 205, needle, iron), all, 0.04) << i;
    // A line that ends between the heights is continued to them.
    const auto at = [&](double u) {
      return NeedlePose{(1 - u) * from.tip + u * to.tip, (1 - u) * from.phi + u * to.phi, 0};
    };
    EXPECT_NEAR(slot_room(at(0.1), at(0.95), 5, 205, needle, iron), all, 0.04) << i;
    // What lies beyond the stack does not count.
    NeedlePose low = to;
    low.tip.z = -195;
    const NeedlePose middle{0.5 * (from.tip + low.tip), (from.phi + low.phi) / 2, 0};
    EXPECT_NEAR(slot_room(from, low, middle.tip.z, 205, needle, iron), proven(from, middle, needle, iron), 0.04) << i;
  }
}

// A direction given by an angle that is a whole turn more is the same one: the needle does not turn all round on its
// way.
TEST(Room, IsThatOfTheShorterTurn) {
  const RotorPart part;
  const RotorIron iron(part, checked_slot(part), {});
  const NeedleShape needle{1, 40};
  const NeedlePose from{{-60, 3, 100}, 0.02, 0}, to{{-60, -3, 90}, -0.02, 0};
  NeedlePose turned = to;
  turned.phi += 2 * pi;
  ASSERT_GT(room(from, to, needle, {&iron}), 1);
  EXPECT_NEAR(room(from, turned, needle, {&iron}), room(from, to, needle, {&iron}), 1e-9);
  EXPECT_NEAR(room(turned, from, needle, {&iron}), room(to, from, needle, {&iron}), 1e-9);
  EXPECT_NEAR(slot_room(from, turned, 0, 202, needle, iron), slot_room(from, to, 0, 202, needle, iron), 1e-9);
}

/// A wall that fills y > `face`.
class Wall final : public Obstacle {
 public:
  explicit Wall(double face) : face_(face) {}
  double distance(Vec3 p) const override { return face_ - p.y; }
  Solid solid(double) const override { return {}; }

 private:
  double face_;
};

// A wire along −z, a needle along x: the tip moves 7 mm times the sine of the lean.
TEST(KeptClear, LeansTheWireAsFarAsAWallAsks) {
  const NeedleShape needle{2, 30};
  const Vec3 along{0, 0, -1}, across{0, 1, 0};
  const auto support = [](Vec3 way) {
    const NeedlePose pose{7.0 * way, 0, 0};
    return SupportPoint{pose, 0, pi / 2};
  };
  const auto at = [&](double face) {
    const Wall wall(face);
    return kept_clear(
               along, across, support, [&](const NeedlePose& p) { return room(p, needle, {&wall}); }, 0.1)
        ->pose.tip;
  };
  EXPECT_EQ(at(1.2).y, 0) << "room enough: unchanged";
  EXPECT_EQ(at(1.1).y, 0);
  for (const double face : {1.099, 1.0, 0.3, -1.0, -2.0}) {
    EXPECT_NEAR(at(face).y, face - 1.1, 1e-5) << face;
    EXPECT_NEAR(norm(at(face)), 7, 1e-12) << face;
  }
  // Beyond 1.5 of lean, 7 · 1.5/√3.25 mm, as far as it may.
  EXPECT_NEAR(at(-20).y, -7 * 1.5 / std::sqrt(3.25), 0.4);
}

TEST(KeptClear, ImpossibleDirectionsAreNoneAndThoseOfTheWireItselfAnError) {
  const NeedleShape needle{2, 30};
  const Wall wall(0);
  const auto left = [&](const NeedlePose& p) { return room(p, needle, {&wall}); };
  const auto half = [](Vec3 way) -> Expected<SupportPoint, NoSupport> {
    if (way.y < 0) return NoSupport::backwards;
    return SupportPoint{{7.0 * way, 0, 0}, 0, pi / 2};
  };
  EXPECT_EQ(kept_clear({0, 0, -1}, {0, 1, 0}, half, left, 0.1)->pose.tip.y, 0);
  const auto none = [](Vec3) -> Expected<SupportPoint, NoSupport> { return NoSupport::no_direction; };
  EXPECT_EQ(kept_clear({0, 0, -1}, {0, 1, 0}, none, left, 0.1).reason(), NoSupport::no_direction);
}

template <class Part>
std::vector<Turn> wound(const Part& part, Coil coil, double radius) {
  const Slot slot = checked_slot(part);
  const LayingRegions regions = coil_regions(part, slot, coil);
  const NeedleLayout layouts = needle(regions, radius, slot.tension_point, silent);
  return turns_of({regions}, layouts, layouts[0].wires.size(), radius);
}
/// Of the line in a slot as far as it lies in the iron.
double through(const FixedPiece& piece, const NeedleShape& needle, const Obstacle& iron) {
  return proven(piece.begin.pose, piece.end.pose, needle, iron);
}
/// From the tip back through the bend: the straight wire ends at `place`, where it comes from the tip.
void expect_leads_to(const SupportPoint& s, Vec3 place, double radius, double length, std::size_t where) {
  const double t = radius * std::tan(s.exit_angle / 2);
  const Vec3 corner = s.pose.tip + t * s.pose.direction(), way = unit(corner - place);
  EXPECT_NEAR(norm(corner - place), length + t, 1e-7) << where;
  EXPECT_NEAR(std::cos(s.exit_angle), -dot(way, s.pose.direction()), 1e-9) << where;
}
bool same(const SupportPoint& a, const SupportPoint& b) {
  return norm(a.pose.tip - b.pose.tip) == 0 && std::abs(a.pose.phi - b.pose.phi) < 1e-12;
}

// All layers of the example's slot, 70 wires.
TEST(Channel, TipsOfAWholeStatorCoilKeepTheirClearance) {
  const StatorPart part;
  const StatorIron iron(part, checked_slot(part));
  const double wire = standard_wire(0.9, 2)->radius();
  for (const Coil coil : {Coil{0, 5}, Coil{7, -5}}) {
    const std::vector<Turn> turns = wound(part, coil, wire);
    ASSERT_GT(turns.size(), 60u);
    NeedleModel model;
    model.pivot_limit = 10 * pi / 180;
    const auto free = support_points(part, {coil}, turns, model);
    for (const double asked : {0.0, 0.1}) {
      model.shape = NeedleShape{1.6, 60};
      model.clearance = asked;
      const auto held = support_points(part, {coil}, turns, model);
      ASSERT_EQ(held.size(), free.size());
      std::size_t moved = 0, collided = 0;
      for (std::size_t n = 0; n < held.size(); ++n) {
        if (n % 2 == 1) {
          EXPECT_TRUE(same(held[n].begin, free[n].begin) && same(held[n].end, free[n].end)) << n;
          continue;
        }
        const double before = through(free[n], *model.shape, iron);
        collided += before < 0;
        EXPECT_GE(through(held[n], *model.shape, iron), asked) << n;
        const bool same_ends = same(held[n].begin, free[n].begin) && same(held[n].end, free[n].end);
        moved += !same_ends;
        if (before > asked + 0.15) {
          EXPECT_TRUE(same_ends) << n;
        }
        const Passage& p = turns[n / 4].at[n % 4];
        expect_leads_to(held[n].begin, p.begin, 5, 2, n);
        expect_leads_to(held[n].end, p.end, 5, 2, n);
      }
      EXPECT_GT(collided, 20u);
      EXPECT_GE(moved, collided);
      EXPECT_LT(moved, turns.size());
    }
  }
}

TEST(Channel, TipsOfAWholeRotorCoilKeepTheirClearance) {
  const RotorPart part;
  const Slot slot = checked_slot(part);
  const RotorIron iron(part, slot, {});
  const double wire = standard_wire(1.12, 2)->radius();
  const std::vector<Turn> turns = wound(part, {0, 1}, wire);
  ASSERT_GT(turns.size(), 30u);
  NeedleModel model;
  const auto free = support_points(part, turns, model);
  model.shape = NeedleShape{2, 60};
  const auto held = support_points(part, turns, model);
  std::size_t collided = 0;
  for (std::size_t n = 0; n < held.size(); ++n) {
    collided += through(free[n], *model.shape, iron) < 0;
    EXPECT_GE(through(held[n], *model.shape, iron), 0) << n;
    expect_leads_to(held[n].begin, turns[n / 4].at[n % 4].begin, 5, 2, n);
    expect_leads_to(held[n].end, turns[n / 4].at[n % 4].end, 5, 2, n);
  }
  EXPECT_GT(collided, 5u);
}

// One that is wider than what the tooth tips leave, 3.083 mm, reaches into them wherever its tip is.
TEST(Channel, ANeedleTooWideStillTouches) {
  const StatorPart part;
  const StatorIron iron(part, checked_slot(part));
  const std::vector<Turn> turns = wound(part, {0, 5}, 0.49);
  NeedleModel model;
  model.pivot_limit = 0.15;
  model.shape = NeedleShape{3.2, 60};
  const auto held = support_points(part, {{0, 5}}, {turns.begin(), turns.begin() + 20}, model);
  for (std::size_t n = 0; n < held.size(); n += 2) EXPECT_LT(through(held[n], *model.shape, iron), 0) << n;
}

// The tip follows the wire's place without jumps, also where it begins to be held.
TEST(Channel, TipsChangeContinuouslyWithTheWiresPlace) {
  const StatorPart part;
  NeedleModel model;
  model.pivot_limit = 0.17;
  model.shape = NeedleShape{1.6, 60};
  Vec3 last{};
  double farthest = 0, held = 0;
  for (int i = 0; i <= 400; ++i) {
    const double y = i * 0.005;  // from the slot's middle to its flank
    const Vec3 in{99, y - 2.5, 225}, top{88, y, 210}, bottom{88, y, 0};
    Turn turn;
    turn.at[0] = {top, bottom, in};
    // Heads far enough away; they are not looked at.
    turn.at[1] = {turned({100, 3, -16}, 0.05), turned({100, -3, -16}, 5 * part.pitch() - 0.05), bottom};
    turn.at[2] = {turned({88, 0, 0}, 5 * part.pitch()), turned({88, 0, 210}, 5 * part.pitch()), turn.at[1].end};
    turn.at[3] = {turned({100, -3, 226}, 5 * part.pitch() - 0.05), turned({100, 3, 226}, 0.05), turn.at[2].end};
    const auto pieces = support_points(part, {{0, 5}}, {turn}, model);
    const Vec3 tip = pieces[0].begin.pose.tip;
    if (i > 0) farthest = std::max(farthest, norm(tip - last));
    last = tip;
    NeedleModel free = model;
    free.shape.reset();
    held = std::max(held, norm(tip - support_points(part, {{0, 5}}, {turn}, free)[0].begin.pose.tip));
  }
  EXPECT_GT(held, 0.2) << "at the flank the tip is held";
  EXPECT_LT(farthest, 0.05) << "per 0.005 mm";
}

}  // namespace
}  // namespace bahnwerk::winding
