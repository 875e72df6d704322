#include "api/text/base64.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::api {
namespace {

TEST(Base64, VectorsOfRfc4648) {
  const std::pair<const char*, const char*> cases[] = {{"", ""},
                                                       {"f", "Zg=="},
                                                       {"fo", "Zm8="},
                                                       {"foo", "Zm9v"},
                                                       {"foob", "Zm9vYg=="},
                                                       {"fooba", "Zm9vYmE="},
                                                       {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : cases) {
    EXPECT_EQ(base64(bytes), text);
    EXPECT_EQ(from_base64(text), bytes);
  }
}

TEST(Base64, EveryByteComesBack) {
  std::string bytes;
  for (int i = 0; i < 256; ++i) bytes += static_cast<char>(i);
  for (std::size_t n = 0; n < 4; ++n) EXPECT_EQ(from_base64(base64(bytes.substr(n))), bytes.substr(n));
}

TEST(Base64, LineEndsAndMissingPaddingAreAcceptedNothingElse) {
  EXPECT_EQ(from_base64("Zm9v\r\nYg"), "foob");
  for (const char* text : {"Z", "Zg=a", "Zm9v=", "Zm 9v", "Zm9v-g", "===="})
    EXPECT_EQ(from_base64(text), std::nullopt) << text;
}

}  // namespace
}  // namespace bahnwerk::api
