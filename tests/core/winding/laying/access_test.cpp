#include "core/winding/laying/access.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/numeric/random.hpp"
#include "core/winding/slot/coil_sides.hpp"
#include "tests/core/winding/packing_rooms.hpp"

namespace bahnwerk::winding {
namespace {

using namespace test;

/// 10 mm wide, 10 mm deep, open by 4 mm in the middle of its upper side.
const Region slot = rectangle(10, 10);
const Opening opening{{5, 10}, {0, -1}, 4, 0};

std::optional<std::size_t> first(double width, const std::vector<Point>& wires,
                                 Needle::Stand stand = Needle::Stand::middle) {
  return first_out_of_reach(slot, opening, {width, stand}, {wires, 0.5, 0.02}, silent);
}

TEST(Opening, WireAndNeedleMustPassIt) {
  EXPECT_TRUE(opening_obstructions(opening, 2, std::nullopt).empty()) << "exactly as wide";
  const auto thick = opening_obstructions(opening, 2.001, Needle{4.1});
  ASSERT_EQ(thick.size(), 2u);
  EXPECT_EQ(thick[0].part, Obstruction::Part::wire);
  EXPECT_EQ(thick[1].part, Obstruction::Part::needle);
  EXPECT_EQ(thick[1].needed, 4.1);
  EXPECT_TRUE(opening_obstructions(opening, 0.5, Needle{4}).empty());
  EXPECT_EQ(opening_obstructions(opening, 0.5, Needle{2.1, Needle::Stand::left}).at(0).clear, 2)
      << "half of it belongs to the other coil side";
}

TEST(Opening, TheWireRunsInsideTheNeedle) {
  const auto thin = opening_obstructions(opening, 0.8, Needle{1.5});
  ASSERT_EQ(thin.size(), 1u);
  EXPECT_EQ(thin[0].part, Obstruction::Part::bore);
  EXPECT_EQ(thin[0].needed, 1.6);
  EXPECT_EQ(thin[0].clear, 1.5);
  EXPECT_EQ(opening_obstructions(opening, 0.75, Needle{1.5}).size(), 1u) << "a needle has walls";
  EXPECT_TRUE(opening_obstructions(opening, 0.74, Needle{1.5}).empty());
}

TEST(Opening, AllWiresInHandRunInsideTheNeedle) {
  const auto obstructions = [](double width, std::size_t wires) {
    return opening_obstructions(opening, 0.5, Needle{width, Needle::Stand::middle, wires});
  };
  EXPECT_TRUE(obstructions(2.5, 4).empty()) << "1 + √2 = 2.414 mm";
  ASSERT_EQ(obstructions(2.4, 4).size(), 1u);
  EXPECT_EQ(obstructions(2.4, 4)[0].part, Obstruction::Part::bore);
  EXPECT_NEAR(obstructions(2.4, 4)[0].needed, 2.41421356, 1e-8);
}

TEST(BundleDiameter, IsThatOfTheLeastCircleRoundTheWires) {
  const double known[] = {1, 2, 2.154700538, 2.414213562, 2.701301617, 3, 3};
  for (std::size_t n = 1; n <= 7; ++n) EXPECT_NEAR(bundle_diameter(n, 0.5), 0.5 * known[n - 1], 1e-9) << n;
  // Best circles known [Graham, Lubachevsky, Nurmela, Östergård 1998]: the bound lies below them and grows.
  const double best[] = {3.304764871, 3.613125930, 3.813025631, 3.923804400, 4.029601930};
  for (std::size_t n = 8; n <= 12; ++n) {
    EXPECT_LE(bundle_diameter(n, 1), best[n - 8]) << n;
    EXPECT_GE(bundle_diameter(n, 1), 0.89 * best[n - 8]) << n;
    EXPECT_GE(bundle_diameter(n, 1), bundle_diameter(n - 1, 1)) << n;
  }
  EXPECT_LE(bundle_diameter(37, 1), 6.7588) << "37 wires";
  EXPECT_GE(bundle_diameter(1000, 1), std::sqrt(1000.0)) << "the wires' own section";
}

TEST(Opening, HasTheSourcesWidthInTheExampleSlot) {
  // [Herrmann Fig. 4.16]: 3.1 mm, for a needle of 2.6 mm.
  EXPECT_NEAR(make_slot(StatorSlot{}).opening->clear, 3.083, 1e-12);
}

TEST(Access, AnEmptySlotIsOpen) {
  EXPECT_FALSE(first(2, {{0.5, 0.5}}));
  EXPECT_FALSE(first(2, {{9.5, 0.5}}));
  EXPECT_FALSE(first(2, {{0.5, 9.5}})) << "under a tooth tip, from a mouth beside it";
}

TEST(Access, AWireUnderAFullRowIsOutOfReach) {
  // A row from the walls to the middle.
  std::vector<Point> wires;
  for (const double x : {0.5, 9.5, 1.5, 8.5, 2.5, 7.5, 3.5, 6.5, 4.5, 5.5}) wires.push_back({x, 5});
  wires.push_back({0.5, 1});
  EXPECT_EQ(first(2, wires), 10u);
  wires.erase(wires.begin() + 7, wires.begin() + 10);
  EXPECT_FALSE(first(2, wires)) << "a gap of 3 mm in the middle";
  EXPECT_EQ(first(3.5, wires), 7u) << "a needle that does not enter it sees no way past the row";
}

TEST(Access, TheLastWireUnderATipNeedsAFreeChannel) {
  // The channel is filled up to the opening: no mouth below the tooth tip any more.
  std::vector<Point> wires;
  for (int row = 0; row < 10; ++row) wires.push_back({5, 0.5 + row});
  wires.push_back({0.5, 9.5});
  EXPECT_EQ(first(1, wires), 10u);
  wires.back() = {4, 9.5};
  EXPECT_FALSE(first(1, wires)) << "within the clear opening, from above";
}

TEST(Access, AWireThatHidesEveryMouthIsInTheWay) {
  // The second lies under the first as seen from any height above that.
  const std::vector<Point> wires{{4.4, 9.3}, {3.8, 1.2}};
  EXPECT_EQ(first(3.2, wires), 1u);
  EXPECT_FALSE(first(0.1, wires)) << "a thin needle goes down beside the first";
}

// The intervals against a dense sample of mouths.
TEST(Access, AgreesWithASample) {
  Random random(17);
  int blocked = 0, open = 0;
  for (int round = 0; round < 400; ++round) {
    std::vector<Point> wires;
    for (int tries = 0; tries < 200; ++tries) {
      const Point p{random.uniform(0.5, 9.5), random.uniform(0.5, 9.4)};
      if (fits(slot, 0.5, wires, p, 0)) wires.push_back(p);
    }
    wires.resize(std::min<std::size_t>(wires.size(), 3 + random.below(40)));
    const double width = random.uniform(0.2, 3.9);
    const auto found = first(width, wires);
    // A wire is in reach of the sample with a little less of every size, and out of reach with a little more.
    const auto seen = [&](std::size_t i, double more) {
      const Point p = wires[i];
      for (double y = 0; y < 5000; y += std::max(0.004, 0.0003 * y)) {
        bool clear = true;
        for (std::size_t k = 0; k < i && clear; ++k) {
          const Point c = wires[k], mouth{5, y};
          const double beside = std::max(0.0, std::abs(c.x - 5) - width / 2);
          const double rise = 0.5 * 0.5 - beside * beside;
          if (rise > 0 && y < c.y + std::sqrt(rise) + more) clear = false;
          const Edge way = line(p, mouth);
          if (distance(way.at(way.nearest(c)), c) < 0.98 + more) clear = false;
        }
        if (y > 9.5 && std::abs(p.x - 5) > 1.5) {
          const double at = p.x + (5 - p.x) * (9.5 - p.y) / (y - p.y);
          if (std::abs(at - 5) > 1.5 - 10 * more) clear = false;
        }
        if (clear) return true;
      }
      return false;
    };
    if (found) {
      ++blocked;
      EXPECT_FALSE(seen(*found, 0.01)) << round;
    } else {
      ++open;
    }
    for (std::size_t i = 0; i < found.value_or(wires.size()); ++i) EXPECT_TRUE(seen(i, -0.01)) << round << ", " << i;
  }
  EXPECT_GT(blocked, 20);
  EXPECT_GT(open, 20);
}

}  // namespace
}  // namespace bahnwerk::winding
