#pragma once
/// Method `optimal`: the least J of all splines of one degree and as many pieces per section, under the same values,
/// ranges, continuity and section limits as `active_set`, with a proof. See spline_program.hpp for fixed angles,
/// free_angles.hpp for angles in ranges, law_bound.hpp for the bound over all laws.
///
/// Cost, one core: 5 sections of degree 9 some 5 ms and as much for the bound; 50 points below 0.4 s.
#include "core/cam/solution.hpp"

namespace bahnwerk {
class Progress;
}
namespace bahnwerk::cam {

struct OptimalLaw {
  LawSolution solution;  ///< with `lower` (this degree, pieces and angles) and `bound` (all laws, all angles)
  int degree = 0, pieces = 0;
  bool proven = true;  ///< objective and lower agree to 1e-7
};

/// Throws InvalidInput naming the point or section where values contradict each other, where a limit cannot hold, or
/// where a section has a classical law that is not straight.
OptimalLaw plan_optimal_law(const MotionLawProblem& problem, Progress& progress);

}  // namespace bahnwerk::cam
