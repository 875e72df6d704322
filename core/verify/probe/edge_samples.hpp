#pragma once
/// The convex problem of an edge's bound: the least h for samples x that lie in their sets and whose divided
/// differences keep h^r L_r, with its constraints as slacks that are positive.
#include <array>
#include <cmath>
#include <vector>

#include "core/verify/probe/edge_bound.hpp"

namespace bahnwerk {

template <int D>
class EdgeSamples {
 public:
  using Point = std::array<double, D>;

  explicit EdgeSamples(const EdgeBoundProblem<D>& problem);

  std::size_t count() const { return problem_.grid.size(); }
  const EdgeBoundProblem<D>& problem() const { return problem_; }
  /// Returns samples along the edge, at which the search starts.
  std::vector<Point> start() const;
  /// Returns whether sample k is fixed, because its set is nearly a point.
  bool fixed(std::size_t k) const { return fixed_[k]; }
  double radius(std::size_t k) const { return radius_[k]; }  ///< radius of its set in the search, mm

  std::size_t rows(std::size_t r) const { return rows_[r - 1].size(); }  ///< differences of order r = 1 … 4
  const std::array<double, 5>& row(std::size_t r, std::size_t k) const { return rows_[r - 1][k]; }
  /// Returns whether some sample of difference k of order r is not fixed.
  bool free_row(std::size_t r, std::size_t k) const;
  /// Returns difference k of order r, times `power`.
  Point value(const std::vector<Point>& x, std::size_t r, std::size_t k, double power) const;
  /// Returns the vector from the segment of set k to x; sets `u`, the segment's direction, and `cap`: the nearest point
  /// is an end.
  Point offset(std::size_t k, const Point& x, bool& cap, Point& u) const;

  /// Returns the number of slacks: one per sample that is not fixed, one per free difference of first order, two per
  /// axis of the other free ones.
  std::size_t slacks() const { return slacks_; }
  std::size_t tube_slack(std::size_t k) const { return tube_slack_[k]; }
  std::size_t speed_slack(std::size_t k) const { return row_slack_[0][k]; }
  /// Returns the index of the slack of the upper limit; that of the lower limit is next.
  std::size_t axis_slack(std::size_t r, std::size_t k, int axis) const {
    return row_slack_[r - 1][k] + 2 * static_cast<std::size_t>(axis);
  }
  /// Returns the least h under which the differences of x keep their limits.
  double slowest(const std::vector<Point>& x) const;
  /// Computes the slacks; returns whether all are positive.
  bool evaluate(const std::vector<Point>& x, double h, std::vector<double>& slack) const;

 private:
  std::size_t sample_at(double g) const;

  const EdgeBoundProblem<D>& problem_;
  std::array<std::vector<std::array<double, 5>>, 4> rows_;
  std::vector<std::size_t> tube_slack_;                // per sample
  std::array<std::vector<std::size_t>, 4> row_slack_;  // per difference: its first one
  std::size_t slacks_ = 0;
  std::vector<char> fixed_;
  std::vector<double> radius_;
};

}  // namespace bahnwerk
