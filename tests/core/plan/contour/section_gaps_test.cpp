#include "core/plan/contour/section_gaps.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"
#include "core/motion/axes/axis_path.hpp"
#include "core/motion/law/time_law.hpp"
#include "core/verify/bound/lower_bound.hpp"
#include "tests/core/plan/contour/verified_plans.hpp"

namespace bahnwerk {
namespace {

using test::axes_alike, test::verified_plan;

/// Four lines of 2, 0.5, 3 and 4 mm, each passed at 1 mm/s, with a dwell of 5 s behind the second.
struct Sections {
  Sections() {
    ContourBuilder b(2, {});
    for (const double x : {2.0, 2.5, 5.5, 9.5}) b.line({x, 0, 0});
    contour = b.finish();
    double s = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const double length = contour.path[i].length();
      LawPiece piece;
      piece.duration = length, piece.s = s, piece.s_end = s + length, piece.v = 1, piece.segment = i;
      law.append(piece);
      s += length;
      if (i != 1) continue;
      LawPiece dwell;
      dwell.duration = 5, dwell.s = dwell.s_end = s, dwell.segment = i;
      law.append(dwell);
    }
  }
  Contour contour;
  TimeLaw law;
  std::vector<SectionBound> bounds{{0, 1, 1.6}, {1, 2, 0.1}, {2, 3, 2.0}, {3, 4, 3.2}};
};

TEST(SectionGaps, TimesAreWithoutDwellsAndAsPlanned) {
  const Sections s;
  EXPECT_EQ(section_times(s.law, 1, s.bounds), (std::vector<double>{2, 0.5, 3, 4}));
  EXPECT_EQ(section_times(s.law, 2, s.bounds), (std::vector<double>{1, 0.25, 1.5, 2}));
  EXPECT_EQ(section_times(s.law, 1, {{0, 4, 1}}), (std::vector<double>{9.5}));
}

TEST(SectionGaps, ShortSectionsDoNotCountAndTheWorstIsNamed) {
  const Sections s;
  const CartesianAxisPath path(s.contour.path, 2);
  Progress silent;
  std::vector<SectionGap> each;
  const SectionGaps gaps = section_gaps(path, s.law, 1, s.bounds, silent, &each);
  EXPECT_EQ(gaps.count, 3u);
  ASSERT_EQ(each.size(), 3u);
  EXPECT_DOUBLE_EQ(gaps.worst.gap, 0.5);
  EXPECT_DOUBLE_EQ(gaps.worst.length, 3);
  EXPECT_DOUBLE_EQ(gaps.median, 0.25);
  EXPECT_DOUBLE_EQ(each[2].bound, 3.2);
}

TEST(SectionGaps, OfTwoInTheMiddleTheSmallerOneIsTheMedian) {
  Sections s;
  const CartesianAxisPath path(s.contour.path, 2);
  Progress silent;
  s.bounds.erase(s.bounds.begin());
  EXPECT_DOUBLE_EQ(section_gaps(path, s.law, 1, s.bounds, silent).median, 0.25);
  EXPECT_EQ(section_gaps(path, s.law, 1, {{1, 2, 0.1}}, silent).count, 0u);
}

// Bounds of sections add up to the bound, and their gaps to its gap.
TEST(SectionGaps, AddUp) {
  ContourBuilder b(2, {});
  b.block(Mode::cut, 300);
  b.line({40, 0, 0});
  b.arc({60, 20, 0}, {40, 20, 0}, true);
  b.line({60, 45, 0});
  b.dwell(0.5);
  b.line({30, 45, 0});
  b.line({30, 45.5, 0});  // too short to count
  b.line({0, 45.5, 0});
  const Contour contour = b.finish();
  const ContourPlan p = verified_plan(contour, axes_alike(1e6), PlanningMethod::jerk_limited, 0);
  EXPECT_EQ(p.sections.count, 3u);  // corners, and the dwell
  EXPECT_GE(p.sections.median, 0);
  EXPECT_LE(p.sections.median, p.sections.worst.gap);
  EXPECT_LT(p.sections.worst.gap, 0.03);
  EXPECT_EQ(p.sections.worst.source, 0u);  // the only one without a closed form
  EXPECT_NEAR(p.sections.worst.length, 65 + 10 * std::numbers::pi, 1e-9);
  // All others are exact: what the whole lacks is lacking here.
  EXPECT_NEAR(p.sections.worst.time - p.sections.worst.bound, p.duration - p.bound.value, 1e-7);
}

}  // namespace
}  // namespace bahnwerk
