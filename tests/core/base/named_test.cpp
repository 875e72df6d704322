#include "core/base/named.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

enum class Colour { red, green, grey };
constexpr Named<Colour> colours[] = {{Colour::red, "red"}, {Colour::green, "green"}};

TEST(Named, ReadsTheTableBothWays) {
  for (const auto& [value, name] : colours) {
    EXPECT_STREQ(name_of<Colour>(value, colours), name);
    EXPECT_EQ(value_of<Colour>(name, colours), value);
  }
}

TEST(Named, NamesOutsideTheTableAreErrors) {
  EXPECT_THROW(value_of<Colour>("grey", colours), std::invalid_argument);
  EXPECT_THROW(value_of<Colour>("", colours), std::invalid_argument);
  EXPECT_THROW(name_of<Colour>(Colour::grey, colours), std::logic_error);
}

}  // namespace
}  // namespace bahnwerk
