#include "core/winding/laying/producible.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/numeric/random.hpp"
#include "core/winding/laying/needle.hpp"
#include "core/winding/layout/orthocyclic.hpp"
#include "core/winding/layout/raabe.hpp"
#include "core/winding/layout/sites.hpp"
#include "core/winding/wire.hpp"
#include "tests/core/geometry/region/rooms.hpp"

namespace bahnwerk::winding {
namespace {

using test::rectangle;
using Reason = Producible::Reason;

Progress silent;
constexpr Point below{5, -1e9};

Producible check(const Region& usable_area, double radius, std::vector<Point> wires, Point tension_point,
                 ProducibleOptions options = {}) {
  return producible(usable_area, radius, {std::move(wires), {}}, tension_point, options, silent);
}

TEST(Producible, WireOnTheBaseStaysUpToItsFriction) {
  for (const double mu : {0.1, 0.3, 0.5})
    for (const double slant : {-0.01, 0.01}) {
      const Point tension_point = Point{5, 1} + 100.0 * Point{mu + slant, -1};
      EXPECT_EQ(check(rectangle(10, 10), 1, {{5, 1}}, tension_point, {mu, 0.01}).producible(), slant < 0);
    }
}

TEST(Producible, WireInTheAirSlips) {
  const Producible p = check(rectangle(10, 10), 1, {{1, 1}, {5, 4}, {3, 1}}, below);
  ASSERT_TRUE(p.first);
  EXPECT_EQ(p.first->wire, 1u);
  EXPECT_EQ(p.first->laid, 1u);
  EXPECT_EQ(p.first->reason, Reason::no_support);
  EXPECT_EQ(p.unsupported, (std::vector<std::size_t>{1}));
}

TEST(Producible, WireOnTopOfOneFalls) {
  EXPECT_FALSE(check(rectangle(10, 10), 1, {{5, 1}, {5.7, 1 + std::sqrt(4 - 0.49)}}, below).producible());
}

TEST(Producible, OrderOfLayingDecides) {
  const std::vector<Point> pyramid{{4, 1}, {6, 1}, {5, 1 + std::sqrt(3)}};
  EXPECT_TRUE(check(rectangle(10, 10), 1, pyramid, below).producible());
  const Producible p = check(rectangle(10, 10), 1, {pyramid[2], pyramid[0], pyramid[1]}, below);
  ASSERT_TRUE(p.first);
  EXPECT_EQ(p.first->wire, 0u);
}

TEST(Producible, SmoothBaseLetsAWedgeThrough) {
  const std::vector<Point> pyramid{{4, 1}, {6, 1}, {5, 1 + std::sqrt(3)}};
  const Producible free = check(rectangle(10, 10), 1, pyramid, below, {0, 0.01});
  ASSERT_TRUE(free.first);
  EXPECT_EQ(free.first->laid, 2u);
  EXPECT_EQ(free.first->reason, Reason::pushed_out);
  EXPECT_TRUE(free.unsupported.empty());
  // Between walls the same wires hold.
  EXPECT_TRUE(check(rectangle(4, 10), 1, {{1, 1}, {3, 1}, {2, 1 + std::sqrt(3)}}, {2, -1e9}, {0, 0.01}).producible());
}

TEST(Producible, SmallGapsCountAsContacts) {
  // A wire that leans on a wall 1 % of its diameter away.
  const std::vector<Point> wires{{1.02, 1}};
  EXPECT_TRUE(check(rectangle(10, 10), 1, wires, {-50, -9}, {0, 0.011}).producible());
  EXPECT_FALSE(check(rectangle(10, 10), 1, wires, {-50, -9}, {0, 0.009}).producible());
}

TEST(Producible, WireThatFillsAnArcRestsEverywhereOnIt) {
  const Region groove({arc_between({0, 1}, {-1, 1}, {1, 1}, true), line({1, 1}, {1, 5}), line({1, 5}, {-1, 5}),
                       line({-1, 5}, {-1, 1})});
  for (const Point tension_point : {Point{-9, 0}, Point{0, -9}, Point{9, 0}, Point{5, -5}})
    EXPECT_TRUE(check(groove, 1, {{0, 1}}, tension_point, {0, 1e-6}).producible());
  EXPECT_FALSE(check(groove, 1, {{0, 1}}, {0, 9}, {0, 1e-6}).producible());
}

TEST(Producible, EmptyLayoutAndWireAtItsPoint) {
  EXPECT_TRUE(check(rectangle(10, 10), 1, {}, below).producible());
  EXPECT_TRUE(check(rectangle(10, 10), 1, {{5, 5}}, {5, 5}).producible());
}

TEST(Producible, PullsOfTheLayoutComeFirst) {
  const Layout layout{{{1, 5}}, {{-20, 5}}};
  EXPECT_TRUE(producible(rectangle(10, 10), 1, layout, below, {}, silent).producible());
  EXPECT_FALSE(check(rectangle(10, 10), 1, layout.wires, below).producible());
}

/// Wires that each fell to a random place, in the order that helps them most.
Layout random_packing(const Region& usable_area, double radius, Point tension_point, std::uint64_t seed) {
  Random random(seed);
  Sites sites(usable_area, radius);
  const Box box = usable_area.box();
  const auto anywhere = [&] {
    return Point{random.uniform(box.low.x, box.high.x), random.uniform(box.low.y, box.high.y)};
  };
  while (const auto place = sites.nearest(anywhere())) sites.lay(*place);
  Layout layout{{sites.wires().begin(), sites.wires().end()}, {}};
  std::sort(layout.wires.begin(), layout.wires.end(),
            [&](Point a, Point b) { return distance(a, tension_point) < distance(b, tension_point); });
  return layout;
}

// [Herrmann 4.2.1, 4.2.2, 4.2.5]: of all layouts in the stator's slot only the needle winding can be produced.
class StatorLayouts : public ::testing::TestWithParam<Wire> {
 protected:
  const Slot slot_ = make_slot(StatorSlot{});
  const double r_ = GetParam().radius();
  Producible verdict(const Layout& layout, Point tension_point) const {
    const Producible result = producible(slot_.usable_area, r_, layout, tension_point, {}, silent);
    if (result.first) {
      EXPECT_TRUE(result.first->proved);
    }
    return result;
  }
};

TEST_P(StatorLayouts, NeedleWindingCanBeProduced) {
  const NeedleLayout n = needle(slot_, r_, StatorHeads{}, silent);
  EXPECT_TRUE(verdict(n[0], slot_.tension_point).producible());
  EXPECT_TRUE(verdict(n[2], slot_.tension_point).producible());
}
TEST_P(StatorLayouts, NeedleWiresAreHeldWithoutFrictionAsTheyAreLaid) {
  const NeedleLayout n = needle(slot_, r_, StatorHeads{}, silent);
  for (const std::size_t j : {0u, 2u})
    EXPECT_TRUE(producible(slot_.usable_area, r_, n[j], slot_.tension_point, {0, 1e-6}, silent).unsupported.empty());
}
TEST_P(StatorLayouts, LatticesCannot) {
  const Producible base =
      verdict(orthocyclic(slot_.usable_area, r_, slot_.tension_point, 0, silent), slot_.tension_point);
  ASSERT_TRUE(base.first);
  EXPECT_EQ(base.first->reason, Reason::no_support);
  const Layout flank = orthocyclic(slot_.usable_area, r_, slot_.flank_tension_point, slot_.flank, silent);
  EXPECT_FALSE(verdict(flank, slot_.flank_tension_point).producible());
}
TEST_P(StatorLayouts, VerdictsDoNotHangOnTheExactFriction) {
  const NeedleLayout n = needle(slot_, r_, StatorHeads{}, silent);
  EXPECT_TRUE(producible(slot_.usable_area, r_, n[0], slot_.tension_point, {0.28, 0.02}, silent).producible());
  EXPECT_TRUE(producible(slot_.usable_area, r_, n[2], slot_.tension_point, {0.28, 0.02}, silent).producible());
  const Layout base = orthocyclic(slot_.usable_area, r_, slot_.tension_point, 0, silent);
  const Layout flank = orthocyclic(slot_.usable_area, r_, slot_.flank_tension_point, slot_.flank, silent);
  EXPECT_FALSE(producible(slot_.usable_area, r_, base, slot_.tension_point, {1, 0.02}, silent).producible());
  EXPECT_FALSE(producible(slot_.usable_area, r_, flank, slot_.flank_tension_point, {0.55, 0.02}, silent).producible());
}
TEST_P(StatorLayouts, RandomPackingsCannot) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Producible p = verdict(random_packing(slot_.usable_area, r_, slot_.tension_point, seed), slot_.tension_point);
    EXPECT_FALSE(p.producible());
    EXPECT_GT(p.unsupported.size(), 3u);
  }
}
TEST_P(StatorLayouts, DroppedWiresCannot) {
  EXPECT_FALSE(verdict(raabe(slot_.usable_area, r_, silent), slot_.tension_point).producible());
}

