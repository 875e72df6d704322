#pragma once
/// A head with the coarse axes that follow it: solutions of all axes that have a fine one, and the motion made of them.
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "core/motion/axes/motion.hpp"
#include "core/motion/axes/spline_motion.hpp"
#include "core/motion/law/path_motion.hpp"
#include "core/redundant/chain_windows.hpp"
#include "core/redundant/head_cells.hpp"
#include "core/redundant/head_plan.hpp"
#include "core/redundant/joint.hpp"

namespace bahnwerk {

/// Part of the summed limits that a head uses, so that rounding leaves the coarse axis something. With jerk limited
/// accelerations are linear in a cell, which leaves the fine axis a little less than its limit.
template <std::size_t order>
inline constexpr double joint_head_share = order == 2 ? 1 - 1e-7 : 1 - 2e-3;

/// A head, stretched, and what the coarse axes do.
template <std::size_t order>
struct JointSplit {
  std::shared_ptr<const PathMotion> head;
  HeadCells cells;
  double stretch = 1;
  std::vector<WindowedSolution<order>> solutions;  ///< of each axis that is split
  std::vector<SplineMotion::Piece> closed;         ///< in place of solutions, of all axes; not stretched
  double slowed = 1;  ///< by which solutions of the motion were slowed that are those of a quicker one

  /// Whether the coarse axes follow.
  bool valid() const;
};

/// What splits of one task have in common.
template <std::size_t order>
class JointSplits {
 public:
  /// `task` outlives it. `cell`: the longest one, of √(stroke/coarse acceleration). `tick` is called now and then.
  JointSplits(const JointTask& task, double cell, std::function<void()> tick);

  /// The axes that have a fine one.
  const std::vector<std::size_t>& axes() const { return axes_; }
  const CoarseFineAxis& axis(std::size_t k) const { return task_.machine.axes[k]; }
  /// For a head that leaves the coarse axes that freedom.
  HeadCellOptions cells(const Freedom& freedom = {}) const;
  const ChainOptions& chain() const { return chain_options_; }
  /// Newton steps so far.
  std::size_t iterations() const { return iterations_; }

  /// s, what a window of the chain of an axis needs beyond what is kept.
  double ahead(std::size_t k) const;
  /// From now on twice that.
  void look_further() { ahead_ *= 2; }
  /// Of each axis that is split.
  std::vector<WindowedSolution<order>> solve(const HeadCells& cells, double stretch);

  std::shared_ptr<const PathMotion> head_of(const JointSplit<order>& split) const;
  /// What the coarse axes do; `head` is slowed already.
  std::shared_ptr<const Motion> coarse_of(const JointSplit<order>& split, std::shared_ptr<const PathMotion> head) const;
  Trade trade(double stretch, const JointSplit<order>& split) const;
  /// mm²/s³, of all coarse axes together.
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
