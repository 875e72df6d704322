#include "core/winding/needle/support_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/numeric/random.hpp"
#include "tests/core/winding/needle/quiet_support.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double pi = std::numbers::pi;
Progress silent;

struct Wound {
  std::vector<Coil> coils;
  std::vector<Turn> turns;
};
template <class Part>
Wound wound(const Part& part, std::vector<Coil> coils, double radius, std::size_t most) {
  const Slot slot = checked_slot(part);
  std::vector<LayingRegions> regions;
  for (const Coil coil : coils) regions.push_back(coil_regions(part, slot, coil));
  const NeedleLayout layouts = needle(regions.at(0), radius, slot.tension_point, silent);
  const std::size_t turns = std::min(most, layouts[0].wires.size());
  return {coils, turns_of(regions, layouts, turns, radius)};
}

/// The wire from the tip back: needle, circle, straight. True where it ends at `place` in the direction −`along`.
void expect_leads_to(const SupportPoint& s, Vec3 place, Vec3 along, double radius, double length, int where) {
  const Vec3 d = s.pose.direction();
  const double angle = std::acos(std::clamp(-dot(d, along), -1.0, 1.0));
  EXPECT_NEAR(s.exit_angle, angle, 1e-7) << where;
  const double t = radius * std::tan(angle / 2);
  const Vec3 corner = place + (length + t) * along;
  EXPECT_NEAR(norm(corner - (s.pose.tip + t * d)), 0, 1e-7) << where << ": tangents of the bend do not meet";
}

Vec3 unit(Vec3 a) { return (1 / norm(a)) * a; }

TEST(SupportPoints, WireReachesItsPlaceInSlots) {
  for (const int slots : {12, 48}) {
    StatorPart part;
    part.slots = slots;
    for (const int span : {1, slots / 8 + 1, -slots / 4, slots / 2}) {
      const Wound w = wound(part, {{3, span}}, 0.6, 12);
      for (const bool shift : {false, true}) {
        NeedleModel model;
        if (shift) model.pivot_limit = 0.15;
        const std::vector<FixedPiece> pieces = support_points(part, w.coils, w.turns, model);
        ASSERT_EQ(pieces.size(), 4 * w.turns.size());
        for (std::size_t n = 0; n < pieces.size(); ++n) {
          const FixedPiece& piece = pieces[n];
          const Passage& p = w.turns[n / 4].at[n % 4];
          EXPECT_EQ(piece.turn, n / 4);
          EXPECT_EQ(piece.region, n % 4);
          if (n % 2 == 1) continue;
          EXPECT_EQ(piece.begin.pose.psi, 0);
          expect_leads_to(piece.begin, p.begin, unit(p.begin - p.held), 5, 2, static_cast<int>(n));
          expect_leads_to(piece.end, p.end, unit(p.end - p.begin), 5, 2, static_cast<int>(n));
          // A wire along the slot leaves at a right angle: the tip is one radius nearer to the axis, length and radius
          // beyond the slot's end.
          EXPECT_NEAR(piece.end.exit_angle, pi / 2, 1e-12);
          EXPECT_NEAR(std::abs(piece.end.pose.tip.z - p.end.z), 7, 1e-9);
          if (!shift) {
            EXPECT_NEAR(std::hypot(p.end.x, p.end.y) - std::hypot(piece.end.pose.tip.x, piece.end.pose.tip.y), 5, 1e-9);
            EXPECT_EQ(piece.end.pivot_shift, 0);
            EXPECT_NEAR(std::remainder(piece.end.pose.phi - azimuth(piece.end.pose.tip), 2 * pi), 0, 1e-12);
          }
        }
      }
    }
  }
}

