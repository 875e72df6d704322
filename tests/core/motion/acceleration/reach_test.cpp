#include "core/motion/acceleration/reach.hpp"

#include <gtest/gtest.h>

#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

using Rows = LinkRows<12>;

bool feasible(const Rows& rows, double b1, double b2, double slack) {
  for (int i = 0; i < rows.n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (std::abs(rows.p[k] * b1 + rows.q[k] * b2) > rows.c[k] * (1 + slack)) return false;
  }
  return true;
}

/// Every vertex of the polygon, by intersecting all pairs of border lines: the largest feasible b1 with b2 ∈ [0, cap2].
double brute_backward(const Rows& rows, double cap1, double cap2) {
  struct Line {
    double p, q, c;
  };
  std::vector<Line> lines{{1, 0, 0}, {1, 0, cap1}, {0, 1, 0}, {0, 1, cap2}};
  for (int i = 0; i < rows.n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    lines.push_back({rows.p[k], rows.q[k], rows.c[k]});
    lines.push_back({rows.p[k], rows.q[k], -rows.c[k]});
  }
  double best = 0;
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (std::size_t j = i + 1; j < lines.size(); ++j) {
      const double det = lines[i].p * lines[j].q - lines[j].p * lines[i].q;
      if (std::abs(det) < 1e-14) continue;
      const double b1 = (lines[i].c * lines[j].q - lines[j].c * lines[i].q) / det;
      const double b2 = (lines[i].p * lines[j].c - lines[j].p * lines[i].c) / det;
      if (b1 < -1e-9 || b2 < -1e-9 || b1 > cap1 * (1 + 1e-9) || b2 > cap2 * (1 + 1e-9)) continue;
      if (feasible(rows, b1, b2, 1e-9)) best = std::max(best, b1);
    }
  return best;
}

TEST(Reach, BackwardFindsTheBestVertex) {
  Random random(7);
  for (int run = 0; run < 20000; ++run) {
    Rows rows;
    const int n = 1 + static_cast<int>(random.uniform(0, 12));
    for (int i = 0; i < n; ++i) {
      const bool axis = random.uniform(0, 1) < 0.1;
      const double p = axis ? 0 : random.uniform(-1, 1), q = random.uniform(-1, 1), c = random.uniform(0.1, 2);
      if (random.chance(0.1)) {
        rows.add(q, p, c);
      } else {
        rows.add(p, q, c);
      }
    }
    const double cap1 = random.uniform(0.1, 5), cap2 = random.uniform(0, 1) < 0.1 ? 0 : random.uniform(0, 5);
    const double expected = brute_backward(rows, cap1, cap2);
    EXPECT_NEAR(reach_backward(rows, cap1, cap2), expected, 1e-8 * (1 + expected)) << "run " << run;
  }
}

TEST(Reach, ForwardStaysFeasibleAndIsTheLargest) {
  Random random(8);
  for (int run = 0; run < 20000; ++run) {
    Rows rows;
    const int n = 1 + static_cast<int>(random.uniform(0, 12));
    for (int i = 0; i < n; ++i) {
      const double p = random.uniform(-1, 1), q = random.uniform(-1, 1), c = random.uniform(0.1, 2);
      rows.add(p, q, c);
    }
    const double cap1 = random.uniform(0.1, 5), cap2 = random.uniform(0, 5);
    const double b1 = reach_backward(rows, cap1, cap2) * random.uniform(0, 1);
    const double b2 = reach_forward(rows, b1, cap2);
    ASSERT_TRUE(feasible(rows, b1, b2, 1e-9)) << "run " << run;
    ASSERT_LE(b2, cap2);
    if (b2 < cap2) {
      EXPECT_FALSE(feasible(rows, b1, b2 + 1e-6, 0)) << "run " << run;
    }
  }
}

}  // namespace
}  // namespace bahnwerk
