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
  const Lanes<N> both = a + b, difference = a - b, product = a * b, quotient = a / b,
                 mixed = 2 * a + 1 / b - (3 - b * 2), size = magnitude(a), low = smaller(a, b), high = larger(a, b);
  const Lanes<N> down = -a, side = root(a * a), some = where_less(a, b, 7 + 0 * a);
  double total = 0, most = a[0];
  for (std::size_t i = 0; i < N; ++i) {
    EXPECT_EQ(both[i], a[i] + b[i]);
    EXPECT_EQ(difference[i], a[i] - b[i]);
    EXPECT_EQ(product[i], a[i] * b[i]);
    EXPECT_EQ(quotient[i], a[i] / b[i]);
    EXPECT_EQ(mixed[i], 2 * a[i] + 1 / b[i] - (3 - b[i] * 2));
    EXPECT_EQ(size[i], std::abs(a[i]));
    EXPECT_EQ(low[i], std::min(a[i], b[i]));
    EXPECT_EQ(high[i], std::max(a[i], b[i]));
    EXPECT_EQ(down[i], -a[i]);
    EXPECT_EQ(side[i], std::sqrt(a[i] * a[i]));
    EXPECT_EQ(some[i], a[i] < b[i] ? 7 : 0);
    EXPECT_EQ(lanes(numbers<N>(a))[i], a[i]);
    total += a[i];
    most = std::max(most, a[i]);
  }
  EXPECT_EQ(sum(a), total);
  EXPECT_EQ(largest(a), most);
}

TEST(Lanes, CalculateLikeNumbers) {
  check<2>();
  check<3>();
}

}  // namespace
}  // namespace bahnwerk
