#pragma once
/// Dense polynomials in the power basis, for building things; inner loops keep their own fixed layouts.
#include <cstddef>
#include <vector>

namespace bahnwerk {

/// Coefficients, lowest first; the empty one is zero.
using Polynomial = std::vector<double>;

/// Horner, O(degree).
double evaluate(const Polynomial& p, double x);
Polynomial derivative(const Polynomial& p);
Polynomial operator+(const Polynomial& p, const Polynomial& q);
Polynomial operator-(const Polynomial& p, const Polynomial& q);
Polynomial operator*(const Polynomial& p, const Polynomial& q);
Polynomial operator*(double k, Polynomial p);
/// q(y) = p(at + scale·y): synthetic division, O(degree²).
Polynomial shifted(Polynomial p, double at, double scale);
/// p(x)/x^k without the k lowest coefficients.
Polynomial deflated(const Polynomial& p, std::size_t k);
/// The power basis over t ∈ [−1, 1] of Σ b_i B_{i,n}((1 + t)/2) (Bernstein). O(n³), convex combinations and differences
/// only.
Polynomial from_bernstein(const std::vector<double>& b);

}  // namespace bahnwerk
