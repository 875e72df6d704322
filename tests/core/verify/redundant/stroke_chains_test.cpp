#include "core/verify/redundant/stroke_chains.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "core/verify/redundant/stroke_bound.hpp"
#include "tests/core/verify/redundant/long_moves.hpp"

namespace bahnwerk {
namespace {

using test::coarse;
using test::head;
using test::least;
using test::moves;

struct Bounded {
  std::vector<SectionBound> sections;
  double single = 0, gain = 0;  ///< s
  double total() const { return single + gain; }
};

/// With a plan in which every section takes `longer` times its bound.
Bounded bounded(const Contour& contour, double longer) {
  const CartesianAxisPath path(contour.path, 2);
  const PathTask task = contour_task(path, contour, head);
  const std::vector<AxisLimits> fine = test::fine(20);
  Progress progress;
  Bounded b;
  lower_bound(task, 1e-3, progress, &b.sections);
  raise_by_stroke({task, coarse, fine}, b.sections, progress);
  std::vector<double> planned;
  for (const SectionBound& s : b.sections) planned.push_back(longer * s.duration), b.single += s.duration;
  b.gain = gain_of_chains({task, coarse, fine}, b.sections, planned, progress);
  return b;
}

/// There and back: the coarse axis moves over all but two strokes and turns round, at rest for a moment, as if there
/// were two moves. Each for itself may have it pass the rest between them at speed.
TEST(StrokeChains, ThereAndBackTakesTheCoarseAxisTwoMoves) {
  for (const double length : {150.0, 500.0, 1000.0}) {
    const double both = 2 * least(length - 40);
    const Contour contour = moves({{length, 0, 0}, {0, 0, 0}});
    const double single = bounded(contour, 1).single;
    const Bounded b = bounded(contour, 1.02 * both / single);
    EXPECT_LT(b.single, 0.95 * both) << length;
    EXPECT_GT(b.gain, 0.8 * (both - b.single)) << length;
    EXPECT_LE(b.total(), both) << length;
  }
}

/// A plan says where to look, not what is proven.
TEST(StrokeChains, NoPlanMakesTheBoundLongerThanTheShortestMotion) {
  const double both = 2 * least(460);
  for (const double longer : {1.001, 1.01, 1.05, 1.2, 2.0, 10.0})
    EXPECT_LE(bounded(moves({{500, 0, 0}, {0, 0, 0}}), longer).total(), both) << longer;
  EXPECT_EQ(bounded(moves({{500, 0, 0}, {0, 0, 0}}), 1).gain, 0);
}

/// The same on axes at an angle, in reverse, and with what else there is before and behind.
TEST(StrokeChains, WhatLiesAroundAChainAddsNothingThatIsNotThere) {
  const double gain = bounded(moves({{500, 0, 0}, {0, 0, 0}}), 1.08).gain;
  EXPECT_NEAR(bounded(moves({{0, -500, 0}, {0, 0, 0}}), 1.08).gain, gain, 1e-6);
  EXPECT_NEAR(bounded(moves({{500, 500, 0}, {0, 0, 0}}), 1.08).gain, gain, 1e-6);
  // With time before and behind the coarse axis begins and ends elsewhere, and in motion.
  const Bounded among = bounded(moves({{-15, 0, 0}, {0, 0, 0}, {500, 0, 0}, {0, 0, 0}, {-15, 0, 0}, {0, 0, 0}}), 1.08);
  EXPECT_LT(among.sections[2].duration + among.sections[3].duration + among.gain, 2 * least(460));
}

TEST(StrokeChains, ShortMovesGainNothing) {
  EXPECT_EQ(bounded(moves({{30, 0, 0}, {0, 0, 0}, {30, 5, 0}}), 1.08).gain, 0);
}

/// In a dwell the coarse axis has all the time it needs.
TEST(StrokeChains, DwellsPartChains) { EXPECT_EQ(bounded(moves({{500, 0, 0}, {0, 0, 0}}, 10), 1.08).gain, 0); }

/// Of chains that overlap only one counts.
TEST(StrokeChains, NoSectionCountsTwice) {
  std::vector<Vec> to;
  for (int i = 0; i < 10; ++i) to.push_back({i % 2 == 0 ? 500.0 : 0.0, 0, 0});
  const Bounded b = bounded(moves(to), 1.08);
  EXPECT_GT(b.gain, 0);
  EXPECT_LE(b.total(), 10 * least(460));
}

}  // namespace
}  // namespace bahnwerk