// Behind the tools, with the needle towards the stack, on one circle about the axis.
TEST(SupportPoints, HeadsAreArcsAboutTheAxis) {
  for (const int span : {2, -5, 12, -24, 24}) {
    const StatorPart part;
    const Wound w = wound(part, {{40, span}}, 0.5, 200);
    const std::vector<FixedPiece> pieces = support_points(part, w.coils, w.turns, {});
    ASSERT_GT(w.turns.size(), 30u);
    for (std::size_t n = 1; n < pieces.size(); n += 2) {
      const FixedPiece& piece = pieces[n];
      const Passage& p = w.turns[n / 4].at[n % 4];
      ASSERT_EQ(piece.shape, FixedPiece::Shape::arc);
      const Vec3 a = piece.begin.pose.tip, b = piece.end.pose.tip;
      EXPECT_NEAR(norm(turned(a, piece.sweep) - b), 0, 1e-11);
      const double out = n % 4 == 3 ? 1 : -1;
      EXPECT_NEAR(norm(piece.begin.pose.direction() - Vec3{0, 0, -out}), 0, 1e-15) << "towards the stack (4.26)";
      EXPECT_EQ(piece.begin.pose.psi, out * pi / 2);
      EXPECT_GE(out * (a.z - p.begin.z), 5 - 1e-9) << "at least the bend's radius beyond the wire";
      EXPECT_GE(std::hypot(a.x, a.y), std::hypot(p.end.x, p.end.y) - 1e-9);
      EXPECT_LT(piece.begin.exit_angle, pi / 2);
      // About as far round as the wire, and in the coil's sense: below as the slots count, above back.
      EXPECT_EQ(piece.sweep > 0, (span > 0) == (out < 0));
      EXPECT_NEAR(std::abs(piece.sweep), std::abs(span) * part.pitch(), 0.15);
    }
  }
}

TEST(SupportPoints, AnglesRunOnWithoutJumps) {
  const StatorPart part;
  const Wound w = wound(part, repeated({30, 24}, part.slots, 12, 4, false), 0.6, 6);
  const std::vector<FixedPiece> pieces = support_points(part, w.coils, w.turns, {});
  ASSERT_EQ(pieces.size(), 4 * w.turns.size() + 3) << "three ways from coil to coil";
  for (std::size_t n = 0; n < pieces.size(); ++n) {
    const FixedPiece& p = pieces[n];
    if (n > 0) {
      EXPECT_LT(std::abs(p.begin.pose.phi - pieces[n - 1].end.pose.phi), 0.2) << n;
    }
    const double turn = p.shape == FixedPiece::Shape::arc ? p.sweep : 0;
    EXPECT_NEAR(p.end.pose.phi - p.begin.pose.phi, turn, 0.1) << n;
  }
}

TEST(SupportPoints, ChangesOfCoilPassAboveAndOutsideAllElse) {
  const RotorPart part;
  const Wound w = wound(part, repeated({0, 1}, part.poles, 1, 6, true), 0.6, 5);
  NeedleModel model;
  model.change_radius = 3;
  model.change_height = 4;
  const std::vector<FixedPiece> pieces = support_points(part, w.turns, model);
  double farthest = 0, highest = 0;
  std::size_t changes = 0;
  for (const FixedPiece& p : pieces)
    if (p.kind == FixedPiece::Kind::region)
      for (const Vec3 t : {p.begin.pose.tip, p.end.pose.tip})
        farthest = std::max(farthest, std::hypot(t.x, t.y)), highest = std::max(highest, t.z);
  for (std::size_t n = 0; n < pieces.size(); ++n) {
    const FixedPiece& p = pieces[n];
    if (p.kind != FixedPiece::Kind::coil_change) continue;
    ++changes;
    EXPECT_EQ(pieces[n - 1].coil + 1, pieces[n + 1].coil);
    EXPECT_NEAR(std::hypot(p.end.pose.tip.x, p.end.pose.tip.y), farthest + 3, 1e-9);
    EXPECT_NEAR(p.end.pose.tip.z, highest + 4, 1e-12);
    EXPECT_NEAR(std::remainder(azimuth(p.end.pose.tip) - azimuth(pieces[n + 1].begin.pose.tip), 2 * pi), 0, 1e-12);
    EXPECT_LE(std::abs(p.sweep), pi);
  }
  EXPECT_EQ(changes, 5u);
}

