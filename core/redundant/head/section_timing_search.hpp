#pragma once
/// Local search that makes the sections of a head quicker while the coarse axes can still follow: one section after the
/// other gets the shortest duration that is feasible while the others keep their limits.
///
/// The states that the coarse axes can reach before a section, and those from which they can complete the motion behind
/// it, are convex sets (controllable_set.hpp) that do not depend on the section's own limits. Feasibility of new limits
/// is therefore decided by the cells of that section alone. For a straight move the search varies acceleration,
/// braking and feed (straight_move.hpp); for other sections one feed for the whole section, the
/// accelerations, and the feeds of its segments. Afterwards pairs are exchanged: one section is made quicker (another
/// one as fast as possible, a straight move by small changes of its limits at one or both ends), and a straight move
/// nearby becomes slower to keep the motion feasible. A change is kept if the total duration falls.
#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/redundant/chain/chain.hpp"
#include "core/redundant/chain/controllable_set.hpp"
#include "core/redundant/coarse_fine.hpp"
#include "core/redundant/head/head_cells.hpp"
#include "core/redundant/head/head_plan.hpp"

namespace bahnwerk {

class SectionTimingSearch {
 public:
  /// Prepares the search over the sections in the path's segments [first, last). All references must outlive this
  /// object.
  SectionTimingSearch(HeadPlan<2>& plan, const CoarseFineMachine& machine, const HeadCellOptions& cells,
                      ProgressScope& scope, std::size_t first, std::size_t last);

  /// Raises section limits of the plan where a quicker feasible motion is found. Returns false if the given limits are
  /// infeasible with the small margin that the search needs. Cost: about 0.2 ms per candidate, 20 to 60 candidates per
  /// slowed section.
  bool run();

 private:
  struct Timed {
    std::size_t first = 0, last = 0;  // segments
    double duration = 0;
    std::vector<Chain<2>> chains;  // per axis that has a fine one; empty if the head exceeds both axes' limits
  };
  struct Speeds {  // limits of a section
    Pace pace;
    bool slowed = false;
    std::vector<double> feeds;
    double share = 1;  // share of the accelerations
  };

  Timed timed(std::size_t first, std::size_t last);
  bool set_room(double room);
  /// Computes the reachable sets behind, and the controllable sets before, the sections [from, to).
  void carry_forward(std::size_t from, std::size_t to);
  void carry_backward(std::size_t from, std::size_t to);
  bool possible(std::size_t section, const Timed& timed) const;

  SectionLimits::Straight* straight(std::size_t section);
  Speeds speeds(std::size_t section);
  void restore(std::size_t section, const Speeds& speeds);
  bool slowed(std::size_t section);

  /// Searches the limits of a straight move with the least duration below `limit`, s, and stores them in the plan if
  /// there are any.
  bool quickest_move(std::size_t section, double limit);
  /// Searches the feeds of the segments and the common share of accelerations of a section that is no straight move.
  bool quicker_cut(std::size_t section);
  bool sweep();
  /// Searches limits of straight move `move` that make the motion feasible again after the limits of `section` were
  /// changed from `before`, and restores those if there are none.
  bool exchange(std::size_t section, const Speeds& before, std::size_t move);
  bool exchange_cut(std::size_t section, std::size_t move);
  bool exchange_moves(std::size_t section, std::size_t move, bool slowed, bool other_slowed);
  bool exchanges();
  double total() const;

  HeadPlan<2>& plan_;
  const CoarseFineMachine& machine_;
  const HeadCellOptions& cell_options_;
  ProgressScope& scope_;
  std::size_t first_, last_;
  std::vector<std::size_t> split_;  // indices of the axes that have a fine one
  double room_ = 0;                 // margin by which boxes are reduced
  std::vector<Timed> sections_;
  std::vector<std::vector<ControllableSet>> forward_, backward_;  // [border of sections][axis]
};

}  // namespace bahnwerk
