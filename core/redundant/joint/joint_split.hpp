#pragma once
/// A head motion with the coarse axes that follow it: the chains' solutions per axis, and the motion assembled from
/// them.
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/motion/axes/motion.hpp"
#include "core/motion/axes/spline_motion.hpp"
#include "core/motion/law/path_motion.hpp"
#include "core/redundant/chain/chain_windows.hpp"
#include "core/redundant/head/head_cells.hpp"
#include "core/redundant/head/head_plan.hpp"
#include "core/redundant/joint/joint.hpp"

namespace bahnwerk {

/// Share of the summed limits that a head uses, so that rounding leaves the coarse axis some freedom. With limited jerk
/// accelerations are linear in a cell, which leaves the fine axis a little less than its limit.
template <std::size_t order>
inline constexpr double joint_head_share = order == 2 ? 1 - 1e-7 : 1 - 2e-3;

/// A head, slowed by a factor, and the coarse motion.
template <std::size_t order>
struct JointSplit {
  std::shared_ptr<const PathMotion> head;
  HeadCells cells;
  double stretch = 1;
  std::vector<WindowedSolution<order>> solutions;  ///< per axis that has a fine one
  std::vector<SplineMotion::Piece>
      closed;         ///< a closed form of all coarse axes, not slowed, used in place of solutions
  double slowed = 1;  ///< factor by which the solutions of a quicker motion were slowed to give this one

  /// Tells whether the coarse axes follow the head within all limits.
  bool valid() const;
};

/// Solves splits of one task: it holds the axes, options and units that all splits share.
template <std::size_t order>
class JointSplits {
 public:
  /// `task` must outlive this object. `cell` is the longest cell in units of √(stroke/coarse acceleration). `tick` is
  /// called often and may throw.
  JointSplits(const JointTask& task, double cell, std::function<void()> tick);

  /// Returns the indices of the axes that have a fine one.
  const std::vector<std::size_t>& axes() const { return axes_; }
  const CoarseFineAxis& axis(std::size_t k) const { return task_.machine.axes[k]; }
  /// Returns the options of the cells for a head with the given reserve.
  HeadCellOptions cells(const HeadReserve& reserve = {}) const;
  const ChainOptions& chain() const { return chain_options_; }
  /// Returns the Newton steps so far.
  std::size_t iterations() const { return iterations_; }

  /// Returns the look-ahead, s, of a window of axis k's chain (chain_windows.hpp).
  double ahead(std::size_t k) const;
  /// Doubles the look-ahead.
  void double_look_ahead() { ahead_ *= 2; }
  /// Solves the chain of each axis that has a fine one, for the head slowed by `stretch`; one result per entry of
  /// axes(). None if the head exceeds the sum of the limits in a cell.
  std::optional<std::vector<WindowedSolution<order>>> solve(const HeadCells& cells, double stretch);

  /// Returns the split's head, slowed by its factor.
  std::shared_ptr<const PathMotion> head_of(const JointSplit<order>& split) const;
  /// Returns the coarse motion; `head` is head_of(split).
  std::shared_ptr<const Motion> coarse_of(const JointSplit<order>& split, std::shared_ptr<const PathMotion> head) const;
  /// Returns the row of the table of trade-offs for a split.
  Trade trade(double stretch, const JointSplit<order>& split) const;
  /// Returns the sum of the coarse axes' energies ∫a², mm²/s³.
  double energy(const JointSplit<order>& split) const;

 private:
  std::vector<SplineMotion::Piece> pieces_of(const JointSplit<order>& split, double duration) const;

  const JointTask& task_;
  std::vector<std::size_t> axes_;
  HeadCellOptions cell_options_;
  ChainOptions chain_options_;
  double ahead_ = 1;
  std::size_t iterations_ = 0;
};

extern template struct JointSplit<2>;
extern template struct JointSplit<3>;
extern template class JointSplits<2>;
extern template class JointSplits<3>;

}  // namespace bahnwerk
