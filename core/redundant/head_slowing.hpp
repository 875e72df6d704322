#pragma once
/// SectionLimits of a head that its coarse axes can follow, on stretches where they cannot.
///
/// Every stretch is solved by itself: section_limits fall round by round (slower_sections.hpp) until both axes have a
/// solution, then each pace of a straight move that fell rises again as far as it can while the others stay, to 0.7 %
/// of a speed.
#include <cstddef>
#include <functional>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/redundant/chain_solver.hpp"
#include "core/redundant/head_cells.hpp"
#include "core/redundant/head_plan.hpp"

namespace bahnwerk {

/// Sections of the path's segments [first, last).
struct HeadStretch {
  std::size_t first = 0, last = 0;
};

struct HeadSlowingCounts {
  std::size_t rounds = 0;     ///< most that a stretch took
  std::size_t certified = 0;  ///< clusters of cells proven to be too fast for the coarse axes
};

/// Cells times Newton steps, so that the same is given up on any machine.
struct SlowingWork {
  double done = 0, most = 1e300;
  bool spent() const { return done > most; }
};

template <std::size_t order>
class HeadSlowing {
 public:
  /// A section matters for `around` seconds before and behind it. All that is passed outlives it. `work` is
  /// what everything may take together.
  HeadSlowing(HeadPlan<order>& plan, const CoarseFineMachine& machine, const HeadCellOptions& cells, double around,
              int max_rounds, SlowingWork& work, ProgressScope& scope)
      : plan_(plan),
        machine_(machine),
        cell_options_(cells),
        around_(around),
        max_rounds_(max_rounds),
        all_work_(work),
        scope_(scope) {}

  /// Throws Infeasible where nothing helped, the stretch would last ten times as long, or took more work than it
  /// is worth. False: nothing had to be slowed.
  bool run(const HeadStretch& stretch, HeadSlowingCounts& counts);

 private:
  struct Problem {
    std::shared_ptr<const PathMotion> head;
    HeadCells cells;
    std::vector<std::size_t> axes;  // that have a fine one
    std::vector<Chain<order>> chains;
  };
  Problem problem(const HeadStretch& stretch);
  bool slow_once(const HeadStretch& stretch, std::size_t round, HeadSlowingCounts& counts);
  bool followed(const HeadStretch& stretch);
  HeadStretch neighbourhood(const HeadStretch& stretch, std::size_t segment);
  void raise(const HeadStretch& stretch);
  void worked(std::size_t steps, std::size_t cells) {
    work_ += steps * cells;
    all_work_.done += static_cast<double>(steps * cells);
  }

  HeadPlan<order>& plan_;
  const CoarseFineMachine& machine_;
  const HeadCellOptions& cell_options_;
  double around_;
  int max_rounds_;
  SlowingWork& all_work_;
  ProgressScope& scope_;
  std::size_t work_ = 0;  // cells times Newton steps, for the stretch at hand
};

extern template class HeadSlowing<2>;
extern template class HeadSlowing<3>;

}  // namespace bahnwerk