INSTANTIATE_TEST_SUITE_P(AllSizes, StatorLayouts, ::testing::ValuesIn(standard_wires(2, 0.5, 1.6, Series::r40)),
                         [](const auto& wire) {
                           return "copper_" + std::to_string(std::lround(1000 * wire.param.copper)) + "_um";
                         });

TEST(Producible, NeedleWindingOfTheRotorHolds) {
  const Slot slot = make_slot(RotorSlot{});
  const NeedleLayout n = needle(slot, 0.6085, RotorHeads{}, silent);
  for (const std::size_t j : {0u, 2u})
    EXPECT_TRUE(producible(slot.usable_area, 0.6085, n[j], slot.tension_point, {}, silent).producible());
}

TEST(Producible, RotorsLatticeHoldsUnderTheHeadsPulls) {
  const Slot slot = make_slot(RotorSlot{});
  Layout lattice = orthocyclic(slot.usable_area, 0.6085, slot.tension_point, 0, silent);
  lattice.tension_points = turn_pulls(laying_regions(slot, RotorHeads{}), lattice);
  EXPECT_TRUE(producible(slot.usable_area, 0.6085, lattice, slot.tension_point, {}, silent).producible());
}

TEST(Producible, StopsWhenToldTo) {
  struct Stop : ProgressSink {
    void report(std::string_view, double fraction, std::string_view) override {
      if (fraction > 0.5) throw Stopped(StopReason::deadline);
    }
  } stop;
  const Slot slot = make_slot(StatorSlot{});
  const NeedleLayout n = needle(slot, 0.5, StatorHeads{}, silent);
  EXPECT_THROW(producible(slot.usable_area, 0.5, n[0], slot.tension_point, {}, stop), Stopped);
}

}  // namespace
}  // namespace bahnwerk::winding
