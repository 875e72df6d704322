#include "core/numeric/with_constant.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

TEST(WithConstant, TheConstantIsTheCount) {
  for (std::size_t count = 0; count <= 6; ++count)
    EXPECT_EQ(with_constant(count, [](auto constant) { return decltype(constant)::value; }), count);
}

}  // namespace
}  // namespace bahnwerk
