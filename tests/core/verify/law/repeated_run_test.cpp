// What counts as looked at, and that nothing hides behind it.
#include "core/verify/law/repeated_run.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "core/motion/jerk/jerk_limited.hpp"
#include "tests/core/motion/sheet.hpp"
#include "tests/core/verify/verdicts.hpp"

namespace bahnwerk {
namespace {

const Machine m{{{"x", 1800, 16000, 1e6}, {"y", 1800, 16000, 1e6}}, 0.001};

struct RepeatedRunsOfASheet : testing::Test {
  Contour contour = test::sheet(test::Hole::circle, 0, 12);
  TimeLaw law = [this] {
    Progress progress;
    return plan_jerk_limited(contour, m, {}, progress).law;
  }();

  /// How many of the holes are not looked at.
  std::size_t skipped(const TimeLaw& of) const {
    const CartesianAxisPath path(contour.path, 2);
    const VerifierInput input{path, m, of, contour.feeds(), contour.rest_places()};
    verify::RepeatedRuns runs(input);
    std::size_t count = 0;
    for (std::size_t i = 0; i < of.pieces().size();) {
      const std::size_t next = runs.skip(i), segment = of.pieces()[i].segment;
      count += next > i;
      while (i < of.pieces().size() && of.pieces()[i].segment == segment) ++i;
      if (next > i) ADD_FAILURE() << "a run goes on behind its segment";
    }
    return count;
  }
  /// A piece in the middle of the last hole.
  std::size_t inside() const {
    std::size_t first = 0;
    while (law.pieces()[first].segment + 1 < contour.path.size()) ++first;
    return (first + law.pieces().size()) / 2;
  }
};

TEST_F(RepeatedRunsOfASheet, AllHolesButTheFirstAreRepeated) { EXPECT_EQ(skipped(law), 11u); }

TEST_F(RepeatedRunsOfASheet, RunWithAnotherNumberIsNotRepeated) {
  for (double LawPiece::*number : {&LawPiece::s, &LawPiece::s_end, &LawPiece::v, &LawPiece::a, &LawPiece::j})
    EXPECT_EQ(skipped(reference::edited(law, inside(), [&](LawPiece& p) { p.*number *= 1 + 1e-9; })), 10u);
  EXPECT_EQ(skipped(reference::edited(law, inside() + 1, [](LawPiece& p) { p.duration *= 1 + 1e-9; })), 10u);
  EXPECT_EQ(skipped(reference::edited(law, inside(), [](LawPiece& p) { p.snap = 1; })), 10u);
}

// A hole of another radius under the same law.
TEST_F(RepeatedRunsOfASheet, RunOnAnotherArcIsNotRepeated) {
  ContourBuilder b(2, {1.7, 0, 0});
  b.block(Mode::cut, 300);
  b.arc({1.7, 0, 0}, {}, true);
  Progress progress;
  const Contour one = b.finish();
  const TimeLaw single = plan_jerk_limited(one, m, {}, progress).law;
  for (const double radius : {1.7, 1.7 * (1 + 1e-10)}) {
    contour = one;
    const Vec centre{30, 0, 0}, begin = centre + Vec{radius, 0, 0};
    contour.path.append(std::make_shared<Arc>(Arc::through(begin, begin, centre, {0, 0, 1}, true)), 1);
    contour.blocks.back().last = 2;
    TimeLaw twice = single;
    for (LawPiece p : single.pieces()) {
      p.s += one.path.length(), p.s_end += one.path.length(), p.segment = 1;
      twice.append(p);
    }
    EXPECT_EQ(skipped(twice), radius == 1.7 ? 1u : 0u);
  }
}

// What is too fast on the last hole alone is found.
TEST_F(RepeatedRunsOfASheet, AFaultOnOneHoleShows) {
  reference::expect_failed(reference::verdict(contour, m, law, 3), {});
  const TimeLaw spoiled = reference::edited(law, inside(), [](LawPiece& p) { p.j += 2.5e6; });
  const Verification v = reference::verdict(contour, m, spoiled, 3);
  EXPECT_FALSE(v.passed);
  EXPECT_TRUE(!reference::find(v, "jerk x").passed || !reference::find(v, "jerk y").passed);
}

}  // namespace
}  // namespace bahnwerk
