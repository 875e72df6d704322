#include "core/cam/spline/degrees.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "tests/core/cases.hpp"

namespace bahnwerk::cam {
namespace {

/// All distributions, one after the other.
void try_all(const std::vector<PointShare>& shares, std::size_t sections, std::vector<int>& before,
             std::set<std::vector<int>>& best, std::pair<int, int>& least) {
  if (before.size() < shares.size()) {
    const PointShare& share = shares[before.size()];
    for (int b = share.before_min; b <= share.before_max; ++b) {
      before.push_back(b);
      try_all(shares, sections, before, best, least);
      before.pop_back();
    }
    return;
  }
  std::vector<int> degrees;
  std::pair<int, int> cost{0, 0};
  for (std::size_t s = 0; s < sections; ++s) {
    const std::size_t end = (s + 1) % shares.size();
    degrees.push_back(shares[s].total - before[s] + before[end] - 1);
    if (degrees.back() < 0) return;
    cost.first = std::max(cost.first, degrees.back());
    cost.second += degrees.back() * degrees.back();
  }
  if (best.empty() || cost < least) best.clear(), least = cost;
  if (cost == least) best.insert(degrees);
}

TEST(Degrees, EqualBruteForceOnSmallCases) {
  std::mt19937 random(4);
  for (int i = 0; i < testing::cases(1000); ++i) {
    const bool cycle = random() % 2 == 0;
    std::vector<PointShare> shares(2 + random() % 4);
    for (auto& share : shares) {
      const int joined = 1 + static_cast<int>(random() % 4), values = static_cast<int>(random() % (joined + 1));
      share = {joined + values, values, joined};
    }
    if (!cycle) {
      const int first = static_cast<int>(random() % 4), last = static_cast<int>(random() % 4);
      shares.front() = {first, 0, 0}, shares.back() = {last, last, last};
    }
    const std::size_t sections = shares.size() - (cycle ? 0 : 1);
    std::set<std::vector<int>> best;
    std::pair<int, int> least;
    std::vector<int> before;
    try_all(shares, sections, before, best, least);
    const auto found = balance_degrees(shares, std::vector<bool>(sections, true), 21, 10000);
    EXPECT_EQ(std::set<std::vector<int>>(found.degrees.begin(), found.degrees.end()), best) << i;
    EXPECT_TRUE(found.complete);
  }
}

TEST(Degrees, ManyTiesAreListedUpToTheNumberAskedFor) {
  std::vector<PointShare> shares(40, PointShare{5, 1, 4});
  shares.front() = {3, 0, 0}, shares.back() = {5, 5, 5};
  const auto found = balance_degrees(shares, std::vector<bool>(39, true), 21, 16);
  EXPECT_EQ(found.degrees.size(), 16u);
  EXPECT_FALSE(found.complete);
  // A choice that makes the first sections singular is not in all of them.
  std::set<std::vector<int>> beginnings;
  for (const auto& degrees : found.degrees) {
    beginnings.insert({degrees.begin(), degrees.begin() + 8});
    int sum = 0;
    for (const int degree : degrees) sum += degree;
    EXPECT_EQ(sum, 3 + 38 * 5 + 5 - 39);
  }
  EXPECT_GE(beginnings.size(), 8u);
}

/// 780 of them have two quartics; only where both are at the ends does every point share two and two.
TEST(Degrees, OfManyTiesTheMostEvenOneIsTheFirst) {
  std::vector<PointShare> shares(41, PointShare{4, 1, 3});
  shares.front() = {3, 0, 0}, shares.back() = {3, 3, 3};
  std::vector<int> even(40, 3);
  even.front() = even.back() = 4;
  for (const std::size_t at_most : {1, 16}) {
    const auto found = balance_degrees(shares, std::vector<bool>(40, true), 21, at_most);
    EXPECT_EQ(found.degrees.front(), even);
    EXPECT_EQ(std::set<std::vector<int>>(found.degrees.begin(), found.degrees.end()).size(), found.degrees.size());
    EXPECT_LE(found.degrees.size(), at_most);
  }
}

TEST(Degrees, AGivenSectionHasNone) {
  const auto found = balance_degrees({{3, 0, 0}, {4, 4, 4}, {4, 0, 0}, {3, 3, 3}}, {true, false, true}, 21, 10);
  EXPECT_EQ(found.degrees, (std::vector<std::vector<int>>{{6, -1, 6}}));
}

TEST(Degrees, ADegreeAboveTheLimitSaysWhichItWouldBe) {
  const auto found = balance_degrees({{12, 0, 0}, {12, 12, 12}}, {true}, 21, 10);
  EXPECT_TRUE(found.degrees.empty());
  EXPECT_EQ(found.least_maximum, 23);
}

TEST(Degrees, TheNextOnesAreNoBalancedOnesAndWithinTwoPercentOfTheLeastSum) {
  const std::vector<PointShare> shares(20, {5, 1, 4});
  const std::vector<bool> sections(20, true);
  const auto balanced = balance_degrees(shares, sections, 21, 64).degrees;
  ASSERT_EQ(balanced, std::vector<std::vector<int>>{std::vector<int>(20, 4)});
  const auto next = next_degrees(shares, sections, 21, 64);
  EXPECT_EQ(next.size(), 64u);
  EXPECT_EQ(std::set<std::vector<int>>(next.begin(), next.end()).size(), 64u);
  for (const auto& degrees : next) {
    int squares = 0;
    for (const int degree : degrees) squares += degree * degree;
    EXPECT_EQ(squares, 322);
  }
  EXPECT_TRUE(next_degrees(std::vector<PointShare>(4, {5, 1, 4}), std::vector<bool>(4, true), 21, 64).empty());
}

}  // namespace
}  // namespace bahnwerk::cam
