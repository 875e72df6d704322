#pragma once
/// A lower bound of J over all laws, of whatever degree: a linear program over position, velocity and acceleration at
/// the nodes of a grid that every law satisfies.
///
/// In a cell of length h with |s‴| ≤ J₃ the moments ∫ (1 − τ)^k s‴ dτ, τ = t/h, are differences of node values, and for
/// every polynomial d of degree 2 |∫ d s‴| ≤ J₃ ∫ |d|: seven polynomials enclose the moments' convex body. Means and
/// node values of velocity and acceleration do not exceed their peaks. A point whose angle is in a range of width w is
/// relaxed at the middle of the range: its order-r value may be missed by w/2 times the peak of order r + 1. The bound
/// is the dual's value, computed from the multipliers, and holds whatever they are.
#include <array>
#include <cstddef>
#include <vector>

#include "core/cam/optimal/law_task.hpp"
#include "core/cam/optimal/spline_program.hpp"

namespace bahnwerk {
class Progress;
}
namespace bahnwerk::cam {

/// A law as node values: a start for the program and an upper bound of what its bound can be.
class KnownLaw {
 public:
  KnownLaw(const LawTask& task, const SectionBasis& basis, const SplineResult& spline);
  double objective() const { return objective_; }
  const std::vector<Range>& points() const { return points_; }  ///< times of its points, as ranges without width
  double peak(int order) const { return peaks_[static_cast<std::size_t>(order)]; }
  /// s^(order) at t, task's units; `before`: the limit from the left.
  double value(double t, int order, bool before) const;

 private:
  struct Piece {
    double begin, length;
    std::vector<double> bernstein;
  };
  std::vector<Range> points_;
  double cycle_;
  bool periodic_;
  double objective_;
  std::array<double, limited_orders> peaks_;
  std::vector<Piece> pieces_;
};

struct RelaxationOptions {
  std::size_t cells = 200;
  double gap = 1e-6;
};
/// No law with its points in `ranges` (one per point, task's units) has a smaller J; `law` need not be in the ranges.
double relaxation_bound(const LawTask& task, const std::vector<Range>& ranges, const KnownLaw& law,
                        const RelaxationOptions& options, Progress& progress);

struct AllLawsBound {
  double objective = 0;
  std::size_t programs = 0;  ///< solved
  bool complete = true;      ///< the boxes left do not matter at the asked gap
};
/// Over all angles in their ranges: branch and bound over boxes of angles, best first, at most `programs` of them;
/// stops where no box has a bound more than `gap` below the known law. Deterministic: it counts programs, not time.
AllLawsBound bound_over_angles(const LawTask& task, const KnownLaw& law, std::size_t programs, double gap,
                               Progress& progress);

}  // namespace bahnwerk::cam
