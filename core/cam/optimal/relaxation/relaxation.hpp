#pragma once
/// A linear program over position, velocity and acceleration at the nodes of a grid that every law satisfies.
///
/// In a cell of length h with |s‴| ≤ J₃ the moments ∫ (1 − τ)^k s‴ dτ, τ = t/h, are differences of node values, and for
/// every polynomial d of degree 2 |∫ d s‴| ≤ J₃ ∫ |d|: seven polynomials enclose the moments' convex body. Means and
/// node values of velocity and acceleration do not exceed their peaks. A point whose angle is in a range of width w is
/// relaxed at the middle of the range: its order-r value may be missed by w/2 times the peak of order r + 1, or by w/2
/// times what that derivative can become between here and a point where it is a number. The bound
/// is the dual's value, computed from the multipliers, and holds whatever they are.
#include <cstddef>
#include <vector>

#include "core/base/progress.hpp"
#include "core/cam/optimal/relaxation/known_law.hpp"
#include "core/cam/optimal/task/law_task.hpp"

namespace bahnwerk::cam {

struct RelaxationOptions {
  std::size_t cells = 200;
  double gap = 1e-6;
};
/// Returns a lower bound: no law with its points in `ranges` (one per point, task's units) has a smaller J; `law` need
/// not be in the ranges.
double relaxation_bound(const LawTask& task, const std::vector<Range>& ranges, const KnownLaw& law,
                        const RelaxationOptions& options, Progress progress);

}  // namespace bahnwerk::cam
