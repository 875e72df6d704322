#include "core/numeric/lanes.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

template <int N>
void check() {
  Lanes<N> a{}, b{};
  for (std::size_t i = 0; i < N; ++i) {
    a[i] = 1.5 - static_cast<double>(i);
    b[i] = i % 2 ? -2 : 4;
  }
  const Lanes<N> sum = a + b, difference = a - b, product = a * b, quotient = a / b,
                 mixed = 2 * a + 1 / b - (3 - b * 2), size = magnitude<N>(a), turn = turned<N>(a, b);
  for (std::size_t i = 0; i < N; ++i) {
    EXPECT_EQ(sum[i], a[i] + b[i]);
    EXPECT_EQ(difference[i], a[i] - b[i]);
    EXPECT_EQ(product[i], a[i] * b[i]);
    EXPECT_EQ(quotient[i], a[i] / b[i]);
    EXPECT_EQ(mixed[i], 2 * a[i] + 1 / b[i] - (3 - b[i] * 2));
    EXPECT_EQ(size[i], std::abs(a[i]));
    EXPECT_EQ(turn[i], b[i] < 0 ? -a[i] : a[i]);
  }
}

TEST(Lanes, CalculateLikeNumbers) {
  check<2>();
  check<3>();
}

}  // namespace
}  // namespace bahnwerk
