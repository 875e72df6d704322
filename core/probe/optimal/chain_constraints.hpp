#pragma once
/// The constraints of a chain of cells as slacks that are positive where they hold: Bézier points of the position lie
/// in their edge's capsule, those of the velocity have norm ≤ speed, those of acceleration, jerk and snap keep the
/// limits of their axis, points are passed within their balls, no cell is shorter than a given duration.
#include <cmath>
#include <vector>

#include "core/probe/optimal/cell_rows.hpp"
#include "core/probe/optimal/chain.hpp"

namespace bahnwerk {

/// Slacks, multipliers, or changes of slacks: cell_slacks<D> per cell, and one per node for its ball.
template <int D>
struct ChainSlacks {
  using Cell = std::array<double, cell_slacks<D>>;
  static constexpr double unlimited_slack = 1e300;  ///< marks the slack of a constraint that does not exist

  explicit ChainSlacks(std::size_t cells, double ball_value = 0) : cell(cells), ball(cells + 1, ball_value) {}
  std::vector<Cell> cell;
  std::vector<double> ball;
};

template <int D>
class ChainConstraints {
 public:
  using Slacks = ChainSlacks<D>;
  static constexpr double no_limit = Slacks::unlimited_slack;

  /// `shortest` is the least duration of a cell, s; 0: unlimited.
  ChainConstraints(const ChainLimits<D>& limits, double shortest) : limits_(limits), shortest_(shortest) {
    for (std::size_t e = 0; e + 1 < limits.points.size(); ++e)
      capsule_.push_back(capsule<D>(limits.points[e], limits.points[e + 1], limits.radius(e)));
  }

  double ball_radius(const ChainNode<D>& node) const { return limits_.ball[static_cast<std::size_t>(node.point)]; }
  /// Returns the coordinate of the node relative to the point that it passes, mm.
  double from_point(const ChainNode<D>& node, int axis) const {
    return node.state[0][axis] - limits_.points[static_cast<std::size_t>(node.point)][axis];
  }
  /// Returns whether derivative p of the node's state is given, so that it is no unknown.
  bool component_given(const ChainNode<D>& node, int p) const {
    return node.given || (p == 0 && node.point >= 0 && ball_radius(node) <= 0) || (p == 1 && node.still);
  }
  double derivative_limit(std::size_t row, int axis) const {
    return limits_.derivative[static_cast<std::size_t>(cell_basis().order[row] - 2)][axis];
  }

  /// Computes the slacks; returns whether all are positive, otherwise `out` is incomplete. Entries of nodes without a
  /// ball stay as they are.
  bool slacks(const CellChain<D>& chain, Slacks& out) const;
  /// Returns Σ ln g over the slacks g.
  static double logarithms(const Slacks& slack);
  /// Returns the number of constraints that exist.
  static double count(const Slacks& slack) {
    double sum = 0;
    for (const auto& cell : slack.cell)
      for (double g : cell) sum += g < no_limit;
    for (double g : slack.ball) sum += g < no_limit;
    return sum;
  }

  bool tube_row(const CellChain<D>& chain, std::size_t c, std::size_t r) const {
    if (limits_.tolerance <= 0) return false;
    if (r == 0) return !component_given(chain.node[c], 0);
    if (r == 16) return !component_given(chain.node[c + 1], 0);
    return true;
  }

  /// Calls visit(index of the slack, its gradient with respect to q, `round`, u) for row r < 30, tube or speed, of
  /// value q, if that constraint exists. The slack's Hessian is −round · (1 − u uᵀ); u = null stands for 0.
  template <typename Visit>
  void curved(const CellChain<D>& chain, std::size_t c, std::size_t r, const double* q, Visit&& visit) const {
    std::array<double, D> g{};
    if (r < 17) {
      if (!tube_row(chain, c, r)) return;
      bool cap;
      const Capsule<D>& set = capsule_[chain.cell[c].edge];
      const std::array<double, D> d = offset(set, q, cap);
      for (int k = 0; k < D; ++k) g[k] = -2 * d[k] / set.radius2;
      visit(r, g, 2 / set.radius2, cap ? nullptr : set.u.data());
    } else if (r < 30) {
      const double v2 = limits_.speed * limits_.speed;
      for (int k = 0; k < D; ++k) g[k] = -2 * q[k] / v2;
      visit(r, g, 2 / v2, nullptr);
    }
  }

 private:
  bool slacks_of_cell(const CellChain<D>& chain, std::size_t c, const CellValues<D>& v,
                      typename Slacks::Cell& out) const;

  const ChainLimits<D>& limits_;
  double shortest_;
  std::vector<Capsule<D>> capsule_;
};

}  // namespace bahnwerk
