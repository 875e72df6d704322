#include "core/winding/layout/potential.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "tests/core/winding/layout/best_known.hpp"
#include "tests/core/winding/packing_rooms.hpp"

namespace bahnwerk::winding {
namespace {

using namespace test;

constexpr double pi = std::numbers::pi;

struct Copper {
  double copper, outer, smallest;
  double overlap() const { return 0.5 * (1 - smallest / outer) * outer / 2; }
};
/// IEC 60317-0-1, grade 2, series R 20.
const std::vector<Copper>& wires_r20() {
  static const std::vector<Copper> list{{0.5, 0.566, 0.545},  {0.56, 0.630, 0.607}, {0.63, 0.704, 0.680},
                                        {0.71, 0.789, 0.763}, {0.8, 0.884, 0.856},  {0.9, 0.989, 0.960},
                                        {1.0, 1.094, 1.063},  {1.12, 1.217, 1.185}, {1.25, 1.349, 1.317},
                                        {1.4, 1.502, 1.469},  {1.6, 1.706, 1.671}};
  return list;
}

/// The most points of one row lattice with pitch `distance` in `usable_area`, by trying many lattices; independent of
/// starts.cpp.
std::size_t lattice_count(const Region& usable_area, double radius, double distance, double angle, int shifts) {
  const Point along{std::cos(angle), std::sin(angle)}, skew{std::cos(angle + pi / 3), std::sin(angle + pi / 3)};
  const Point middle = 0.5 * (usable_area.box().low + usable_area.box().high);
  const int reach = static_cast<int>(bahnwerk::distance(usable_area.box().low, usable_area.box().high) / distance) + 2;
  std::size_t best = 0;
  for (int u = 0; u < shifts; ++u)
    for (int v = 0; v < shifts; ++v) {
      std::size_t count = 0;
      for (int i = -reach; i <= reach; ++i)
        for (int k = -reach; k <= reach; ++k) {
          const Point p =
              middle + (distance * (i + 1.0 * u / shifts)) * along + (distance * (k + 1.0 * v / shifts)) * skew;
          if (p.x > usable_area.box().low.x && p.x < usable_area.box().high.x && p.y > usable_area.box().low.y &&
              p.y < usable_area.box().high.y)
            count += usable_area.distance(p) >= radius;
        }
      best = std::max(best, count);
    }
  return best;
}

class Stops final : public ProgressSink {
 public:
  explicit Stops(int after) : left_(after) {}
  void report(std::string_view, double, std::string_view) override {
    if (--left_ < 0) throw Stopped(StopReason::cancelled);
  }

