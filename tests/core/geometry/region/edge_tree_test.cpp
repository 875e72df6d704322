#include "core/geometry/region/edge_tree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace bahnwerk {
namespace {

double square_distance(const Edge& edge, Point p) { return bahnwerk::square_distance(edge.at(edge.nearest(p)), p); }

/// A closed outline with many teeth.
std::vector<Edge> outline(std::size_t n) {
  std::vector<Edge> edges;
  const auto corner = [&](std::size_t i) {
    const double angle = 6.283185307179586 * static_cast<double>(i % n) / static_cast<double>(n);
    const double radius = i % 2 == 0 ? 20 : 17;
    return Point{radius * std::cos(angle), radius * std::sin(angle)};
  };
  for (std::size_t i = 0; i < n; ++i) edges.push_back(line(corner(i), corner(i + 1)));
  return edges;
}

TEST(EdgeTree, FindsTheEdgeThatASearchOfAllFinds) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> any(-25, 25);
  for (const std::size_t n : {4u, 32u, 33u, 400u, 1000u}) {
    const std::vector<Edge> edges = outline(n);
    const EdgeTree tree(edges);
    for (int query = 0; query < 50; ++query) {
      const Point p{any(random), any(random)};
      double brute = std::numeric_limits<double>::infinity();
      for (const Edge& edge : edges) brute = std::min(brute, square_distance(edge, p));
      double best = std::numeric_limits<double>::infinity();
      std::size_t looked = 0;
      tree.near(p, best, [&](std::size_t first, std::size_t last) {
        looked += last - first;
        for (std::size_t i = first; i < last; ++i) best = std::min(best, square_distance(edges[i], p));
      });
      EXPECT_EQ(best, brute);
      if (n == 1000 && norm(p) > 15) {
        EXPECT_LT(looked, n / 3);  // the tree is of use
      }
    }
  }
}

TEST(EdgeTree, AnEmptyOneVisitsNothing) {
  const double best = 1e9;
  EdgeTree().near({0, 0}, best, [](std::size_t, std::size_t) { FAIL(); });
}

}  // namespace
}  // namespace bahnwerk
