#pragma once
/// All B-splines of a short clamped knot vector at once; for tables that are built once.
#include <cstddef>
#include <vector>

namespace bahnwerk {

/// Derivative of order `order` at u of every B-spline: the recursion of Cox and de Boor [Herrmann (3.46)] up to degree
/// − order, differences from there. At a knot the span to its right counts, at the end the last one. O(knots · degree).
std::vector<double> basis_row(const std::vector<double>& knots, std::size_t degree, std::size_t order, double u);

}  // namespace bahnwerk