 private:
  int left_;
};

struct Notes final : ProgressSink {
  void report(std::string_view, double fraction, std::string_view) override { fractions.push_back(fraction); }
  std::vector<double> fractions;
};

TEST(Potential, FindsNoWireWhereNoneFits) {
  EXPECT_TRUE(potential(square(), 0.5001, {}, {}, silent).empty());
  EXPECT_TRUE(potential(Region(), 0.1, {}, {}, silent).empty());
  EXPECT_FALSE(pack(square(), 0.5001, 1, {}, {}, silent));
  EXPECT_TRUE(pack(square(), 0.5001, 0, {}, {}, silent)->empty());
}

TEST(Potential, FindsTheOnlyWireThatFits) {
  for (const double radius : {0.4999, 0.49999999, 0.5}) {
    const auto wires = potential(square(), radius, {}, {}, silent);
    ASSERT_EQ(wires.size(), 1u) << radius;
    EXPECT_TRUE(packed(square(), radius, 0, wires));
  }
  EXPECT_EQ(potential(circle(), 0.9999, {}, {}, silent).size(), 1u);
  EXPECT_EQ(potential(circle(), 1, {}, {}, silent).size(), 1u);
}

TEST(Potential, FillsARowThatJustFits) {
  const auto wires = potential(rectangle(7, 1), 0.5, {}, {}, silent);
  EXPECT_EQ(wires.size(), 7u);
  EXPECT_TRUE(packed(rectangle(7, 1), 0.5, 0, wires));
  EXPECT_EQ(potential(rectangle(7 - 1e-6, 1), 0.5, {}, {}, silent).size(), 6u);
}

TEST(Potential, CountsUpToBestKnownPackings) {
  // The radius that N circles need, a little less: N and not N − 1.
  for (const int n : {5, 12, 19, 27, 30}) {
    PotentialOptions options;
    options.effort = 0.1;
    EXPECT_EQ(potential(square(), 0.998 * testing::square_radius[n - 5], {}, options, silent).size(),
              static_cast<std::size_t>(n));
  }
}

TEST(Potential, FillsBothSidesOfANeck) {
  // Two squares joined by a slit that no wire passes: 9 wires in each.
  const Region usable_area = polygon({{0, 0},
                                      {1, 0},
                                      {1, 0.45},
                                      {1.2, 0.45},
                                      {1.2, 0},
                                      {2.2, 0},
                                      {2.2, 1},
                                      {1.2, 1},
                                      {1.2, 0.55},
                                      {1, 0.55},
                                      {1, 1},
                                      {0, 1}});
  const double radius = 0.998 / 6;
  const auto wires = potential(usable_area, radius, {}, {}, silent);
  EXPECT_EQ(wires.size(), 18u);
  expect_allowed(usable_area, radius, 0, wires);
}

TEST(Potential, KeepsAwayFromCornersThatJutIn) {
  const Region usable_area = polygon({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}});
  const double radius = 0.21;
  const auto wires = potential(usable_area, radius, {}, {}, silent);
  EXPECT_GE(wires.size(), 20u);
  expect_allowed(usable_area, radius, 0, wires);
}

TEST(Potential, FillsGrooves) {
  // A base of four grooves a little wider than the wires, under a lid: one wire in each groove.
  std::vector<Edge> edges;
  for (int i = 0; i < 4; ++i) edges.push_back(arc_between({i + 0.5, 0.2}, {i + 0.0, 0}, {i + 1.0, 0}, true));
  edges.push_back(line({4, 0}, {4, 0.66}));
  edges.push_back(line({4, 0.66}, {0, 0.66}));
  edges.push_back(line({0, 0.66}, {0, 0}));
  const Region usable_area(edges);
  const auto wires = potential(usable_area, 0.49, {}, {}, silent);
  EXPECT_EQ(wires.size(), 4u);
  expect_allowed(usable_area, 0.49, 0, wires);
}

TEST(Potential, OverlapGainsRoomBetweenWiresOnly) {
  // In a row of length 7 − 6·0.02 wires that may overlap by 0.02 fit seven times, at their full distance from the wall.
  PotentialOptions options;
  options.overlap = 0.02;
  const auto wires = potential(rectangle(7 - 6 * 0.02, 1), 0.5, {}, options, silent);
  EXPECT_EQ(wires.size(), 7u);
  expect_allowed(rectangle(7 - 6 * 0.02, 1), 0.5, 0.02, wires);
  EXPECT_EQ(potential(rectangle(7 - 6 * 0.02 - 1e-6, 1), 0.5, {}, options, silent).size(), 6u);
}

TEST(Potential, StandsHugeOverlap) {
  PotentialOptions options;
  options.overlap = 0.9;
  options.most = 60;
  const auto wires = potential(rectangle(2, 2), 0.5, {}, options, silent);
  EXPECT_GE(wires.size(), 59u);  // a lattice with pitch 0.1 has 11 · 11 places
  EXPECT_TRUE(packed(rectangle(2, 2), 0.5, 0.9, wires));
}

TEST(Potential, RefusesNonsense) {
  PotentialOptions options;
  EXPECT_THROW(potential(square(), 0, {}, options, silent), std::invalid_argument);
  EXPECT_THROW(potential(square(), NAN, {}, options, silent), std::invalid_argument);
  options.overlap = 0.2;
  EXPECT_THROW(potential(square(), 0.1, {}, options, silent), std::invalid_argument);
  options.overlap = -0.01;
  EXPECT_THROW((void)pack(square(), 0.1, 3, {}, options, silent), std::invalid_argument);
}

// Promises.

TEST(Potential, IsNeverWorseThanAnAllowedHint) {
  // 30 circles at best-known radius are found with much work only; as a hint they must stay.
  PotentialOptions much, little;
  much.effort = 2;
  little.effort = 1e-6;
  const double radius = 0.99999 * testing::square_radius[25];
  const auto hint = pack(square(), radius, 30, {}, much, silent);
  ASSERT_TRUE(hint);
  EXPECT_GE(potential(square(), radius, std::vector<std::vector<Point>>{*hint}, little, silent).size(), 30u);
}

TEST(Potential, IgnoresAHintThatOverlaps) {
  std::vector<Point> wires(50, Point{0.5, 0.5});
  PotentialOptions options;
  options.effort = 0.01;
  const auto found = potential(square(), 0.1, std::vector<std::vector<Point>>{wires}, options, silent);
  EXPECT_LT(found.size(), 30u);
  EXPECT_GE(found.size(), 25u);
  EXPECT_TRUE(packed(square(), 0.1, 0, found));
}

TEST(Potential, SearchesNoFurtherThanTheWantedNumber) {
  PotentialOptions options;
  options.most = 28;
  const double radius = 0.998 * testing::square_radius[25];
  Notes notes;
  const auto found = potential(square(), radius, {}, options, notes);
  EXPECT_EQ(found.size(), 28u);
  const std::size_t reports = notes.fractions.size();
  options.most = 31;  // one more than fit
  EXPECT_EQ(potential(square(), radius, {}, options, notes).size(), 30u);
  EXPECT_GT(notes.fractions.size(), 20 * reports);
}

TEST(Potential, ReportsProgressThatGrows) {
  Notes notes;
  PotentialOptions options;
  options.effort = 0.1;
  potential(stator_room(), 0.6, {}, options, notes);
  ASSERT_GT(notes.fractions.size(), 100u);
  EXPECT_TRUE(std::is_sorted(notes.fractions.begin(), notes.fractions.end()));
  EXPECT_GT(notes.fractions.back(), 0.9);
  EXPECT_LE(notes.fractions.back(), 1);
}

TEST(Potential, IsTheSameForTheSameSeed) {
  PotentialOptions options;
  options.effort = 0.1;
  const Copper wire = wires_r20()[8];
  options.overlap = wire.overlap();
  const Region usable_area = stator_room();
  const auto first = potential(usable_area, wire.outer / 2, {}, options, silent);
  EXPECT_EQ(first, potential(usable_area, wire.outer / 2, {}, options, silent));
  options.seed = 2;
  EXPECT_NE(first, potential(usable_area, wire.outer / 2, {}, options, silent));
}

TEST(Potential, StopsWhenAsked) {
  for (const int after : {0, 1, 50}) {
    Stops progress(after);
    EXPECT_THROW(potential(stator_room(), 0.4, {}, {}, progress), Stopped);
  }
}

TEST(Packed, RejectsEveryBreachOfTheRules) {
  const std::vector<Point> wires{{0.25, 0.25}, {0.75, 0.25}, {0.75, 0.75}, {0.25, 0.75}};
  EXPECT_TRUE(packed(square(), 0.25, 0, wires));
  EXPECT_FALSE(packed(square(), 0.25 + 1e-8, 0, wires));
  auto moved = wires;
  moved[2].y += 2e-9;
  EXPECT_FALSE(packed(square(), 0.25, 0, moved));
  moved = wires;
  moved[2].y = 5;
  EXPECT_FALSE(packed(square(), 0.25, 0, moved));
  moved = wires;
  moved[2] = moved[1];
  EXPECT_FALSE(packed(square(), 0.25, 0.1, moved));
  moved[2].y = NAN;
  EXPECT_FALSE(packed(square(), 0.25, 0, moved));
  EXPECT_TRUE(packed(square(), 0.25, 0, {}));
}

// The example slot.

TEST(Potential, FillsTheExampleSlotBetterThanAnyLattice) {
  const Region usable_area = stator_room();
  EXPECT_NEAR(usable_area.area(), 73.19, 0.01);
  const double flank = std::atan2(16.129, 2.22625 - 2.9285);
  for (const std::size_t which : {1u, 4u, 7u, 10u}) {
    const Copper& wire = wires_r20()[which];
    PotentialOptions options;
    options.overlap = wire.overlap();
    options.effort = 0.1;
    const double radius = wire.outer / 2, least = 2 * radius - options.overlap;
    const auto wires = potential(usable_area, radius, {}, options, silent);
    expect_allowed(usable_area, radius, options.overlap, wires);
    for (const double angle : {0.0, pi / 6, flank, pi - flank})
      EXPECT_GE(wires.size(), lattice_count(usable_area, radius, least, angle, 12)) << wire.copper;
  }
}

}  // namespace
}  // namespace bahnwerk::winding
