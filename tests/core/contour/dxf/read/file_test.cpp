#include "core/contour/dxf/read/file.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace bahnwerk {
namespace {

TEST(DxfFile, NamesAreComparedWithoutCaseOfAsciiLetters) {
  EXPECT_EQ(dxf_lower("Layer_0-A Z[@{"), "layer_0-a z[@{");
  EXPECT_EQ(dxf_lower("\xc3\x84"), "\xc3\x84") << "other letters stay";
  EXPECT_EQ(dxf_lower(""), "");
}

TEST(DxfFile, UnitsBelongTogether) {
  const auto mm = [](long code) { return dxf_unit(code).value(); };
  EXPECT_EQ(mm(1), 25.4);
  EXPECT_DOUBLE_EQ(mm(2), 12 * mm(1));    // foot
  EXPECT_DOUBLE_EQ(mm(3), 5280 * mm(2));  // mile
  EXPECT_DOUBLE_EQ(mm(10), 3 * mm(2));    // yard
  EXPECT_DOUBLE_EQ(mm(8) * 1e6, mm(1));   // microinch
  EXPECT_DOUBLE_EQ(mm(9) * 1e3, mm(1));   // mil
  EXPECT_EQ(mm(4), 1);
  EXPECT_DOUBLE_EQ(mm(13) * 1e3, mm(4));         // µm
  EXPECT_DOUBLE_EQ(mm(12) * 1e3, mm(13));        // nm
  EXPECT_DOUBLE_EQ(mm(11) * 10, mm(12));         // ångström
  EXPECT_DOUBLE_EQ(mm(14), 10 * mm(5));          // dm of cm
  EXPECT_DOUBLE_EQ(mm(15), 10 * mm(6));          // dam of m
  EXPECT_DOUBLE_EQ(mm(16) * 10, mm(7));          // hm of km
  EXPECT_DOUBLE_EQ(mm(21) * 3937, 1200 * 1000);  // US survey foot: 1200/3937 m
  EXPECT_DOUBLE_EQ(mm(22) * 12, mm(21));
  EXPECT_DOUBLE_EQ(mm(23), 3 * mm(21));
  EXPECT_DOUBLE_EQ(mm(24), 5280 * mm(21));
}

TEST(DxfFile, NoUnitAndUnitsBeyondAnyMachineAreNone) {
  for (const long code :
       {0L, 17L, 18L, 19L, 20L, 25L, -1L, std::numeric_limits<long>::min(), std::numeric_limits<long>::max()})
    EXPECT_FALSE(dxf_unit(code)) << code;
}

}  // namespace
}  // namespace bahnwerk
