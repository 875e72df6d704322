#pragma once
/// The speeds of the turns by dynamic programming over candidates per point, for given directions.
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/probe/arcs/turn.hpp"
#include "core/probe/arcs/turn_path.hpp"
#include "core/probe/problem.hpp"

namespace bahnwerk::probe {

class SpeedChoice {
 public:
  /// `row_end` as straight_rows() has it.
  SpeedChoice(const ProbeProblem& problem, const std::vector<std::size_t>& row_end);

  /// The quickest choice among the speeds 0 and shares[…] of the largest at each point that can be reached, and, where
  /// `near` is a choice made before, that speed times each of `factors`. `directions` per edge of the problem.
  /// There the neighbours' speeds are candidates, too, and the shares `anywhere` of the largest one.
  /// O(points · candidates²), 0.5 µs each.
  TurnSpeeds choose(const std::vector<Vec>& directions, const std::vector<double>& shares, const TurnSpeeds* near,
                    const std::vector<double>& factors, ProgressScope& progress,
                    const std::vector<double>& anywhere = {}) const;

 private:
  struct Candidate {
    double speed = 0;
    TurnSize size;
    Vec offset;           // C − P
    double time = 0;      // quickest from the start to the middle of the turn
    int before = -1;      // candidate at the point before
    bool by_row = false;  // from a rest at the begin of the row that ends here
  };
  using Candidates = std::vector<Candidate>;
  double largest_speed(std::size_t i, const Turn& turn, Vec in, Vec out) const;
  /// The largest speeds of all points: what the tube admits, and what can be reached from the start and braked from to
  /// the end. A nominal speed that cannot be reached changes nothing.
  std::vector<double> largest_speeds(const std::vector<Turn>& turns, const std::vector<Vec>& directions) const;
  void lower_to_reachable(const std::vector<Turn>& turns, const std::vector<Vec>& directions, bool backwards,
                          std::vector<double>& speed) const;
  void connect(std::size_t edge, Vec direction, const Candidates& from, Candidates& to) const;

  const ProbeProblem& problem_;
  const std::vector<std::size_t>& row_end_;
  double rounding_;
};

}  // namespace bahnwerk::probe
