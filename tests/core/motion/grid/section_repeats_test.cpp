// Which sections count as the same.
#include "core/motion/grid/section_repeats.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "tests/core/motion/axes/five_axes.hpp"
#include "tests/core/motion/sheet.hpp"
#include "tests/support/machines.hpp"

namespace bahnwerk {
namespace {

constexpr double corner_angle = 2e-3;

/// Per section, which one it repeats.
std::vector<std::size_t> sources(const PathTask& task) {
  Progress silent;
  ProgressScope progress(silent, "test");
  const Sections sections = find_sections(task, corner_angle, progress);
  SectionRepeats repeats(task, sections, progress);
  std::vector<std::size_t> list;
  for (std::size_t i = 0; i + 1 < sections.begin.size(); ++i) list.push_back(repeats.source(i));
  return list;
}

std::vector<std::size_t> sources(const Contour& contour, const Machine& machine = testing::two_axes()) {
  const CartesianAxisPath path(contour.path, machine.dimension());
  return sources(contour_task(path, contour, machine));
}

/// A circle, a move, another circle: does the second repeat the first?
struct Circle {
  Vec centre;
  double radius = 2.5, feed = 300;
  bool ccw = true;
};
bool alike(const Circle& one, const Circle& other) {
  const auto begin = [](const Circle& c) { return c.centre + Vec{c.radius, 0, 0}; };
  ContourBuilder b(2, begin(one));
  b.block(Mode::cut, one.feed);
  b.arc(begin(one), one.centre, one.ccw);
  b.block(Mode::position, unlimited);
  b.line(begin(other));
  b.block(Mode::cut, other.feed);
  b.arc(begin(other), other.centre, other.ccw);
  const std::vector<std::size_t> list = sources(b.finish());
  EXPECT_EQ(list.size(), 3u);
  return list.back() == 0;
}

TEST(SectionRepeats, AHoleAtAnotherPlaceIsTheSame) {
  EXPECT_TRUE(alike({{0, 0, 0}}, {{10, 3, 0}}));
  EXPECT_TRUE(alike({{0.3, 0.7, 0}}, {{10.16, 900.1, 0}}));  // not to the last bit
}

TEST(SectionRepeats, SectionsThatDifferByMoreThanRoundingAreNotRepeated) {
  EXPECT_FALSE(alike({{0, 0, 0}}, {{10, 3, 0}, 2.5 + 1e-6}));
  EXPECT_FALSE(alike({{0, 0, 0}}, {{10, 3, 0}, 2.5 + 1e-9}));
  EXPECT_FALSE(alike({{0, 0, 0}}, {{10, 3, 0}, 2.5, 301}));
  EXPECT_FALSE(alike({{0, 0, 0}}, {{10, 3, 0}, 2.5, 300, false}));
}

TEST(SectionRepeats, EveryHoleOfASheetIsTheFirst) {
  for (const test::Hole hole : {test::Hole::circle, test::Hole::slot, test::Hole::free_form}) {
    const std::vector<std::size_t> list = sources(test::sheet(hole, 0, 50));
    std::size_t others = 0;
    for (std::size_t i = 2; i < list.size(); i += 2) others += list[i] != 0;
    EXPECT_EQ(list.size(), 99u);
    EXPECT_LE(others, hole == test::Hole::slot ? 3u : 0u);  // next to the path's begin places are known very well
  }
}

// The same tool path, other axes: a circle is a different motion wherever the arms reach it differently.
TEST(SectionRepeats, LooksAtTheAxesNotAtTheTool) {
  const Contour contour = test::sheet(test::Hole::circle, 0, 4);
  const test::FiveAxes kinematics;
  const Machine machine{kinematics.axes(), 0.001};
  const KinematicAxisPath path(contour.path, kinematics);
  const std::vector<std::size_t> list = sources(contour_task(path, contour, machine));
  for (std::size_t i = 0; i < list.size(); ++i) EXPECT_EQ(list[i], i);
}

// Tangent joints that are capped: the cap has to be the same, unless no motion could feel it.
TEST(SectionRepeats, CapsOfJointsCount) {
  const auto bent = [](double first, double second) {
    ContourBuilder b(2, {});
    const auto bow = [&](Vec at, double angle) {
      b.line(at + Vec{20, 0, 0});
      b.line(at + Vec{20 + 20 * std::cos(angle), 20 * std::sin(angle), 0});
    };
    bow({}, first);
    b.dwell(0);
    b.line({0, 30, 0});
    b.dwell(0);
    bow({0, 30, 0}, second);
    return sources(b.finish()).back() == 0;
  };
  EXPECT_TRUE(bent(1e-3, 1e-3));
  EXPECT_FALSE(bent(1e-3, 1.0001e-3));
  EXPECT_TRUE(bent(0, 0));
}

}  // namespace
}  // namespace bahnwerk
