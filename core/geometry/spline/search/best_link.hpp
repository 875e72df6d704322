#pragma once
/// The β of a link that make it smoothest, in the sense of (4.60) or of its substitute (4.61) [Herrmann 4.3.4].
#include <optional>

#include "core/base/progress.hpp"
#include "core/geometry/spline/smoothness.hpp"
#include "core/numeric/optimise/optimise.hpp"

namespace bahnwerk {

/// The measure that is minimised: (4.60) or (4.61).
enum class LinkObjective { curvature, control_distance };

/// The result of the search.
struct BestLink {
  LinkShape shape;        ///< β by the parameters of the given ends
  double objective = 0;   ///< the minimised value, without the term that makes (4.61) unique
  double smoothness = 0;  ///< J of (4.60), also for other objectives
  std::size_t evaluations = 0;
};

/// What best_link() minimises, and where and for how long it searches.
struct BestLinkOptions {
  LinkObjective objective = LinkObjective::curvature;
  SmoothnessWeights weights;  ///< weights of J (4.60)
  /// A good shape for similar ends (the turn before); without one the search starts from links with the chord's length
  /// as speed. Weights are taken from it and constant.
  std::optional<LinkShape> start = std::nullopt;
  std::size_t max_evaluations = 2000;  ///< the search ends after so many; one takes about 6 µs for k = 3
};

/// Returns the end of a search for a local minimum by sequential quadratic programming with analytic gradients; never
/// worse than its start.
///
/// Variables and their bounds: link_variables.hpp. (4.61) has a set of minima: 1e-2·chord·J/J(start) is added, which
/// selects the smoothest of them. Throws what link() throws.
BestLink best_link(const SmoothnessRule& rule, const LinkEnds& ends, const BestLinkOptions& options, Progress progress);

}  // namespace bahnwerk
