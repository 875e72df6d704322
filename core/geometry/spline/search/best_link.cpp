#include "core/geometry/spline/search/best_link.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace bahnwerk {
namespace {

constexpr double factorial[] = {1, 1, 2, 6, 24};
constexpr double bound[] = {0, 5, 20, 100, 500};
constexpr double slowest = 0.2, uniqueness = 1e-2;

Betas betas_of(const Series& change) {
  return {change.derivative(1), change.derivative(2), change.derivative(3), change.derivative(4)};
}

/// One end by arc length in units of the chord, and how its β there and by its own parameter belong together.
struct End {
  Series to_length;  ///< scaled arc length over the end's own parameter
  SplineJet jet;     ///< by scaled arc length

  End(const SplineJet& own, double chord) {
    Series square;
    for (std::size_t d = 0; d < 3; ++d) {
      const Series slope = Series::from(own[1][d], own[2][d], own[3][d], own[4][d]);
      square = square + slope * slope;
    }
    const Series speed = sqrt(square);
    for (std::size_t n = 1; n < spline_orders; ++n) to_length.c[n] = speed.c[n - 1] / (static_cast<double>(n) * chord);
    jet = reparametrised(own, reverted(to_length));
  }
  /// f by scaled length from f by the own parameter, and back.
  Betas scaled(const Betas& own) const {
    return betas_of(composed(Series::from(0, own[0], own[1], own[2], own[3]), reverted(to_length)));
  }
  Betas own(const Betas& scaled) const {
    return betas_of(composed(Series::from(0, scaled[0], scaled[1], scaled[2], scaled[3]), to_length));
  }
};

/// The variables γ of one end → β, and gradients by β → by γ: ∂f/∂γ_j = −fʲ/j! · f′ for f the inverse of what has the
/// derivatives γ.
struct Gamma {
  Series f;

  Gamma(std::span<const double> gamma) {
    Series g;
    for (std::size_t j = 0; j < gamma.size(); ++j) g.c[j + 1] = gamma[j] / factorial[j + 1];
    f = reverted(g);
  }
  void pull_back(std::span<const double> by_beta, std::span<double> by_gamma) const {
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
};

}  // namespace

BestLink best_link(const LinkBasis& basis, const SmoothnessRule& rule, const LinkEnds& ends, LinkObjective objective,
                   const SmoothnessWeights& weights, const std::optional<LinkShape>& start, Progress& progress,
                   std::size_t max_evaluations) {
  const std::size_t k = basis.continuity();
  const double chord = norm(place(ends.after[0]) - place(ends.before[0]));
  const End before(ends.before, chord), after(ends.after, chord);
  const LinkEnds scaled{before.jet, after.jet, ends.via};
  const bool distance = objective == LinkObjective::control_distance;

  std::vector<double> first(2 * k, 0.0);
  first[0] = first[k] = 1;
  if (start) {
    const Betas b[] = {before.scaled(start->before), after.scaled(start->after)};
    for (std::size_t e = 0; e < 2; ++e) {
      const Series g = inverse_change(b[e]);
      for (std::size_t j = 1; j <= k; ++j) first[e * k + j - 1] = g.derivative(j);
    }
  }
  const std::vector<double> held = start ? start->weights : std::vector<double>();
  const auto shape_of = [&](std::span<const double> x) {
    return LinkShape{betas_of(Gamma(x.first(k)).f), betas_of(Gamma(x.last(k)).f), held};
  };
  // Value and gradient of either measure by γ.
  const auto measured = [&](bool by_distance, std::span<const double> x, std::span<double> gradient) {
    std::array<double, 2 * (spline_orders - 1)> room{};
    const std::span<double> by_beta = std::span(room).first(gradient.size());
    const LinkShape shape = shape_of(x);
    const double f = by_distance ? control_distance(basis, scaled, shape, by_beta)
                                 : smoothness(basis, rule, scaled, shape, weights, by_beta);
    if (!gradient.empty()) {
      Gamma(x.first(k)).pull_back(by_beta.first(k), gradient.first(k));
      Gamma(x.last(k)).pull_back(by_beta.last(k), gradient.last(k));
    }
    return f;
  };

  OptimisationProblem problem;
  problem.dimension = 2 * k;
  for (std::size_t i = 0; i < 2 * k; ++i) {
    const std::size_t j = i % k + 1;
    problem.lower.push_back(j == 1 ? slowest : -bound[j]);
    problem.upper.push_back(bound[j]);
    problem.scale.push_back(factorial[j]);
    first[i] = std::clamp(first[i], problem.lower.back(), problem.upper.back());
  }
  const double at_start = std::max(measured(false, first, {}), 1e-9);
  problem.objective_scale = distance ? chord : at_start;
  problem.objective = [&](std::span<const double> x, std::span<double> gradient) {
    double f = measured(distance, x, gradient);
    if (distance) {
      const double share = uniqueness * chord / at_start;
      std::array<double, 2 * (spline_orders - 1)> room{};
      const std::span<double> more = std::span(room).first(gradient.size());
      f += share * measured(false, x, more);
      for (std::size_t i = 0; i < gradient.size(); ++i) gradient[i] += share * more[i];
    }
    return f;
  };
  OptimisationOptions options;
  options.max_evaluations = max_evaluations;
  const auto result = minimise(problem, first, options, progress);

  BestLink best;
  const bool better = !result.x.empty() && result.objective <= problem.objective(first, {});
  const std::vector<double>& x = better ? result.x : first;
  const LinkShape shape = shape_of(x);
  best.shape = {before.own(shape.before), after.own(shape.after), held};
  best.objective = measured(distance, x, {});
  best.smoothness = smoothness(basis, rule, scaled, shape, weights);
  best.status = result.status;
  best.kkt_residual = result.kkt_residual;
  best.evaluations = result.evaluations;
  return best;
}

}  // namespace bahnwerk
