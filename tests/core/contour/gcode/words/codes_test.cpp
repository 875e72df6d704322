#include "core/contour/gcode/words/codes.hpp"

#include <gtest/gtest.h>

#include <set>

namespace bahnwerk::gcode {
namespace {

TEST(Codes, NamesAreWrittenAsProgramsWriteThem) {
  EXPECT_EQ(name(0), "G0");
  EXPECT_EQ(name(51), "G5.1");
  EXPECT_EQ(name(593), "G59.3");
  EXPECT_EQ(name(1870), "G187");
  EXPECT_EQ(m_name(30), "M30");
  EXPECT_EQ(m_name(-8623), "M862.3");
  EXPECT_EQ(whole_m(-8623), 862);
  EXPECT_EQ(whole_m(7), 7);
}

TEST(Codes, WhatIsRefusedSaysWhyAndBelongsToNoGroup) {
  int refused = 0;
  for (int g = 0; g <= 10000; ++g) {
    const Code code = meaning(g);
    ASSERT_NE(code.text, nullptr);
    if (code.action != Action::refuse) continue;
    ++refused;
    EXPECT_EQ(code.group, Group::none) << name(g);
    EXPECT_NE(std::string(code.text), "") << name(g);
  }
  EXPECT_GT(refused, 9800);
  EXPECT_EQ(meaning(-10).action, Action::refuse);
}

TEST(Codes, ModalWordsOfOneGroupTakeNoWordsButThoseOfMotion) {
  for (int g = 0; g <= 2000; ++g) {
    const Group group = meaning(g).group;
    if (group != Group::none && group != Group::motion && group != Group::compensation) {
      EXPECT_FALSE(takes_words(g)) << name(g);
    }
  }
  for (const int g : {0, 10, 20, 30, 40, 50, 51, 810, 920, 410, 420}) EXPECT_TRUE(takes_words(g)) << name(g);
  EXPECT_FALSE(takes_words(800)) << "G80 ends a cycle";
  EXPECT_FALSE(takes_words(400));
}

TEST(Codes, EveryWorkOffsetIsOneOfTheSameGroup) {
  for (const int g : {540, 550, 560, 570, 580, 590, 591, 592, 593}) {
    EXPECT_EQ(meaning(g).action, Action::work_offset);
    EXPECT_EQ(meaning(g).group, Group::work);
  }
  EXPECT_EQ(meaning(594).action, Action::refuse);
}

TEST(Codes, NoMWordIsBothAMachinesAndAPrinters) {
  for (int m = 0; m <= 1000; ++m) {
    EXPECT_FALSE(known_m(m) && printer_m(m)) << m;
    if (printer_effect(m) != nullptr) {
      EXPECT_TRUE(printer_m(m)) << m;
    }
  }
  EXPECT_TRUE(known_m(30));
  EXPECT_TRUE(printer_m(104));
}

}  // namespace
}  // namespace bahnwerk::gcode
