#include "core/verify/redundant/stroke_bound.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "tests/core/verify/redundant/long_moves.hpp"

namespace bahnwerk {
namespace {

using test::coarse;
using test::fine;
using test::head;
using test::least;
using test::moves;

struct Bounded {
  std::vector<SectionBound> sections, before;
  StrokeGain gain;
};

Bounded bounded(const Contour& contour, double stroke) {
  const CartesianAxisPath path(contour.path, 2);
  const PathTask task = contour_task(path, contour, head);
  Progress progress;
  Bounded b;
  lower_bound(task, 1e-3, progress, &b.sections);
  b.before = b.sections;
  b.gain = raise_by_stroke({task, coarse, fine(stroke)}, b.sections, progress);
  return b;
}

TEST(StrokeBound, ALoneMoveTakesWhatTheCoarseAxisDoesForAllButTwoStrokes) {
  for (const double length : {120.0, 300.0, 1000.0, 2000.0}) {
    const Bounded b = bounded(moves({{length, 0, 0}}), 20);
    EXPECT_EQ(b.gain.sections, 1u);
    EXPECT_LE(b.sections[0].duration, least(length - 40));
    EXPECT_GE(b.sections[0].duration, least(length - 40) * (1 - 1e-3)) << length;
    EXPECT_NEAR(b.gain.duration, b.sections[0].duration - b.before[0].duration, 1e-9);
  }
}

TEST(StrokeBound, AShortMoveIsThatOfTheHead) {
  const Bounded b = bounded(moves({{30, 20, 0}}), 20);
  EXPECT_EQ(b.gain.sections, 0u);
  EXPECT_EQ(b.sections[0].duration, b.before[0].duration);
}

/// There and back: the coarse axis turns round where the head rests, within two strokes.
TEST(StrokeBound, TheCoarseAxisMayStillMoveWhereTheHeadRests) {
  const Bounded b = bounded(moves({{500, 0, 0}, {0, 0, 0}}), 20);
  EXPECT_EQ(b.gain.sections, 2u);
  EXPECT_LT(b.sections[0].duration, 0.95 * least(460));
  EXPECT_GT(b.sections[0].duration, 1.3 * b.before[0].duration);
  EXPECT_NEAR(b.sections[0].duration, b.sections[1].duration, 1e-3 * b.sections[0].duration);
}

/// A coarse axis that has time at the rests travels in them, and one that can be anywhere beforehand needs less.
TEST(StrokeBound, DwellsDoNotCount) {
  const Bounded b = bounded(moves({{500, 0, 0}, {520, 0, 0}}, 10), 20), without = bounded(moves({{500, 0, 0}}), 20);
  EXPECT_LT(b.sections[0].duration, without.sections[0].duration);
  EXPECT_GT(b.sections[0].duration, b.before[0].duration);
}

TEST(StrokeBound, MoreStrokeNeverGivesALongerBound) {
  double before = 1;
  for (const double stroke : {5.0, 10.0, 20.0, 40.0, 80.0, 160.0}) {
    const double now = bounded(moves({{400, 100, 0}, {420, 110, 0}, {0, 0, 0}}), stroke).gain.duration;
    EXPECT_LE(now, before + 1e-4) << stroke;
    before = now;
  }
  EXPECT_EQ(before, 0);
}

}  // namespace
}  // namespace bahnwerk
