#include "core/contour/gcode/flow/outline.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"

namespace bahnwerk {
namespace {

TEST(GcodeOutline, Chains) {
  Progress progress;
  const gcode::Outline outline(
      "O10 (main)\no1 if [1]\n N5 o1 else\n/o1 else\no1 endif\n(c) o1 do\nG0 X1\no1 break\no1 while [0]\no2 endif",
      true, progress);
  EXPECT_EQ(outline.of_line(2), 1u);
  EXPECT_EQ(outline.of_line(4), gcode::Outline::none);
  EXPECT_EQ(outline.of_line(7), gcode::Outline::none);
  EXPECT_EQ(outline[1].next, 2u);
  EXPECT_EQ(outline[1].last, 3u);
  EXPECT_EQ(outline[3].head, 1u);
  EXPECT_EQ(outline[4].head, 4u);
  EXPECT_EQ(outline[5].head, 4u);
  EXPECT_EQ(outline[4].last, 6u);
  EXPECT_EQ(outline[7].head, gcode::Outline::none);
  EXPECT_EQ(outline.subprogram("10", true), 0u);
  EXPECT_EQ(outline.subprogram("10", false), gcode::Outline::none);
}

}  // namespace
}  // namespace bahnwerk
