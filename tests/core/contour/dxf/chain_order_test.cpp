#include "core/contour/dxf/cut/chain_order.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

TEST(ChainOrder, AgreesWithASearchThroughAll) {
  Random random(5);
  Progress silent;
  for (int round = 0; round < 20; ++round) {
    std::vector<ChainEntries> list;
    for (int i = 0; i < 120; ++i) {
      ChainEntries e;
      e.closed = random.chance(0.5);
      for (std::uint64_t k = e.closed ? 1 + random.below(5) : 2; k > 0; --k)
        e.at.push_back({random.uniform(0, 100), random.uniform(0, 100), random.chance(0.5) ? 0.0 : 1.0});
      list.push_back(e);
    }
    const auto order = nearest_order(list, silent);
    ASSERT_EQ(order.size(), list.size());
    std::vector<bool> left(list.size(), true);
    Vec at = list[0].at[0];
    for (const ChainVisit& v : order) {
      ASSERT_TRUE(left[v.chain]);
      double best = HUGE_VAL;
      for (std::size_t c = 0; c < list.size(); ++c)
        for (const Vec& p : list[c].at)
          if (left[c]) best = std::min(best, norm(p - at));
      EXPECT_EQ(norm(list[v.chain].at[v.entry] - at), best);
      left[v.chain] = false;
      at = list[v.chain].closed ? list[v.chain].at[v.entry] : list[v.chain].at[1 - v.entry];
    }
  }
}

/// Counts what is reported: the tree reports its steps.
class Counting final : public ProgressSink {
 public:
  void report(std::string_view, double, std::string_view) override { ++reports; }
  int reports = 0;
};

TEST(ChainOrder, TwiceAsManyTakeLittleMoreThanTwiceTheSteps) {
  const auto steps = [](int chains) {
    Random random(6);
    std::vector<ChainEntries> list;
    for (int i = 0; i < chains; ++i) {
      const Vec p{random.uniform(0, 1000), random.uniform(0, 1000), 0};
      list.push_back({{p, p + Vec{1, 0, 0}}, false});
    }
    Counting counting;
    EXPECT_EQ(nearest_order(list, counting).size(), list.size());
    return counting.reports;
  };
  const int many = steps(100'000);
  EXPECT_GT(many, 50);
  EXPECT_LE(many, 2.5 * steps(50'000));
}

TEST(ChainOrder, ManyAtOnePlaceWithinACircleOfOthers) {
  // Seen from the middle all of the circle is equally far: it must not be searched at every step.
  std::vector<ChainEntries> loops;
  for (int i = 0; i < 50'000; ++i)
    loops.push_back({{Vec{}, Vec{100 * std::cos(i * 1e-3), 100 * std::sin(i * 1e-3), 0}, Vec{}}, true});
  Counting counting;
  EXPECT_EQ(nearest_order(loops, counting).size(), loops.size());
  EXPECT_LT(counting.reports, 1'000);  // of 16 384 steps each
}

}  // namespace
}  // namespace bahnwerk
