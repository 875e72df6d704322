// The same motion at another place: same times, places of that path.
#include "core/motion/law/repeated_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "core/geometry/curve/line.hpp"

namespace bahnwerk {
namespace {

Path lines(std::initializer_list<double> at) {
  Path path;
  for (const double* x = at.begin(); x + 1 != at.end(); ++x)
    path.append(std::make_shared<Line>(Vec{x[0], 0, 0}, Vec{x[1], 0, 0}), 0);
  return path;
}

// Segments 0 and 1, a third between, and two longer by rounding.
const Path path = lines({0, 4, 10, 17.3, 21.3 * (1 + 1e-15), 27.3});

TimeLaw law() {
  TimeLaw law;
  law.append({0, 1, 0, 4, 0, 8, 0, 0});
  law.append({0, 0.25, 4, 6, 8, 0, 0, 1});
  law.append({0, 1, 6, 10, 8, -8, 0, 1});
  law.append({0, 2, 10, 17.3, 3.65, 0, 0, 2});
  return law;
}

TimeLaw law_twice() {
  TimeLaw twice = law();
  Progress silent;
  ProgressScope progress(silent, "test");
  repeat_law(twice, path, {.from = 0, .to = 3, .source = 0, .copy = 3, .segments = 2}, progress);
  return twice;
}

TEST(RepeatedLaw, RunsTheSameWay) {
  const TimeLaw twice = law_twice();
  ASSERT_EQ(twice.pieces().size(), 7u);
  EXPECT_DOUBLE_EQ(twice.duration(), 2.25 + 2 + 2.25);
  for (std::size_t i = 0; i < 3; ++i) {
    const LawPiece &before = twice.pieces()[i], &after = twice.pieces()[4 + i];
    EXPECT_EQ(after.segment, before.segment + 3);
    EXPECT_EQ(after.duration, before.duration);
    EXPECT_DOUBLE_EQ(after.t0, 4.25 + before.t0);
    EXPECT_NEAR(after.v, before.v, 1e-13);
    EXPECT_NEAR(after.s - before.s, 17.3, 1e-13);
    EXPECT_NEAR(after.at(after.duration).s, after.s_end, 1e-13);
  }
}

TEST(RepeatedLaw, MeetsTheEndsOfSegmentsExactly) {
  const TimeLaw twice = law_twice();
  EXPECT_EQ(twice.pieces()[4].s, path[3].s0());
  EXPECT_EQ(twice.pieces()[4].s_end, path[3].s1());
  EXPECT_EQ(twice.pieces()[5].s, path[4].s0());
  EXPECT_EQ(twice.pieces()[6].s_end, path[4].s1());
}

}  // namespace
}  // namespace bahnwerk
