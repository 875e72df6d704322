#include "core/geometry/region/crossings.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace bahnwerk {
namespace {

TEST(Crossings, AreThoseOfAllPairs) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0, 20), small(-3, 3);
  std::vector<Edge> edges;
  for (int i = 0; i < 60; ++i) {
    const Point from{any(random), any(random)};
    if (i % 3 == 0)
      edges.push_back(arc(from, 1 + std::abs(small(random)), small(random), 2));
    else
      edges.push_back(line(from, from + Point{small(random), small(random)}));
  }
  std::multiset<std::pair<std::size_t, std::size_t>> brute, found;
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t k = i + 1; k < edges.size(); ++k)
      for (std::size_t m = meetings(edges[i], edges[k]).size(); m-- > 0;) brute.emplace(i, k);
  each_meeting(edges, [&](std::size_t i, std::size_t k, const Meeting& m) {
    found.emplace(i, k);
    EXPECT_NEAR(distance(edges[i].at(m.first), edges[k].at(m.second)), 0, 1e-9);
  });
  EXPECT_GT(brute.size(), 10u);
  EXPECT_EQ(found, brute);
}

TEST(Crossings, ASimpleLoopHasNone) {
  const std::vector<Edge> square{line({0, 0}, {4, 0}), line({4, 0}, {4, 4}), line({4, 4}, {0, 4}),
                                 line({0, 4}, {0, 0})};
  EXPECT_FALSE(self_contact(square));
}

TEST(Crossings, AnEightTouchesItself) {
  const std::vector<Edge> eight{line({0, 0}, {4, 4}), line({4, 4}, {4, 0}), line({4, 0}, {0, 4}), line({0, 4}, {0, 0})};
  const auto contact = self_contact(eight);
  ASSERT_TRUE(contact);
  EXPECT_EQ(*contact, (std::pair<std::size_t, std::size_t>{0, 2}));
}

}  // namespace
}  // namespace bahnwerk
