#pragma once
/// The largest constant speed at each place of a path, and the largest change of speed there.
///
/// At constant speed v axis k has velocity q′v, acceleration q″v² and jerk q‴v³. So the largest constant speed at a
/// place is the least of V/|q′|, √(A/|q″|), ∛(J/|q‴|) over all axes, of the feed of the segment and of the limit along
/// the path. A joint at which q′ or q″ jumps by Δ requires |Δ| v ≤ A T, |Δ| v² ≤ J T over a cycle T.
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/motion/grid/sections.hpp"

namespace bahnwerk {

/// The limit that determines the largest feed, and its place.
struct FeedLimit {
  enum class Kind { velocity, acceleration, jerk, velocity_step, acceleration_step, path_velocity, segment_feed };
  double speed = unlimited;  ///< largest constant speed, mm/s
  Kind kind = Kind::path_velocity;
  std::size_t axis = 0;     ///< index of the axis, if the limit is an axis'
  double s = 0;             ///< place, mm along the path
  std::size_t segment = 0;  ///< path segment that contains s
};
/// Returns a name such as "the jerk limit of q5".
std::string in_words(const FeedLimit& limit, const Machine& machine);

/// A node of the grid. A joint has two nodes, with the derivatives before and behind it.
struct FeedNode {
  double s = 0;
  const double *d1 = nullptr, *d2 = nullptr, *d3 = nullptr;  ///< q′, q″, q‴ of each axis
};

/// Speed, acceleration and jerk of the tool at a place.
struct FeedState {
  double v = 0, a = 0, j = 0;
};

/// The options of a FeedGrid.
struct FeedGridOptions {
  std::size_t nodes = 16;                                    ///< nodes per panel of the path
  int order = 3;                                             ///< highest derivative of the axes that is limited: 2 or 3
  double corner_angle = 0.1 * 3.14159265358979323846 / 180;  ///< rad
  Limits along;                                              ///< limits along the tool's path
};

/// Nodes along a path with the largest constant speed at each. `task` has to outlive the object. O(nodes), about 1 µs
/// each through a machine's kinematics; 8 (3 axes + 1) bytes each.
class FeedGrid {
 public:
  FeedGrid(const PathTask& task, const FeedGridOptions& options, ProgressScope& progress);

  const PathTask& task() const { return task_; }
  const FeedGridOptions& options() const { return options_; }
  const Sections& sections() const { return sections_; }
  /// Returns the largest constant speed over a whole segment, its joints included: at the nodes, and at the slowest
  /// place around every node that is slower than its neighbours, to 1e-9.
  const FeedLimit& hold(std::size_t segment) const { return hold_[segment]; }
  /// Returns the largest constant speed over a part of a segment, mm/s, with `share` of the axes' speed.
  double hold_between(std::size_t segment, double s0, double s1, double share = 1) const;

  std::size_t size() const { return s_.size(); }
  double s(std::size_t node) const { return s_[node]; }
  FeedNode node(std::size_t i) const {
    const double* row = rows_.data() + 3 * axes_ * i;
    return {s_[i], row, row + axes_, row + 2 * axes_};
  }
  /// The nodes of a segment are [first, last).
  std::size_t first(std::size_t segment) const { return first_[segment]; }
  std::size_t last(std::size_t segment) const { return first_[segment + 1]; }
  std::size_t segment_of(double s, std::size_t hint) const { return task_.path.tool().find(s, hint); }

  /// Returns the largest acceleration along the path that the axes allow at a node at rest.
  double acceleration(std::size_t node) const;
  /// Returns the largest jerk along the path that the axes allow at a node at rest.
  double jerk(std::size_t node) const;

  /// Returns 1 if a place is passed within `margin` of all limits at this speed, acceleration and jerk; otherwise the
  /// factor f < 1 up to which it is with acceleration f a and jerk f² j; 0 where v alone is too large.
  double share(const FeedNode& node, const FeedState& state, double margin) const;
  /// Returns whether a joint may be passed in this state: from the last node of a segment to the first one of the next.
  bool passes_joint(std::size_t next_segment, const FeedState& state) const;

 private:
  void sample(std::size_t segment);
  void search(std::size_t segment);
  FeedLimit slowest_around(std::size_t segment, double low, double high) const;
  FeedLimit at(std::size_t segment, double u) const;
  FeedLimit limit_of(const double* d1, const double* d2, const double* d3) const;
  void limit_at_joint(std::size_t next);

  const PathTask& task_;
  FeedGridOptions options_;
  std::size_t axes_;
  Sections sections_;
  std::vector<double> s_, u_, rows_, speed_;  // values at each node; speed_ is the largest constant speed
  std::vector<FeedLimit> minima_;             // local minima between nodes, ascending
  std::vector<double> joint_;                 // largest speed at the joint at the beginning of each segment
  std::vector<std::size_t> first_;
  std::vector<FeedLimit> hold_;
};

}  // namespace bahnwerk
