#pragma once
/// Quicker section_limits for a stretch that the coarse axes can follow: one section after the other gets the quickest
/// that it can have while the others stay.
///
/// What the coarse axes can do before and behind a section are convex sets of states (controllable_set.hpp) that do
/// not change with its pace, so that the cells of that section alone tell whether a pace
/// can be followed. A straight move is searched
/// over its acceleration, its braking, its feed and what is between them, other sections over a feed for all of it, the
/// accelerations, and feeds of its segments. Then pairs: a section that is not a move becomes as quick as ever, or a
/// move a little slower or quicker, in all or at one end, and another move near it makes up for that; what takes less
/// time in all stays.
#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/redundant/chain.hpp"
#include "core/redundant/coarse_fine.hpp"
#include "core/redundant/controllable_set.hpp"
#include "core/redundant/head_cells.hpp"
#include "core/redundant/head_plan.hpp"

namespace bahnwerk {

class SectionTimingSearch {
 public:
  /// Searches the sections in the path's segments [first, last).
  SectionTimingSearch(HeadPlan<2>& plan, const CoarseFineMachine& machine, const HeadCellOptions& cells,
                      ProgressScope& scope, std::size_t first, std::size_t last);

  /// Makes limits of the plan's sections quicker where that is found. False: the limits given cannot be followed
  /// with the little room that the search leaves. Some 0.2 ms per pace that is looked at, 20 to 60 of them per slowed
  /// section.
  bool run();

 private:
  struct Timed {
    std::size_t first = 0, last = 0;  // segments
    double duration = 0;
    std::vector<Chain<2>> chains;  // per axis that has a fine one
  };
  struct Speeds {  // what a section may do at most
    Pace pace;
    bool slowed = false;
    std::vector<double> feeds;
    double share = 1;  // of the accelerations
  };

  Timed timed(std::size_t first, std::size_t last);
  bool set_room(double room);
  /// States behind sections [from, to), and before them.
  void carry_forward(std::size_t from, std::size_t to);
  void carry_backward(std::size_t from, std::size_t to);
  bool possible(std::size_t section, const Timed& timed) const;

  SectionLimits::Straight* straight(std::size_t section);
  Speeds speeds(std::size_t section);
  void restore(std::size_t section, const Speeds& speeds);
  bool slowed(std::size_t section);

  /// Finds the pace of a straight move with the least duration below `limit`, s; the plan keeps it if there is one.
  /// `sloped`: whether other slopes than that of its pace are looked at.
  bool quickest_move(std::size_t section, double limit, bool sloped);
  /// Searches a section that is no straight move over feeds of its segments and one share of its accelerations.
  bool quicker_cut(std::size_t section);
  bool sweep();
  /// Searches a move that makes up for a section whose limits were changed from `before`; where there is none they are
  /// restored.
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
  std::vector<std::size_t> split_;  // axes that have a fine one
  double room_ = 0;                 // that boxes are smaller by
  std::vector<Timed> sections_;
  std::vector<std::vector<ControllableSet>> forward_, backward_;  // [section, and behind the last][axis]
};

}  // namespace bahnwerk
