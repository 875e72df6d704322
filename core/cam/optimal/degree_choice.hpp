#pragma once
/// The degree and the pieces of `optimal`: those that the problem names, or the smallest degree, and for it the fewest
/// pieces, within 1 % of the bound over all laws.
#include <functional>
#include <string>
#include <vector>

#include "core/cam/optimal/program/spline_program.hpp"
#include "core/cam/optimal/task/law_task.hpp"

namespace bahnwerk::cam {

struct DegreeChoice {
  int degree = 0, pieces = 1;
  SplineResult spline;  ///< angles and coefficients
  double bound = 0;     ///< lower bound of J over all laws
  std::string basis;    ///< method that proves the bound, for people
  int programs = 0;     ///< number of programs solved
  std::vector<std::string> notes;
};

/// Returns J of the law that is published for a spline: rounding of its positions may raise it above the spline's own.
using PublishedObjective = std::function<double(const LawBasis& basis, const SplineResult& spline)>;

/// Throws InvalidInput where no law exists. With a given degree and fixed angles no number of pieces that divides the
/// given one has a law whose published J is less by more than 1e-9: the choice has the fewer pieces, else.
DegreeChoice choose_degree(const MotionLawProblem& problem, const LawTask& task,
                           const PublishedObjective& published_objective, Progress progress);

class KnownLaw;
/// Raises the bound over all laws, where it can, and sets what it is made of; counts its programs. `finely`: with three
/// times the cells, for fixed angles.
void bound_law(const LawTask& task, const KnownLaw& law, DegreeChoice& choice, Progress progress, bool finely = false);

/// Returns the smallest degree that method `optimal` takes: one more than any continuity, 3 at least, 21 at most.
int least_degree(const LawTask& task);

}  // namespace bahnwerk::cam
