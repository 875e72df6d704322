#pragma once
/// A law that exists, as the bounds need it: its values anywhere, its peaks and its J.
#include <array>
#include <vector>

#include "core/cam/cam_law.hpp"
#include "core/cam/optimal/program/spline_program.hpp"
#include "core/cam/optimal/task/law_task.hpp"

namespace bahnwerk::cam {

/// A law as node values: a start for the program and an upper bound of what its bound can be.
class KnownLaw {
 public:
  KnownLaw(const LawTask& task, const LawBasis& basis, const SplineResult& spline);
  /// `at`: the times of the law's points.
  KnownLaw(const LawTask& task, const CamLaw& law, const std::vector<double>& at, double objective);
  double objective() const { return objective_; }
  const std::vector<Range>& points() const { return points_; }  ///< times of its points, as ranges without width
  double peak(int order) const { return peaks_[static_cast<std::size_t>(order)]; }
  /// Returns s^(order) at t, task's units; `before`: the limit from the left.
  double value(double t, int order, bool before) const;

 private:
  struct Piece {
    double begin, length;
    std::vector<double> bernstein;
  };
  std::vector<Range> points_;
  double cycle_;
  bool periodic_;
  double travel_;
  double objective_;
  std::array<double, limited_orders> peaks_;
  std::vector<Piece> pieces_;
};

}  // namespace bahnwerk::cam
