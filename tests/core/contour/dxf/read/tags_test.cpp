#include "core/contour/dxf/read/tags.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

TEST(DxfTags, PairsHaveTheirLines) {
  Progress progress;
  DxfTags tags("  0\nLINE\n999\nnobody reads this\n 10\n  1.5 \r\n", progress);
  DxfTag tag;
  ASSERT_TRUE(tags.next(tag));
  EXPECT_EQ(tag.code, 0);
  EXPECT_EQ(tag.value, "LINE");
  EXPECT_EQ(tag.line, 2u);
  ASSERT_TRUE(tags.next(tag));
  EXPECT_EQ(tag.code, 10);
  EXPECT_EQ(tag.value, "1.5");
  EXPECT_EQ(tag.line, 6u);
  EXPECT_FALSE(tags.next(tag));
}

TEST(DxfTags, RecordsBeginWithCodeZeroAndCanBeReadAgain) {
  Progress progress;
  DxfTags tags("5\nlost\n0\nLINE\n8\nA\n10\n1\n0\nARC\n40\n2\n0\nEOF\n", progress);
  DxfRecord record;
  ASSERT_TRUE(tags.next(record));
  EXPECT_EQ(record.type, "LINE");
  ASSERT_EQ(record.tags.size(), 2u);
  EXPECT_EQ(record.tags[0].code, 8);
  const DxfTags::Mark arc = tags.mark();
  ASSERT_TRUE(tags.next(record, false));
  EXPECT_EQ(record.type, "ARC");
  EXPECT_TRUE(record.tags.empty());
  tags.seek(arc);
  ASSERT_TRUE(tags.next(record));
  EXPECT_EQ(record.type, "ARC");
  EXPECT_EQ(record.tags.size(), 1u);
}

TEST(DxfTags, NumbersAreReadWholeOrRefusedWithTheirLine) {
  EXPECT_EQ(dxf_real({10, "-2.5e1", 4}), -25);
  EXPECT_EQ(dxf_integer({70, "12", 4}), 12);
  EXPECT_EQ(dxf_integer({70, "12.0", 4}), 12);
  for (const char* wrong : {"", "1x", "nan", "1e999", "inf"}) {
    try {
      dxf_real({10, wrong, 4});
      FAIL() << wrong;
    } catch (const InvalidInput& error) {
      EXPECT_EQ(error.faults.at(0).place, (std::vector<std::string>{"contour", "dxf"}));
      EXPECT_EQ(error.faults.at(0).message.rfind("line 4: ", 0), 0u);
    }
  }
  EXPECT_THROW(dxf_integer({70, "1.5", 4}), InvalidInput);
  EXPECT_THROW(dxf_integer({70, "3000000000", 4}), InvalidInput);
}

TEST(DxfTags, ACodeWithoutValueOrBeyondTheFormatIsRefused) {
  Progress progress;
  DxfTag tag;
  for (const char* text : {"0\n", "0\nLINE\n10\n", "1072\nx\n", "-6\nx\n", "abc\nx\n"}) {
    DxfTags tags(text, progress);
    EXPECT_THROW(while (tags.next(tag)){}, InvalidInput) << text;
  }
}

TEST(DxfTags, WhatIsQuotedIsPrintable) {
  EXPECT_EQ(dxf_quoted("LINE"), "\"LINE\"");
  EXPECT_EQ(dxf_quoted("a\x01\xffz"), "\"a??z\"");
  EXPECT_EQ(dxf_quoted(std::string(1000, 'x')), "\"" + std::string(40, 'x') + "…\"");
}

}  // namespace
}  // namespace bahnwerk
