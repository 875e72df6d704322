#pragma once
/// What the curve tests share: independent derivatives, random curves, and relative comparison of vectors.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/errors.hpp"
#include "core/geometry/curve/curve.hpp"
#include "core/geometry/curve/nurbs.hpp"
#include "core/numeric/random.hpp"

namespace bahnwerk::testing {

inline void expect_near(Vec a, Vec b, double tolerance, const std::string& what = {}) {
  EXPECT_LE(norm(a - b), tolerance) << what << " (" << a.x << ' ' << a.y << ' ' << a.z << ") against (" << b.x << ' '
                                    << b.y << ' ' << b.z << ')';
}

/// f'(x) by central differences of order 8.
template <class F>
Vec difference(F&& f, double x, double h) {
  return (672.0 * (f(x + h) - f(x - h)) - 168.0 * (f(x + 2 * h) - f(x - 2 * h)) + 32.0 * (f(x + 3 * h) - f(x - 3 * h)) -
          3.0 * (f(x + 4 * h) - f(x - 4 * h))) /
         (840 * h);
}

/// Each derivative of `jet_at` against the difference quotient of the one before, relative to the largest of its kind.
template <class F>
void expect_consistent(F&& jet_at, double begin, double end, double tolerance, double step = 5e-4) {
  const double width = end - begin, h = step * width;
  double m1 = 0, m2 = 0, m3 = 0;
  for (int i = 0; i <= 40; ++i) {
    const Jet jet = jet_at(begin + width * (0.05 + 0.9 * i / 40));
    m1 = std::max(m1, norm(jet.d1));
    m2 = std::max(m2, norm(jet.d2));
    m3 = std::max(m3, norm(jet.d3));
  }
  m2 += m1 / width;
  m3 += m2 / width;
  for (int i = 0; i <= 40; ++i) {
    const double x = begin + width * (0.05 + 0.9 * i / 40);
    const Jet jet = jet_at(x);
    const std::string at = " at " + std::to_string(x);
    expect_near(jet.d1, difference([&](double y) { return jet_at(y).value; }, x, h), tolerance * m1, "d1" + at);
    expect_near(jet.d2, difference([&](double y) { return jet_at(y).d1; }, x, h), tolerance * m2, "d2" + at);
    expect_near(jet.d3, difference([&](double y) { return jet_at(y).d2; }, x, h), tolerance * m3, "d3" + at);
    EXPECT_FALSE(::testing::Test::HasFailure()) << "first failure" << at;
    if (::testing::Test::HasFailure()) return;
  }
}

inline Vec random_point(Random& random, bool planar, double size = 10) {
  return {random.uniform(-size, size), random.uniform(-size, size), planar ? 0.0 : random.uniform(-size, size)};
}

/// Degree 1–6, random knots with multiplicities, weights in [0.1, 10] or none, clamped or not.
inline Nurbs random_nurbs(Random& random) {
  const std::size_t p = 1 + random.below(6), n = p + 1 + random.below(8);
  const bool planar = random.chance(0.5), clamped = random.chance(0.7);
  std::vector<Vec> points;
  std::vector<double> weights, knots;
  for (std::size_t i = 0; i < n; ++i) points.push_back(random_point(random, planar));
  if (random.chance(0.6))
    for (std::size_t i = 0; i < n; ++i) weights.push_back(std::pow(10.0, random.uniform(-1, 1)));
  double u = random.uniform(-2, 2);
  std::size_t same = 1;
  for (std::size_t i = 0; i < n + p + 1; ++i) {
    const bool end = clamped && (i <= p || i >= n);
    if (i > 0 && !(end && i != n) && (i == p + 1 || i == n || same >= p || !random.chance(0.25))) {
      u += random.uniform(0.1, 1);
      same = 1;
    } else if (i > 0) {
      ++same;
    }
    knots.push_back(u);
  }
  return {p, points, weights, knots};
}

/// The places of the faults that `f` throws, "/a/b" each; empty when it throws nothing.
template <class F>
std::vector<std::string> fault_places(F&& f) {
  std::vector<std::string> places;
  try {
    f();
  } catch (const InvalidInput& invalid) {
    for (const InputFault& fault : invalid.faults) {
      std::string place;
      for (const std::string& step : fault.place) place += '/' + step;
      places.push_back(place);
    }
    if (places.empty()) places.emplace_back("(no fault listed)");
  }
  return places;
}

}  // namespace bahnwerk::testing
