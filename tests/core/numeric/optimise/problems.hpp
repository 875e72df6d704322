#pragma once
/// Problems with known minima.
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/numeric/optimise/optimise.hpp"
#include "core/numeric/random.hpp"

namespace bahnwerk {

using Point = std::span<const double>;
using Values = std::span<double>;

struct KnownProblem {
  OptimisationProblem problem;
  std::vector<double> start;
  double minimum;
  std::vector<double> x;  // where, if known
};

inline void fill(Values out, std::initializer_list<double> values) {
  if (!out.empty()) std::copy(values.begin(), values.end(), out.begin());
}

/// NLopt's tutorial: √x₂ above two cubics.
inline KnownProblem tutorial() {
  OptimisationProblem p;
  p.dimension = 2;
  p.lower = {-HUGE_VAL, 1e-9};
  p.objective = [](Point x, Values g) {
    fill(g, {0, 0.5 / std::sqrt(x[1])});
    return std::sqrt(x[1]);
  };
  p.inequality = {2, [](Point x, Values c, Values j) {
                    const double a = 2 * x[0], b = 1 - x[0];
                    c[0] = a * a * a - x[1];
                    c[1] = b * b * b - x[1];
                    fill(j, {6 * a * a, -1, -3 * b * b, -1});
                  }};
  return {p, {1.234, 5.678}, 0.54433105395181736, {1.0 / 3, 8.0 / 27}};
}

inline KnownProblem rosenbrock() {
  OptimisationProblem p;
  p.dimension = 2;
  p.objective = [](Point x, Values g) {
    const double a = x[1] - x[0] * x[0], b = 1 - x[0];
    fill(g, {-400 * a * x[0] - 2 * b, 200 * a});
    return 100 * a * a + b * b;
  };
  return {p, {-1.2, 1}, 0, {1, 1}};
}

/// The next three: Hock, Schittkowski: Test Examples for Nonlinear Programming Codes, 1981.
inline KnownProblem hs35() {
  OptimisationProblem p;
  p.dimension = 3;
  p.lower = {0, 0, 0};
  p.objective = [](Point x, Values g) {
    fill(g, {-8 + 4 * x[0] + 2 * x[1] + 2 * x[2], -6 + 4 * x[1] + 2 * x[0], -4 + 2 * x[2] + 2 * x[0]});
    return 9 - 8 * x[0] - 6 * x[1] - 4 * x[2] + 2 * x[0] * x[0] + 2 * x[1] * x[1] + x[2] * x[2] + 2 * x[0] * x[1] +
           2 * x[0] * x[2];
  };
  p.inequality = {1, [](Point x, Values c, Values j) {
                    c[0] = x[0] + x[1] + 2 * x[2] - 3;
                    fill(j, {1, 1, 2});
                  }};
  return {p, {0.5, 0.5, 0.5}, 1.0 / 9, {4.0 / 3, 7.0 / 9, 4.0 / 9}};
}

inline KnownProblem hs43() {
  OptimisationProblem p;
  p.dimension = 4;
  p.objective = [](Point x, Values g) {
    fill(g, {2 * x[0] - 5, 2 * x[1] - 5, 4 * x[2] - 21, 2 * x[3] + 7});
    return x[0] * x[0] + x[1] * x[1] + 2 * x[2] * x[2] + x[3] * x[3] - 5 * x[0] - 5 * x[1] - 21 * x[2] + 7 * x[3];
  };
  p.inequality = {3, [](Point x, Values c, Values j) {
                    const double a = x[0] * x[0], b = x[1] * x[1], d = x[2] * x[2], e = x[3] * x[3];
                    c[0] = a + b + d + e + x[0] - x[1] + x[2] - x[3] - 8;
                    c[1] = a + 2 * b + d + 2 * e - x[0] - x[3] - 10;
                    c[2] = 2 * a + b + d + 2 * x[0] - x[1] - x[3] - 5;
                    fill(j, {2 * x[0] + 1, 2 * x[1] - 1, 2 * x[2] + 1, 2 * x[3] - 1,  //
                             2 * x[0] - 1, 4 * x[1], 2 * x[2], 4 * x[3] - 1,          //
                             4 * x[0] + 2, 2 * x[1] - 1, 2 * x[2], -1});
                  }};
  return {p, {0, 0, 0, 0}, -44, {0, 1, 2, -1}};
}

inline KnownProblem hs100() {
  OptimisationProblem p;
  p.dimension = 7;
  p.objective = [](Point x, Values g) {
    fill(g, {2 * (x[0] - 10), 10 * (x[1] - 12), 4 * std::pow(x[2], 3), 6 * (x[3] - 11), 60 * std::pow(x[4], 5),
             14 * x[5] - 4 * x[6] - 10, 4 * std::pow(x[6], 3) - 4 * x[5] - 8});
    return std::pow(x[0] - 10, 2) + 5 * std::pow(x[1] - 12, 2) + std::pow(x[2], 4) + 3 * std::pow(x[3] - 11, 2) +
           10 * std::pow(x[4], 6) + 7 * x[5] * x[5] + std::pow(x[6], 4) - 4 * x[5] * x[6] - 10 * x[5] - 8 * x[6];
  };
  p.inequality = {4, [](Point x, Values c, Values j) {
                    c[0] = 2 * x[0] * x[0] + 3 * std::pow(x[1], 4) + x[2] + 4 * x[3] * x[3] + 5 * x[4] - 127;
                    c[1] = 7 * x[0] + 3 * x[1] + 10 * x[2] * x[2] + x[3] - x[4] - 282;
                    c[2] = 23 * x[0] + x[1] * x[1] + 6 * x[5] * x[5] - 8 * x[6] - 196;
                    c[3] = 4 * x[0] * x[0] + x[1] * x[1] - 3 * x[0] * x[1] + 2 * x[2] * x[2] + 5 * x[5] - 11 * x[6];
                    fill(j, {4 * x[0],
                             12 * std::pow(x[1], 3),
                             1,
                             8 * x[3],
                             5,
                             0,
                             0,  //
                             7,
                             3,
                             20 * x[2],
                             1,
                             -1,
                             0,
                             0,  //
                             23,
                             2 * x[1],
                             0,
                             0,
                             0,
                             12 * x[5],
                             -8,  //
                             8 * x[0] - 3 * x[1],
                             2 * x[1] - 3 * x[0],
                             4 * x[2],
                             0,
                             0,
                             5,
                             -11});
                  }};
  return {p, {1, 2, 0, 4, 0, 1, 1}, 680.630057374402, {}};
}

/// A convex quadratic function with tridiagonal matrix (1 + 2k, −k) under rows (1, −2, 1) · x ≤ d, every third one
/// active: made from its minimum x and its multipliers, so both are exact.
inline KnownProblem banded_quadratic(std::size_t n, double coupling = 4) {
  auto b = std::make_shared<std::vector<double>>(n), d = std::make_shared<std::vector<double>>(n - 2);
  std::vector<double> x(n);
  Random random(7);
  for (double& v : x) v = random.uniform(-1, 1);
  for (std::size_t j = 0; j < n; ++j)
    (*b)[j] = (1 + 2 * coupling) * x[j] - coupling * ((j > 0 ? x[j - 1] : 0) + (j + 1 < n ? x[j + 1] : 0));
  for (std::size_t i = 0; i + 2 < n; ++i) {
    (*d)[i] = x[i] - 2 * x[i + 1] + x[i + 2];
    if (i % 3 != 0) {
      (*d)[i] += random.uniform(0.01, 1);
      continue;
    }
    const double multiplier = random.uniform(0.1, 2);
    (*b)[i] += multiplier;
    (*b)[i + 1] -= 2 * multiplier;
    (*b)[i + 2] += multiplier;
  }
  OptimisationProblem p;
  p.dimension = n;
  p.objective = [b, n, coupling](Point at, Values g) {
    double sum = 0;
    for (std::size_t j = 0; j < n; ++j) {
      const double product =
          (1 + 2 * coupling) * at[j] - coupling * ((j > 0 ? at[j - 1] : 0) + (j + 1 < n ? at[j + 1] : 0));
      if (!g.empty()) g[j] = product - (*b)[j];
      sum += at[j] * (0.5 * product - (*b)[j]);
    }
    return sum;
  };
  p.inequality = {n - 2, [d, n](Point at, Values c, Values j) {
                    std::ranges::fill(j, 0);
                    for (std::size_t i = 0; i + 2 < n; ++i) {
                      c[i] = at[i] - 2 * at[i + 1] + at[i + 2] - (*d)[i];
                      if (j.empty()) continue;
                      j[i * n + i] = j[i * n + i + 2] = 1;
                      j[i * n + i + 1] = -2;
                    }
                  }};
  const double minimum = p.objective(x, {});
  return {p, std::vector<double>(n), minimum, x};
}

}  // namespace bahnwerk
