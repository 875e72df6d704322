#pragma once
/// The points between two rests as one spline in time: times and reductions that keep tube, speed and limits.
#include <cstddef>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/probe/problem.hpp"
#include "core/probe/spline/septic.hpp"

namespace bahnwerk::probe {

class SplineRun {
 public:
  /// From rest at point `first` to rest at point `last`, with jerks at the points or without.
  SplineRun(const ProbeProblem& problem, std::size_t first, std::size_t last, bool jerks);

  /// Whether times were found; else rests() is not empty.
  bool solve(ProgressScope& progress);
  /// Points at which the head has to rest.
  const std::vector<std::size_t>& rests() const { return rests_; }
  double duration() const;
  /// Per interval, s.
  const std::vector<double>& times() const { return time_; }
  /// The state at point first + i.
  SepticEnd end(std::size_t i) const { return ends_[i]; }

 private:
  struct Strains {
    double time = 0;  // how many times as long the interval should last
    double tube = 0;  // deviation / δ
  };
  std::size_t intervals() const { return time_.size(); }
  void start();
  void make_ends();
  Strains strains(std::size_t i, double resolution) const;
  /// Lets factors spread along the path, so that speeds change slowly enough.
  void smooth(std::vector<double>& factor) const;
  bool reduce(const std::vector<Strains>& strains);

  const ProbeProblem& problem_;
  std::size_t first_;
  bool jerks_;
  double rounding_, reach_ = 0;                // mm: of distances; along which speeds change
  std::vector<double> length_, time_, share_;  // per interval, per interval, λ per point
  std::vector<SepticEnd> ends_;                // per point
  std::vector<std::size_t> rests_;
};

}  // namespace bahnwerk::probe
