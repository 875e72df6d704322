#pragma once
/// Method `optimal`: the least J of all splines of one degree and as many pieces per section, under the same values,
/// ranges, continuity and section limits as `active_set`, with a proof. See spline_program.hpp for fixed angles,
/// free_angles.hpp for angles in ranges, law_bound.hpp for the bound over all laws.
///
/// Cost, one core: 5 sections of degree 9 some 5 ms and as much for the bound; 50 points below 0.4 s.
#include "core/base/progress.hpp"
#include "core/cam/solution.hpp"

namespace bahnwerk::cam {

struct OptimalLaw {
  LawSolution solution;  ///< `lower` holds for this degree, pieces and angles, `bound` for all laws and angles
  int degree = 0, pieces = 0;
  bool proven = true;  ///< objective and lower agree to 1e-7
};

/// Sections that name a classical law have this law (given_sections.hpp, straight_sections.hpp); bounds are then over
/// the laws that contain it. Throws InvalidInput naming the point or section where values contradict each other, where
/// a limit cannot hold, or where a classical law does not fit.
///
/// `candidate`: a law of the same problem from another method, none or one that keeps all of it. It is taken where its
/// J is smaller and it is one of the splines of the chosen degree, so that `optimal` is never worse by rounding.
OptimalLaw plan_optimal_law(const MotionLawProblem& problem, Progress progress, const LawSolution* candidate = nullptr);

}  // namespace bahnwerk::cam