TEST(SupportPoints, PointAtTheAxisOfARotor) {
  const RotorPart part;
  for (const Coil coil : {Coil{0, 1}, Coil{4, -1}}) {
    const Wound w = wound(part, {coil}, 1.217 / 2, 100);
    ASSERT_GT(w.turns.size(), 30u);
    const std::vector<FixedPiece> pieces = support_points(part, w.turns, {});
    for (std::size_t n = 0; n < pieces.size(); ++n) {
      const Passage& p = w.turns[n / 4].at[n % 4];
      EXPECT_EQ(pieces[n].shape, FixedPiece::Shape::line);
      for (const SupportPoint* s : {&pieces[n].begin, &pieces[n].end}) {
        EXPECT_EQ(s->pose.psi, 0) << "(4.29)";
        EXPECT_EQ(s->pivot_shift, 0);
        EXPECT_NEAR(norm(s->pose.direction() + radial(azimuth(s->pose.tip))), 0, 1e-12) << "(4.28)";
      }
      expect_leads_to(pieces[n].begin, p.begin, unit(p.begin - p.held), 5, 2, static_cast<int>(n));
      expect_leads_to(pieces[n].end, p.end, unit(p.end - p.begin), 5, 2, static_cast<int>(n));
    }
  }
}

// Of the shipped rotor coil: tips are moved along the end caps, where the needle's direction may run over ±π.
TEST(SupportPoints, ARotorsCoilsAreCongruent) {
  RotorPart part;
  part.poles = 6;
  const Wound w = wound(part, repeated({0, 1}, part.poles, 1, 6, false), 0.6, 3);
  ASSERT_EQ(w.turns.size(), 18u);
  NeedleModel model;
  model.shape = NeedleShape{2, 60};
  model.pull.force = 30;
  const std::vector<FixedPiece> pieces = support_points(part, w.turns, model);
  const auto nth = [&](std::size_t coil, std::size_t n) {
    for (const FixedPiece& piece : pieces)
      if (piece.kind == FixedPiece::Kind::region && piece.coil == coil && n-- == 0) return piece;
    return FixedPiece{};
  };
  for (std::size_t coil = 1; coil < 6; ++coil)
    for (std::size_t n = 0; n < 12; ++n) {
      const FixedPiece first = nth(0, n), other = nth(coil, n);
      const auto expect_same = [&](const NeedlePose& a, const NeedlePose& b) {
        const double angle = static_cast<double>(coil) * part.pitch();
        EXPECT_NEAR(std::hypot(a.tip.x, a.tip.y), std::hypot(b.tip.x, b.tip.y), 1e-3) << coil << ' ' << n;
        EXPECT_NEAR(a.tip.z, b.tip.z, 1e-3) << coil << ' ' << n;
        EXPECT_NEAR(std::remainder(a.phi + angle - b.phi, 2 * pi), 0, 1e-4) << coil << ' ' << n;
      };
      expect_same(first.begin.pose, other.begin.pose);
      expect_same(first.end.pose, other.end.pose);
    }
}

/// The largest angle of a tip in a slot from the middle of its slot, in halves of a pitch.
double farthest_aside(const StatorPart& part, const Wound& w, const std::vector<FixedPiece>& pieces) {
  double most = 0;
  for (const FixedPiece& piece : pieces) {
    if (piece.kind != FixedPiece::Kind::region || piece.region % 2 == 1) continue;
    const Coil& coil = w.coils[piece.coil];
    const double slot = slot_azimuth(part, coil.first + (piece.region == 2 ? coil.span : 0));
    for (const SupportPoint* s : {&piece.begin, &piece.end})
      most = std::max(most, std::abs(std::remainder(azimuth(s->pose.tip) - slot, 2 * pi)) / (part.pitch() / 2));
  }
  return most;
}

