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

  /// Returns the quickest choice for `directions`, one per edge of the problem. Candidates at a point are 0 and the
  /// fractions `shares` of the largest speed that it admits. Where `near`, an earlier choice (or null), turns, they are
  /// its speed times each of `factors`, the speeds of the neighbours, and the fractions `anywhere` of the largest
  /// speed. O(points · candidates²), 0.5 µs each.
  TurnSpeeds choose(const std::vector<Vec>& directions, const std::vector<double>& shares, const TurnSpeeds* near,
                    const std::vector<double>& factors, ProgressScope& progress,
                    const std::vector<double>& anywhere = {}) const;

  /// Returns the largest speed per point that the tube admits, that can be reached from the start and braked from to
  /// the end. A nominal speed that cannot be reached changes nothing.
  std::vector<double> largest_speeds(const std::vector<Vec>& directions) const;

 private:
  struct Candidate {
    double speed = 0;
    TurnSize size;
    Vec offset;           // C − P
    double time = 0;      // shortest from the start to the middle of the turn, s
    int before = -1;      // candidate at the point before
    bool by_row = false;  // whether it comes from a rest at the begin of the row that ends here
  };
  using Candidates = std::vector<Candidate>;
  std::vector<Turn> turns_of(const std::vector<Vec>& directions) const;
  double largest_speed(std::size_t i, const Turn& turn, Vec in, Vec out) const;
  /// Returns the speeds, at most `speed`, that can be reached from the start, or braked from to the end.
  std::vector<double> reachable(const std::vector<Turn>& turns, const std::vector<Vec>& directions, bool backwards,
                                std::vector<double> speed) const;
  void connect(std::size_t edge, Vec direction, const Candidates& from, Candidates& to) const;

  const ProbeProblem& problem_;
  const std::vector<std::size_t>& row_end_;
  double rounding_;
};

}  // namespace bahnwerk::probe
