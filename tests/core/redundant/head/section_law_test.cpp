#include "core/redundant/head/section_law.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "core/base/errors.hpp"
#include "core/geometry/curve/line.hpp"

namespace bahnwerk {
namespace {

/// Lines of 1, 2, 4 and 8 mm with right angles between them.
Path stairs() {
  Path path;
  Vec at{};
  for (int i = 0; i < 4; ++i) {
    const Vec to = at + static_cast<double>(1 << i) * (i % 2 == 0 ? Vec{1, 0, 0} : Vec{0, 1, 0});
    path.append(std::make_shared<const Line>(at, to), static_cast<std::size_t>(i));
    at = to;
  }
  return path;
}

TEST(SectionLaw, TheSectionIsPlannedByItselfAndPutWhereItLies) {
  const Path path = stairs();
  const CartesianAxisPath axes(path, 2);
  const Machine machine{{AxisLimits("x", 10), AxisLimits("y", 10)}, 0.001};
  const TimeLaw law = section_law(axes, 1, 3, machine, {5, 6, 7, 8}, [&](const PathTask& task) {
    EXPECT_EQ(task.path.size(), 2u);
    EXPECT_DOUBLE_EQ(task.path.length(), 6);
    EXPECT_EQ(task.feeds, (std::vector<double>{6, 7}));
    EXPECT_EQ(task.rests, (std::vector<bool>{true, false, true}));
    TimeLaw own;
    own.append({0, 1, 0, 2, 2, 0, 0, 0, 0});
    own.append({0, 2, 2, 6, 2, 0, 0, 1, 0});
    return own;
  });
  ASSERT_EQ(law.pieces().size(), 2u);
  EXPECT_DOUBLE_EQ(law.duration(), 3);
  EXPECT_EQ(law.pieces()[0].segment, 1u);
  EXPECT_EQ(law.pieces()[0].s, path[1].s0());
  EXPECT_EQ(law.pieces()[1].segment, 2u);
  EXPECT_EQ(law.pieces()[1].s_end, path[2].s1()) << "the end is the segment's, without rounding";
}

TEST(SectionLaw, WhatThePlannerThrowsIsPassedOn) {
  const Path path = stairs();
  const CartesianAxisPath axes(path, 2);
  EXPECT_THROW(section_law(axes, 0, 1, {}, {1, 1, 1, 1}, [](const PathTask&) -> TimeLaw { throw Infeasible("no"); }),
               Infeasible);
}

}  // namespace
}  // namespace bahnwerk
