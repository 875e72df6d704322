#pragma once
/// Faà di Bruno's formula and its inverse as operations on truncated series: derivatives under a change of parameter.
///
/// The β of geometric continuity are β_i = f⁽ⁱ⁾ for the change of parameter f with which a link š becomes
/// parametrically continuous: s₁⁽ⁱ⁾ = (š ∘ f)⁽ⁱ⁾ at the joint [Herrmann (4.55), (4.56)]. The link š = s₁ ∘ f⁻¹ follows
/// from the reverted series of f; the source's F⁻¹ solves the same equations one after the other. Hence a larger β₁
/// makes the link leave its neighbour's tangent *sooner* (š′ = s₁′/β₁). The text beside (4.57) says the opposite; the β
/// that the source prints for its optimum have sensible sizes only in this form.
#include <array>
#include <cstddef>

#include "core/geometry/spline/bezier_piece.hpp"
#include "core/numeric/taylor.hpp"

namespace bahnwerk {

using Series = Taylor<spline_orders - 1>;
/// β₁ … β₄; those beyond the requested continuity are ignored.
using Betas = std::array<double, spline_orders - 1>;

/// Returns outer(inner(x)); the constant of `inner` has to be 0.
Series composed(const Series& outer, const Series& inner);
/// Returns g with f(g(x)) = x; the constant of f has to be 0, its slope not.
Series reverted(const Series& f);

/// Returns f⁻¹ of the change of parameter f with these derivatives.
Series inverse_change(const Betas& betas);
/// Returns the derivatives of s ∘ change from those of s.
SplineJet reparametrised(const SplineJet& jet, const Series& change);

/// Returns ∂š⁽ⁿ⁾/∂β_j, j = 1 … 4, of š = s ∘ f⁻¹. From f(f⁻¹(x)) = x follows ∂š/∂β_j = −(f⁻¹)ʲ/j! · š′.
SplineJet beta_derivative(const SplineJet& link, const Series& change, std::size_t j);

/// Returns the derivatives of a jet by the arc length of its first three coordinates; their first derivative must not
/// vanish.
SplineJet by_length(const SplineJet& jet);

}  // namespace bahnwerk
