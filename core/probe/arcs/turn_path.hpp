#pragma once
/// Straights and turns of given speeds: their directions as a fixed point, speeds that fit, duration and motion.
#include <cstddef>
#include <utility>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/probe/arcs/turn.hpp"
#include "core/probe/problem.hpp"

namespace bahnwerk::probe {

/// The nodes of a path and the speed at each, 0 for a rest. Points that are no nodes lie on a straight between two
/// rests.
struct TurnSpeeds {
  std::vector<std::size_t> node;  ///< points, ascending; the first and the last point are among them
  std::vector<double> speed;      ///< mm/s, per node; 0 at both ends
};

/// A set of nodes with constant cost per operation.
class NodeSet {
 public:
  explicit NodeSet(std::size_t n) : in_(n, 0) {
    for (std::size_t i = 0; i < n; ++i) add(i);
  }
  void add(std::size_t i) {
    if (!in_[i]) list_.push_back(i), in_[i] = 1;
  }
  /// Returns the nodes and empties the set.
  std::vector<std::size_t> take() {
    for (const std::size_t i : list_) in_[i] = 0;
    return std::exchange(list_, {});
  }

 private:
  std::vector<char> in_;
  std::vector<std::size_t> list_;
};

class TurnPath {
 public:
  TurnPath(const ProbeProblem& problem, TurnSpeeds speeds);

  std::size_t nodes() const { return speeds_.node.size(); }
  const TurnSpeeds& speeds() const { return speeds_; }
  /// Returns the direction of the straight from node i to the next one, a unit vector.
  Vec direction(std::size_t i) const { return direction_[i]; }

  const std::vector<Vec>& directions() const { return direction_; }
  /// Iterates the fixed point of the directions until they move by less than `close`; 100 times at most. Only what
  /// still moves is computed again.
  void solve(double close, ProgressScope& progress);
  /// Lowers speeds until every turn is in the tube and every straight is as long as its change of speed needs.
  void repair(ProgressScope& progress);
  double duration() const;  ///< s
  ProbeMotion write(ProgressScope& progress) const;

 private:
  Turn turn(std::size_t i) const { return {*problem_, direction_[i - 1], direction_[i]}; }
  Vec point(std::size_t i) const { return problem_->points[speeds_.node[i]]; }
  /// Returns the straight from apex i to the next one, mm.
  Vec way(std::size_t i) const { return (point(i + 1) - point(i)) + (offset_[i + 1] - offset_[i]); }
  bool turns(std::size_t i) const { return speeds_.speed[i] > 0; }
  void measure(std::size_t i);
  bool straight_fits(std::size_t i) const;
  bool turn_fits(std::size_t i) const;
  /// Directions that differ by rounding alone, so that no turn is between them, are made one.
  void align();
  double straight_length(std::size_t i) const;
  double straight_duration(std::size_t i) const;

  const ProbeProblem* problem_;  // the problem, not null
  TurnSpeeds speeds_;
  std::vector<Vec> direction_;  // direction of each edge between nodes
  std::vector<TurnSize> size_;  // size of each node's turn
  std::vector<Vec> offset_;     // C − P, per node: small beside coordinates, so that short edges lose no digits
  double rounding_;             // rounding of a distance, mm
  NodeSet unsettled_;           // nodes to be measured again: their speed or a direction has changed
  NodeSet unchecked_;           // nodes whose turn or straights repair() has not seen as they are
};

}  // namespace bahnwerk::probe