// Also of a needle that has hardly any room between the tooth tips, beside slots that are near.
TEST(SupportPoints, TipsStayInTheCoilsSlots) {
  for (const int slots : {36, 60, 72})
    for (const int span : {1, -1, slots / 8})
      for (const double width : {1.2, 1.7, 1.99}) {
        StatorPart part;
        part.slots = slots;
        part.slot.base_width = 3.6, part.slot.opening_width = part.slot.wedge_width = 2.3;
        part.slot.tip_corner_radius = 0.15, part.slot.height = 12, part.slot.tip_angle = 91 * pi / 180;
        part.slot.base_radius = 3.6 / 0.5 * slots / (2 * pi) + 12, part.heads.base_radius = part.slot.base_radius;
        part.heads.tool_radius = part.heads.base_radius + 4, part.heads.tool_shift = 0.1;
        const Wound w = wound(part, {{3, span}}, 0.5, 4);
        for (const std::optional<double> limit : {std::optional<double>(), std::optional<double>(0.005)}) {
          NeedleModel model;
          model.pivot_limit = limit;
          model.shape = NeedleShape{width, 40};
          EXPECT_LT(farthest_aside(part, w, support_points(part, w.coils, w.turns, model)), 1)
              << slots << ' ' << span << ' ' << width << ' ' << limit.value_or(0);
        }
      }
}

// Up to the opening, where the bend begins before the pivot.
TEST(SupportPoints, PivotShiftHasADirectionForEveryWire) {
  const StatorPart part;
  const Wound w = wound(part, {{0, 5}}, 0.4945, 200);
  ASSERT_GT(w.turns.size(), 60u);
  for (const double rho : {0.0, 2.0, 5.0, 9.0})
    for (const double limit : {0.0, 0.05, 0.1, 0.3, 0.8}) {
      NeedleModel model;
      model.pull.bend_radius = rho;
      model.pivot_limit = limit;
      const std::vector<FixedPiece> pieces = support_points(part, w.coils, w.turns, model);
      ASSERT_EQ(pieces.size(), 4 * w.turns.size());
      for (std::size_t n = 0; n < pieces.size(); n += 2) {
        const Passage& p = w.turns[n / 4].at[n % 4];
        EXPECT_LE(std::abs(pieces[n].begin.pivot_shift), limit + 1e-12);
        expect_leads_to(pieces[n].begin, p.begin, unit(p.begin - p.held), rho, 2, static_cast<int>(n));
      }
    }
}

// A coil and its mirror image have mirrored support points.
TEST(SupportPoints, MirrorWithTheCoil) {
  const StatorPart part;
  NeedleModel model;
  model.pivot_limit = 0.1;
  const Wound a = wound(part, {{0, 5}}, 0.5, 30), b = wound(part, {{0, -5}}, 0.5, 30);
  const auto left = support_points(part, a.coils, a.turns, model),
             right = support_points(part, b.coils, b.turns, model);
  ASSERT_EQ(left.size(), right.size());
  for (std::size_t n = 0; n < left.size(); ++n) {
    const Vec3 l = left[n].begin.pose.tip, r = right[n].begin.pose.tip;
    EXPECT_NEAR(norm(l - Vec3{r.x, -r.y, r.z}), 0, 1e-6) << n;
    EXPECT_NEAR(left[n].begin.pivot_shift, -right[n].begin.pivot_shift, 1e-7) << n;
    EXPECT_NEAR(left[n].sweep, -right[n].sweep, 1e-7) << n;
  }
}

