#include "core/contour/dxf/cut/chain.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

Strand line(Vec from, Vec to) {
  const double length = norm(to - from);
  const Vec way = (to - from) / length;
  return {from, to, way, way, length};
}

std::vector<StrandChain> chained(const std::vector<Strand>& strands, double tolerance = 0.01) {
  Progress silent;
  return chains(strands, tolerance, silent);
}

std::string shape(const std::vector<StrandChain>& list) {
  std::string text;
  for (const StrandChain& c : list) {
    if (!text.empty()) text += " ";
    for (const ChainLink& l : c.links) {
      text += l.reversed ? '-' : '+';
      text += std::to_string(l.strand);
    }
    if (c.closed) text += "o";
  }
  return text;
}

TEST(Chain, JoinsAndReverses) {
  EXPECT_EQ(shape(chained({line({0, 0, 0}, {10, 0, 0}), line({20, 0, 0}, {10, 0, 0}), line({0, 0, 0}, {0, 5, 0})})),
            "-2+0-1");
}

TEST(Chain, ClosesRings) {
  EXPECT_EQ(shape(chained({line({0, 0, 0}, {10, 0, 0}), line({0, 10, 0}, {0, 0, 0}), line({10, 0, 0}, {10, 10, 0}),
                           line({0, 10, 0}, {10, 10, 0})})),
            "+0+2-3+1o");
}

TEST(Chain, GoesStraightOnWhereSeveralMeet) {
  // A cross of four lines: two straight chains.
  EXPECT_EQ(shape(chained({line({-5, 0, 0}, {0, 0, 0}), line({0, 0, 0}, {0, 5, 0}), line({0, -5, 0}, {0, 0, 0}),
                           line({0, 0, 0}, {5, 0, 0})})),
            "+0+3 +2+1");
}

TEST(Chain, FigureOfEightIsOneChain) {
  // Two loops through one point; tangents along the diagonals there.
  const double h = std::sqrt(0.5);
  const Strand right{{0, 0, 0}, {0, 0, 0}, {h, h, 0}, {-h, h, 0}, 30};
  EXPECT_EQ(shape(chained({right})), "+0o");
  const Strand up{{0, 0, 0}, {10, 0, 0}, {h, h, 0}, {h, -h, 0}, 15},
      down{{10, 0, 0}, {0, 0, 0}, {-h, -h, 0}, {-h, h, 0}, 15};
  const Strand up_left{{0, 0, 0}, {-10, 0, 0}, {-h, h, 0}, {-h, -h, 0}, 15};
  const Strand down_left{{-10, 0, 0}, {0, 0, 0}, {h, -h, 0}, {h, h, 0}, 15};
  EXPECT_EQ(shape(chained({up, down, up_left, down_left})), "+0+1+2+3o");
}

TEST(Chain, CoincidentEndsComeBeforeGaps) {
  // The gap of 0.005 would be straight on, the coincident end turns by 90°.
  EXPECT_EQ(
      shape(chained({line({0, 0, 0}, {10, 0, 0}), line({10.005, 0, 0}, {20, 0, 0}), line({10, 0, 0}, {10, 5, 0})})),
      "+0+2 +1");
}

TEST(Chain, ToleranceIsKept) {
  const std::vector<Strand> two{line({0, 0, 0}, {10, 0, 0}), line({10.009, 0, 0}, {20, 0, 0})};
  EXPECT_EQ(shape(chained(two, 0.01)), "+0+1");
  EXPECT_EQ(shape(chained(two, 0.008)), "+0 +1");
  EXPECT_EQ(shape(chained(two, 0)), "+0 +1");
  EXPECT_EQ(shape(chained({line({0, 0, 0}, {1, 0, 0}), line({1, 0, 0}, {2, 0, 0})}, 0)), "+0+1");
}

TEST(Chain, EveryStrandOnce) {
  Random random(3);
  std::vector<Strand> strands;
  for (int i = 0; i < 4000; ++i) {
    const Vec p{std::floor(random.uniform(0, 30)), std::floor(random.uniform(0, 30)), 0};
    strands.push_back(line(p, p + Vec{1 + std::floor(random.uniform(0, 2)), std::floor(random.uniform(0, 3)), 0}));
  }
  std::vector<int> seen(strands.size());
  for (const StrandChain& c : chained(strands)) {
    const auto begin = [&](const ChainLink& l) { return l.reversed ? strands[l.strand].to : strands[l.strand].from; };
    const auto end = [&](const ChainLink& l) { return l.reversed ? strands[l.strand].from : strands[l.strand].to; };
    for (std::size_t i = 0; i < c.links.size(); ++i) {
      ++seen[c.links[i].strand];
      if (i > 0) {
        EXPECT_EQ(end(c.links[i - 1]), begin(c.links[i]));
      }
    }
    if (c.closed) {
      EXPECT_EQ(begin(c.links.front()), end(c.links.back()));
    }
  }
  for (const int n : seen) EXPECT_EQ(n, 1);
}

TEST(Chain, ManyAtOnePointAreAllTaken) {
  std::vector<Strand> star;
  for (int i = 0; i < 100'000; ++i) star.push_back(line({0, 0, 0}, {std::cos(i * 1e-4), std::sin(i * 1e-4), 0}));
  std::vector<int> taken(star.size());
  for (const StrandChain& chain : chained(star))
    for (const ChainLink& link : chain.links) ++taken[link.strand];
  EXPECT_EQ(taken, std::vector<int>(star.size(), 1));
}

}  // namespace
}  // namespace bahnwerk
