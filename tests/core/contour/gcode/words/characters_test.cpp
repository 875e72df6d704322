#include "core/contour/gcode/words/characters.hpp"

#include <gtest/gtest.h>

#include <string>

namespace bahnwerk::gcode {
namespace {

/// All characters of which that holds, as a string.
template <class Holds>
std::string those(Holds holds) {
  std::string all;
  for (int c = 0; c < 256; ++c)
    if (holds(static_cast<char>(c))) all += static_cast<char>(c);
  return all;
}

TEST(Characters, AreThoseOfAsciiWhateverTheLocale) {
  EXPECT_EQ(those(blank), "\t ");
  EXPECT_EQ(those(end_of_line), "\n\r");
  EXPECT_EQ(those(part_of_number), ".0123456789");
  EXPECT_EQ(those(is_letter), "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz");
}

TEST(Characters, OnlySmallLettersHaveACapital) {
  EXPECT_EQ(capital('g'), 'G');
  EXPECT_EQ(those([](char c) { return capital(c) != c; }), "abcdefghijklmnopqrstuvwxyz");
}

}  // namespace
}  // namespace bahnwerk::gcode
