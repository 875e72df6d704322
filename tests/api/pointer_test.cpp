#include "api/pointer.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::api {
namespace {

TEST(Pointer, EscapesTildeAndSlash) {
  EXPECT_EQ(pointer("/spec", {"a/b", "m~n", "", "7"}), "/spec/a~1b/m~0n//7");
  EXPECT_EQ(pointer("", {}), "");
}

TEST(InQuotes, CutsLongTextAtACharactersBoundary) {
  EXPECT_EQ(in_quotes("short"), "\"short\"");
  std::string text = std::string(59, 'x') + "äöü";  // the cut at 60 bytes falls into the ä
  EXPECT_EQ(in_quotes(text), '"' + std::string(59, 'x') + "…\"");
}

}  // namespace
}  // namespace bahnwerk::api
