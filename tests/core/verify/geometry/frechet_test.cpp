#include "core/verify/geometry/frechet.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/numeric/random.hpp"
#include "tests/core/silent_scope.hpp"

namespace bahnwerk::verify {
namespace {

constexpr std::size_t plenty = 1'000'000;

Traversal within(const std::vector<Vec>& a, const std::vector<Vec>& b, double radius, std::size_t most = plenty) {
  return traverse_within(a, b, radius, most, silent_scope());
}

TEST(Frechet, ParallelLines) {
  const std::vector<Vec> a{{}, {5, 0, 0}, {10, 0, 0}}, b{{0, 1, 0}, {1, 1, 0}, {10, 1, 0}};
  EXPECT_EQ(within(a, b, 1 + 1e-12), Traversal::possible);
  EXPECT_EQ(within(a, b, 1 - 1e-12), Traversal::impossible);
}

TEST(Frechet, ThereAndBackCostsHalfTheWay) {
  const std::vector<Vec> straight{{}, {10, 0, 0}}, back{{}, {6, 0, 0}, {4, 0, 0}, {10, 0, 0}};
  EXPECT_EQ(within(straight, back, 1 + 1e-9), Traversal::possible);
  EXPECT_EQ(within(straight, back, 1 - 1e-9), Traversal::impossible);
  EXPECT_EQ(within(back, straight, 1 + 1e-9), Traversal::possible);
  EXPECT_EQ(within(back, straight, 1 - 1e-9), Traversal::impossible);
}

TEST(Frechet, OrderCounts) {
  // Both lie on the same lines, but one loop is traversed the other way round.
  const std::vector<Vec> a{{}, {5, 0, 0}, {5, 5, 0}, {0, 5, 0}, {}, {-5, 0, 0}};
  const std::vector<Vec> b{{}, {0, 5, 0}, {5, 5, 0}, {5, 0, 0}, {}, {-5, 0, 0}};
  EXPECT_EQ(within(a, a, 1e-9), Traversal::possible);
  EXPECT_EQ(within(a, b, 3), Traversal::impossible);
}

TEST(Frechet, EndsBelongTogether) {
  const std::vector<Vec> a{{}, {10, 0, 0}}, shorter{{}, {9, 0, 0}};
  EXPECT_EQ(within(a, shorter, 0.99), Traversal::impossible);
  EXPECT_EQ(within(a, shorter, 1.01), Traversal::possible);
}

/// Largest distance of the best way through all pairs of vertices: an upper bound of the distance that counts, at most
/// an edge's length above it.
double discrete(const std::vector<Vec>& a, const std::vector<Vec>& b) {
  std::vector<double> row(b.size(), HUGE_VAL);
  for (std::size_t i = 0; i < a.size(); ++i) {
    double before = i == 0 ? 0.0 : HUGE_VAL;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const double old = row[j];
      const double least = std::min({before, old, j > 0 ? row[j - 1] : HUGE_VAL});
      row[j] = std::max(norm(a[i] - b[j]), least);
      before = old;
    }
  }
  return row.back();
}

TEST(Frechet, AgreesWithVerticesOfFinePolygons) {
  Random random(5);
  for (int round = 0; round < 200; ++round) {
    std::vector<Vec> a{{}}, b{{random.uniform(-0.1, 0.1), 0, 0}};
    const auto go = [&](std::vector<Vec>& p, Vec to, int parts) {
      const Vec from = p.back();
      for (int k = 1; k <= parts; ++k) p.push_back(from + (k / double(parts)) * (to - from));
    };
    for (int i = 0; i < 6; ++i) {
      const Vec way{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-0.3, 0.3)};
      go(a, a.back() + way, 40);
      go(b, a.back() + Vec{random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), 0}, 40);
    }
    double edge = 0;
    for (const auto* p : {&a, &b})
      for (std::size_t i = 1; i < p->size(); ++i) edge = std::max(edge, norm((*p)[i] - (*p)[i - 1]));
    const double d = discrete(a, b);
    EXPECT_EQ(within(a, b, d * (1 + 1e-12)), Traversal::possible);
    EXPECT_EQ(within(a, b, d - edge), Traversal::impossible);
  }
}

TEST(Frechet, CoilsEndInTime) {
  std::vector<Vec> coil;
  for (int i = 0; i < 4000; ++i) coil.push_back({0.01 * std::cos(i), 0.01 * std::sin(i), 0});
  EXPECT_EQ(within(coil, coil, 0.1, plenty), Traversal::too_long);
  EXPECT_EQ(within(coil, coil, 0.1, 100 * plenty), Traversal::possible);
}

}  // namespace
}  // namespace bahnwerk::verify
