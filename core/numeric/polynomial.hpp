#pragma once
/// Dense polynomials in the power basis, for construction; inner loops have their own fixed layouts.
#include <cstddef>
#include <vector>

namespace bahnwerk {

/// The coefficients, lowest first; an empty polynomial is zero.
using Polynomial = std::vector<double>;

/// Returns p(x) by Horner's scheme. O(degree).
double evaluate(const Polynomial& p, double x);
Polynomial derivative(const Polynomial& p);
Polynomial operator+(const Polynomial& p, const Polynomial& q);
Polynomial operator-(const Polynomial& p, const Polynomial& q);
Polynomial operator*(const Polynomial& p, const Polynomial& q);
Polynomial operator*(double k, Polynomial p);
/// Returns q(y) = p(at + scale·y) by synthetic division, O(degree²).
Polynomial shifted(Polynomial p, double at, double scale);
/// Returns p(x)/x^k without the k lowest coefficients.
Polynomial deflated(const Polynomial& p, std::size_t k);
/// Returns the power basis over t ∈ [−1, 1] of Σ b_i B_{i,n}((1 + t)/2) (Bernstein). O(n³), by convex combinations and
/// differences only.
Polynomial from_bernstein(const std::vector<double>& b);

}  // namespace bahnwerk
