#include "core/geometry/spline/search/link_variables.hpp"

#include <algorithm>

namespace bahnwerk {
namespace {

Betas betas_of(const Series& change) {
  return {change.derivative(1), change.derivative(2), change.derivative(3), change.derivative(4)};
}
Series change_of(const Betas& betas) { return Series::from(0, betas[0], betas[1], betas[2], betas[3]); }

/// Returns the f whose inverse has these derivatives.
Series change_of(std::span<const double> gamma) {
  Series inverse;
  for (std::size_t j = 1; j <= gamma.size(); ++j) inverse.c[j] = gamma[j - 1] / LinkVariables::scale(j);
  return reverted(inverse);
}

/// Arc length over the parameter, in units of the chord.
Series length(const SplineJet& own, double chord) {
  Series square;
  for (std::size_t d = 0; d < 3; ++d) {
    const Series slope = Series::from(own[1][d], own[2][d], own[3][d], own[4][d]);
    square = square + slope * slope;
  }
  const Series speed = sqrt(square);
  Series length;
  for (std::size_t n = 1; n < spline_orders; ++n) length.c[n] = speed.c[n - 1] / (static_cast<double>(n) * chord);
  return length;
}

/// ∂f/∂γ_j = −fʲ/j! · f′ for f the inverse of what has the derivatives γ.
void pull_back(const Series& f, std::span<const double> by_beta, std::span<double> by_gamma) {
  Series slope;
  for (std::size_t n = 0; n + 1 < spline_orders; ++n) slope.c[n] = static_cast<double>(n + 1) * f.c[n + 1];
  Series power = -1;
  for (std::size_t j = 1; j <= by_gamma.size(); ++j) {
    power = power * f / static_cast<double>(j);
    const Series moved = power * slope;
    by_gamma[j - 1] = 0;
    for (std::size_t i = 1; i <= by_beta.size(); ++i) by_gamma[j - 1] += by_beta[i - 1] * moved.derivative(i);
  }
}

}  // namespace

LinkVariables::LinkVariables(std::size_t continuity, const LinkEnds& ends)
    : continuity_(continuity),
      chord_(norm(place(ends.after[0]) - place(ends.before[0]))),
      to_length_{length(ends.before, chord_), length(ends.after, chord_)},
      scaled_{reparametrised(ends.before, reverted(to_length_[0])),
              reparametrised(ends.after, reverted(to_length_[1]))} {}

std::vector<double> LinkVariables::straight() const {
  std::vector<double> gamma(size(), 0.0);
  gamma[0] = gamma[continuity_] = 1;
  return gamma;
}

std::vector<double> LinkVariables::of(const LinkShape& own) const {
  std::vector<double> gamma(size());
  for (std::size_t e = 0; e < 2; ++e) {
    const Series f = composed(change_of(e == 0 ? own.before : own.after), reverted(to_length_[e])), g = reverted(f);
    for (std::size_t j = 1; j <= continuity_; ++j)
      gamma[e * continuity_ + j - 1] = std::clamp(g.derivative(j), lower(j), upper(j));
  }
  return gamma;
}

LinkShape LinkVariables::scaled(std::span<const double> gamma) const {
  return {betas_of(change_of(gamma.first(continuity_))), betas_of(change_of(gamma.last(continuity_))), {}};
}

LinkShape LinkVariables::own(std::span<const double> gamma) const {
  return {betas_of(composed(change_of(gamma.first(continuity_)), to_length_[0])),
          betas_of(composed(change_of(gamma.last(continuity_)), to_length_[1])),
          {}};
}

void LinkVariables::pull_back(std::span<const double> gamma, std::span<const double> by_beta,
                              std::span<double> by_gamma) const {
  const std::size_t k = continuity_;
  bahnwerk::pull_back(change_of(gamma.first(k)), by_beta.first(k), by_gamma.first(k));
  bahnwerk::pull_back(change_of(gamma.last(k)), by_beta.last(k), by_gamma.last(k));
}

}  // namespace bahnwerk
