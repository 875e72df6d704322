#include "core/drawing/svg.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::svg {
namespace {

TEST(Svg, NumbersHaveNoMoreDigitsThanTheyNeed) {
  EXPECT_EQ(number(3), "3");
  EXPECT_EQ(number(100), "100");
  EXPECT_EQ(number(0.25), "0.25");
  EXPECT_EQ(number(-1.00004), "-1");
  EXPECT_EQ(number(-0.00001), "0");
  EXPECT_EQ(number(2.00005000001), "2.0001");
}

TEST(Svg, TextCannotOpenAnElement) {
  EXPECT_EQ(escaped("a < b & c"), "a &lt; b &amp; c");
  EXPECT_EQ(text({1, 2}, "<script>", "").find("<script>"), std::string::npos);
}

TEST(Svg, ElementsBearTheirCoordinates) {
  EXPECT_EQ(circle({1, 2.5}, 3, "fill=\"none\""), "<circle cx=\"1\" cy=\"2.5\" r=\"3\" fill=\"none\"/>\n");
  EXPECT_EQ(segment({0, 0}, {4, -1}, "stroke=\"#000\""), "<path d=\"M0 0L4 -1\" stroke=\"#000\"/>\n");
  EXPECT_NE(open(640, 480).find("viewBox=\"0 0 640 480\""), std::string::npos);
}

}  // namespace
}  // namespace bahnwerk::svg
