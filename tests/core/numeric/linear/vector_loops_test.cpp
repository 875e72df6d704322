#include "core/numeric/linear/vector_loops.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

TEST(VectorLoops, TakeEveryNumberOnce) {
  Random random(12);
  for (std::size_t count = 0; count <= 9; ++count) {
    std::vector<double> a(count + 1), b(count + 1);
    for (std::vector<double>* numbers : {&a, &b})
      for (double& x : *numbers) x = static_cast<double>(random.below(100));
    const std::vector<double> before = b;
    double sum = 0;
    for (std::size_t k = 0; k < count; ++k) sum += a[k] * b[k];
    EXPECT_EQ(dot_product(a.data(), b.data(), count), sum);
    add_multiple(b.data(), 3, a.data(), count);
    for (std::size_t k = 0; k <= count; ++k) EXPECT_EQ(b[k], before[k] + (k < count ? 3 * a[k] : 0));
  }
}

}  // namespace
}  // namespace bahnwerk
