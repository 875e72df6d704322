#pragma once
/// The β of a link that make it smoothest, in the sense of (4.60) or of its substitute (4.61) [Herrmann 4.3.4].
#include <optional>

#include "core/geometry/spline/smoothness.hpp"
#include "core/numeric/optimise/optimise.hpp"

namespace bahnwerk {

class Progress;

enum class LinkObjective { curvature, control_distance };

struct BestLink {
  LinkShape shape;          ///< β by the parameters of the ends as given
  double objective = 0;     ///< what was minimised, without the term that makes (4.61) unique
  double smoothness = 0;    ///< J of (4.60), whatever was minimised
  double kkt_residual = 0;  ///< of the search; see OptimisationResult
  OptimisationStatus status = OptimisationStatus::undefined;
  std::size_t evaluations = 0;
};

/// A local minimum, by sequential quadratic programming with analytic gradients; never worse than its start. `start`:
/// a shape that was good for similar ends (the turn before); none: links of the chord's length as speed. Weights are
/// taken from there and held.
///
/// Its variables and their bounds: link_variables.hpp.
/// (4.61) has a minimum on a set of β: 1e-2·chord·J/J(start) is added, which takes the smoothest of them.
/// Throws what link() throws. Ends after max_evaluations, of about 6 µs each for k = 3.
BestLink best_link(const SmoothnessRule& rule, const LinkEnds& ends, LinkObjective objective,
                   const SmoothnessWeights& weights, const std::optional<LinkShape>& start, Progress& progress,
                   std::size_t max_evaluations = 2000);

}  // namespace bahnwerk
