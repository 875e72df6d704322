#pragma once
/// Lowers the section limits of a head on ranges of sections in which the coarse axes cannot follow it, until they can.
///
/// Each range is solved separately: section limits fall in rounds (slower_sections.hpp) until the chains of all axes
/// are feasible. Then the speed limit of each straight move that was lowered is raised again as far as the other limits
/// permit, to 0.7 % of a speed.
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/redundant/chain/chain_solver.hpp"
#include "core/redundant/head/head_cells.hpp"
#include "core/redundant/head/head_plan.hpp"
#include "core/redundant/no_plan.hpp"

namespace bahnwerk {

struct HeadSlowingCounts {
  std::size_t rounds = 0;     ///< most rounds that one range took
  std::size_t certified = 0;  ///< intervals of cells with a certificate that the coarse axes cannot follow
};

/// A budget of work, counted in cells times Newton steps, so that the result is the same on every machine.
struct SlowingWork {
  double done = 0, most = 1e300;
  bool spent() const { return done > most; }
};

struct HeadSlowingOptions {
  HeadCellOptions cells;
  double around = 0;   ///< time before and behind a section over which it influences the coarse axes, s
  int max_rounds = 0;  ///< largest number of rounds per range
};

template <std::size_t order>
class HeadSlowing {
 public:
  /// `work` limits the work of all ranges together. All references must outlive this object.
  HeadSlowing(HeadPlan<order>& plan, const CoarseFineMachine& machine, HeadSlowingOptions options, SlowingWork& work,
              ProgressScope& scope)
      : plan_(plan), machine_(machine), options_(std::move(options)), all_work_(work), scope_(scope) {}

  /// Makes the sections in `range`, whole sections, feasible and adds to `counts`. Returns whether anything had to be
  /// slowed, or why no lower limits were found: none helps, the duration would grow tenfold, or the budget is spent.
  Expected<bool, NoPlan> run(const SegmentRange& range, HeadSlowingCounts& counts);

 private:
  struct Problem {
    std::shared_ptr<const PathMotion> head;
    HeadCells cells;
    std::vector<std::size_t> axes;  // indices of the axes with a fine axis
    std::vector<Chain<order>> chains;
  };
  Expected<Problem, NoPlan> problem(const SegmentRange& range);
  Expected<bool, NoPlan> slow_once(const SegmentRange& range, std::size_t round, HeadSlowingCounts& counts);
  bool followed(const SegmentRange& range);
  SegmentRange neighbourhood(const SegmentRange& range, std::size_t segment);
  void raise(const SegmentRange& range);
  void worked(std::size_t steps, std::size_t cells) {
    work_ += steps * cells;
    all_work_.done += static_cast<double>(steps * cells);
  }

  HeadPlan<order>& plan_;
  const CoarseFineMachine& machine_;
  const HeadSlowingOptions options_;
  SlowingWork& all_work_;
  ProgressScope& scope_;
  std::size_t work_ = 0;  // work spent on the current range
};

extern template class HeadSlowing<2>;
extern template class HeadSlowing<3>;

}  // namespace bahnwerk
