#include "server/keys/key_text.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::server {
namespace {

TEST(KeyText, IsKnownByItsHashAlone) {
  const NewKey made = make_key(), other = make_key();
  EXPECT_NE(made.text, other.text);
  EXPECT_EQ(key_id(made.text), made.key.id);
  EXPECT_TRUE(is_key(made.text, made.key));
  EXPECT_FALSE(is_key(other.text, made.key));
  EXPECT_EQ(made.key.hash.find(made.text.substr(12)), std::string::npos);
  std::string changed = made.text;
  changed.back() = changed.back() == '0' ? '1' : '0';
  EXPECT_EQ(key_id(changed), made.key.id);
  EXPECT_FALSE(is_key(changed, made.key));
}

TEST(KeyText, OtherTextsAreNoKeys) {
  for (const char* text : {"", "bw_", "Bearer", "bw_12345678_"}) EXPECT_EQ(key_id(text), std::nullopt) << text;
  EXPECT_EQ(key_id(make_key().text + "0"), std::nullopt);
}

TEST(KeyText, NamesAreShortAndHaveNoBlanks) {
  for (const char* name : {"acme", "a", "erp@plant-2.example_x"}) EXPECT_TRUE(is_key_name(name)) << name;
  for (const char* name : {"", "a b", "a\nb", "ü", "a/b"}) EXPECT_FALSE(is_key_name(name)) << name;
  EXPECT_FALSE(is_key_name(std::string(65, 'a')));
}

}  // namespace
}  // namespace bahnwerk::server
