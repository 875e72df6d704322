#include "core/contour/gcode/notes.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::gcode {
namespace {

TEST(GcodeNotes, OneMatterIsOneNoteWithItsFirstLine) {
  Notes notes;
  notes.add(7, 30, "tool is not changed");
  notes.add(7, 31, "another text of that matter");
  notes.add(7, 40, "another text of that matter", 3);
  EXPECT_EQ(notes.texts(), (std::vector<std::string>{"line 30 and 4 more: tool is not changed"}));
}

TEST(GcodeNotes, AreOrderedByLine) {
  Notes notes;
  notes.add(1, 12, "second");
  notes.add(2, 3, "first");
  EXPECT_EQ(notes.texts(), (std::vector<std::string>{"line 3: first", "line 12: second"}));
}

TEST(GcodeNotes, ATextCanBeCompletedOnlyIfItWasNoted) {
  Notes notes;
  notes.add(1, 5, "short");
  notes.complete(1, "long");
  notes.complete(2, "never noted");
  EXPECT_EQ(notes.texts(), (std::vector<std::string>{"line 5: long"}));
}

TEST(GcodeNotes, BeyondSixtyFourMattersTheOthersAreCounted) {
  Notes notes;
  for (int key = 0; key < 70; ++key) notes.add(key, static_cast<std::size_t>(key) + 1, "matter");
  const auto texts = notes.texts();
  ASSERT_EQ(texts.size(), 65u);
  EXPECT_EQ(texts.back().substr(0, 20), "line 65 and 5 more: ");
}

}  // namespace
}  // namespace bahnwerk::gcode
