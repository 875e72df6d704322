#pragma once
/// The method of the source [Nolte 3]: the spline of all given values; then the range of the lowest order that is
/// violated the most becomes a value at its violated end, and the spline is solved again, until all ranges hold.
///
/// Balanced degrees may tie, and another order of conversions may end in a better law: both are tried as far as
/// ActiveSetOptions::sections goes, and the least J is taken.
#include <cstddef>
#include <vector>

#include "core/base/expected.hpp"
#include "core/base/progress.hpp"
#include "core/cam/solution.hpp"
#include "core/cam/spline/spline_system.hpp"

namespace bahnwerk::cam {

struct ActiveSetOptions {
  std::size_t distributions = 64;  ///< the most ties of degrees per set of conversions
  std::size_t sections = 1000;     ///< approximate effort once there is a law: linear systems times their sections
  bool source_order_only = false;  ///< tries the source's order of conversion alone, one distribution to the end
};

/// Returns the conditions of a problem with chosen angles: values, sections of classical laws, no ranges yet.
SplineTask spline_task(const MotionLawProblem& problem, const std::vector<double>& at);

/// Checks a problem at chosen angles; solves one linear system, ≈ 0.1 ms for 50 points. Throws InvalidInput, with
/// faults at the points: degrees that no distribution keeps to 21, sections without a condition, and systems that are
/// singular whatever the distribution.
void check_spline(const MotionLawProblem& problem, const std::vector<double>& at);

/// Why there is no law.
enum class NoLaw {
  ranges,  ///< no order of conversion ends with all ranges kept
  angles   ///< angles that may be chosen: none in their ranges has a law
};

/// `at`: one angle per point. Throws InvalidInput as check_spline() does, and where section limits do not hold: this
/// method does not know them.
Expected<LawSolution, NoLaw> solve_active_set(const MotionLawProblem& problem, const std::vector<double>& at,
                                              Progress progress, const ActiveSetOptions& options = {});

}  // namespace bahnwerk::cam