// The needle's axis through the pivot, or its angle at the limit.
TEST(SlotSupport, SwivelsAboutThePivotUpToTheLimit) {
  Random random(5);
  int free = 0, limited = 0;
  for (int i = 0; i < 3000; ++i) {
    const double at = random.uniform(-3, 3), lean = random.uniform(0, 0.4), around = random.uniform(-pi, pi);
    const Vec3 e = radial(at), t{-e.y, e.x, 0}, pivot = 79 * e;
    const Vec3 place = random.uniform(84, 95) * e + random.uniform(-2.8, 2.8) * t + Vec3{0, 0, 210};
    const Vec3 along = unit(Vec3{0, 0, -1} + lean * std::cos(around) * e + lean * std::sin(around) * t);
    const double limit = random.uniform(0, 0.3);
    const double rho = random.uniform(0, 3);
    const SupportPoint s = *slot_support(place, along, rho, 1, pivot, limit);
    expect_leads_to(s, place, along, rho, 1, i);
    EXPECT_LE(std::abs(s.pivot_shift), limit + 1e-12);
    EXPECT_NEAR(std::remainder(s.pose.phi - azimuth(s.pose.tip) - s.pivot_shift, 2 * pi), 0, 1e-12);
    const Vec3 d = s.pose.direction(), from = s.pose.tip - pivot;
    const double beside = cross(from, d).z;
    if (std::abs(beside) < 1e-9) {
      ++free;
    } else {
      ++limited;
      // Limited, or the bend begins before the pivot.
      if (std::abs(s.pivot_shift) < limit - 1e-9) {
        EXPECT_LT(dot(from, e), 1e-6) << i;
      }
    }
  }
  EXPECT_GT(free, 300);
  EXPECT_GT(limited, 300);
}

TEST(SlotSupport, AWireInTheSlotsMiddleNeedsNoShift) {
  const SupportPoint s = *slot_support({90, 0, 0}, {0, 0, -1}, 5, 2, {79, 0, 0}, 0.3);
  EXPECT_NEAR(norm(s.pose.tip - Vec3{85, 0, -7}), 0, 1e-12);
  EXPECT_EQ(s.pivot_shift, 0);
  EXPECT_EQ(s.pose.phi, 0);
  // 2 mm beside it, 11 mm behind the pivot: the axis leans by atan(2/11), less the tip's own azimuth.
  const SupportPoint beside = *slot_support({90, 2, 0}, {0, 0, -1}, 5, 2, {79, 0, 0}, 0.3);
  EXPECT_NEAR(beside.pose.phi, std::atan2(2, 11), 1e-12);
  EXPECT_NEAR(beside.pivot_shift, std::atan2(2, 11) - azimuth(beside.pose.tip), 1e-12);
  // No shift allowed: straight outwards.
  const SupportPoint none = *slot_support({90, 2, 0}, {0, 0, -1}, 5, 2, {79, 0, 0}, 0);
  EXPECT_NEAR(none.pose.phi, std::atan2(2, 90), 1e-12);
  EXPECT_EQ(none.pivot_shift, 0);
}

TEST(SupportPoints, ImpossibleOnesAreRefused) {
  const StatorPart part;
  const Wound w = wound(part, {{0, 5}}, 0.6, 1);
  const auto refused = [&](const NeedleModel& model) -> std::string {
    try {
      support_points(part, w.coils, w.turns, model);
    } catch (const InvalidInput& e) {
      return e.faults.at(0).place.at(0) + "." + e.faults.at(0).place.at(1);
    }
    return "";
  };
  NeedleModel model;
  model.pivot_limit = 1.6;
  EXPECT_EQ(refused(model), "needle.pivot_limit");
  model = {};
  model.change_height = -1;
  EXPECT_EQ(refused(model), "needle.change_height");
  model = {};
  model.change_radius = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refused(model), "needle.change_radius");
  model = {};
  model.pull.force = 0;
  EXPECT_EQ(refused(model), "pull.force");
  model = {};
  model.pull.bend_radius = 200;  // beyond the axis
  Progress silent;
  EXPECT_EQ(support_points(part, w.coils, w.turns, model, silent).reason(), NoSupport::beyond_axis);
  EXPECT_TRUE(support_points(part, w.coils, {}, {}).empty());
  std::vector<Turn> none = w.turns;
  none[0].at[1].end = none[0].at[1].begin = none[0].at[1].held;
  EXPECT_EQ(support_points(part, w.coils, none, {}, silent).reason(), NoSupport::no_distance);
}

}  // namespace
}  // namespace bahnwerk::winding
