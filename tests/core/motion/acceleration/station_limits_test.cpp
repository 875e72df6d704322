/// The closed answers of a plain link against the general search over its rows.
#include "core/motion/acceleration/station_limits.hpp"

#include <gtest/gtest.h>

#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

template <int N>
void compare(std::uint64_t seed) {
  Random random(seed);
  Machine machine;
  machine.axes.resize(N);
  int plain = 0, capped = 0, inner = 0;
  for (int n = 0; n < 20000; ++n) {
    Station<N> at;
    for (std::size_t k = 0; k < N; ++k) {
      at.d1[k] = random.uniform(-1, 1);
      at.d2[k] = random.uniform(-1, 1) * std::pow(10, random.uniform(-3, 0));
      at.d3[k] = random.uniform(-1, 1);
      machine.axes[k].velocity = 1;
      machine.axes[k].acceleration = random.uniform(1, 10);
    }
    const AxisBounds<N> limit(machine);
    const double h = std::pow(10, random.uniform(-3, -0.5)), share = random.uniform(0.5, 1);
    const PlainLink<N> link(PlainStation<N>(at, limit), h, share);
    if (!link.plain()) continue;
    ++plain;
    Rows<N> left, right;
    acceleration_rows<N, false>(left, at, h, share, limit);
    acceleration_rows<N, true>(right, at, -h, share, limit);
    const double x = random.uniform(0, 20), cap = random.uniform(0, 40), other = random.uniform(0, 40);
    const auto same = [&](double closed, double searched) {
      EXPECT_NEAR(closed, searched, 1e-10 * (1 + searched)) << n;
      (searched < cap ? inner : capped)++;
    };
    same(link.backward_left(cap, other), reach_backward(left, cap, other));
    same(link.backward_right(cap, other), reach_backward(right, cap, other));
    same(link.forward_left(x, cap), reach_forward(left, x, cap));
    same(link.forward_right(x, cap), reach_forward(right, x, cap));
  }
  EXPECT_GT(plain, 4000);
  EXPECT_GT(capped, 4000);
  EXPECT_GT(inner, 4000);
}

TEST(PlainLink, EqualsTheGeneralSearch) {
  compare<2>(1);
  compare<3>(2);
}

}  // namespace
}  // namespace bahnwerk
