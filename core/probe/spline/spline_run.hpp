#pragma once
/// One spline in time through the points between two rests: times and reductions that keep tube, speed and limits.
#include <cstddef>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/motion/profile/profile.hpp"
#include "core/probe/problem.hpp"
#include "core/probe/spline/septic.hpp"

namespace bahnwerk::probe {

/// Returns whether there are so many points that fewer rounds have to do.
bool has_many_points(const ProbeProblem& problem);

class SplineRun {
 public:
  /// The spline goes from rest at point `first` to rest at point `last`. `rest_soon`: whatever point had to be reduced
  /// is one of rests().
  SplineRun(const ProbeProblem& problem, std::size_t first, std::size_t last, bool rest_soon = false);

  /// Returns whether times were found.
  bool solve(ProgressScope& progress);
  /// Points at which the head has to rest where no times were found.
  const std::vector<std::size_t>& rests() const { return rests_; }
  double duration() const;  ///< s
  /// Returns the durations of the intervals, s.
  const std::vector<double>& times() const { return time_; }
  /// Returns the state at point first + i.
  SepticEnd end(std::size_t i) const { return ends_[i]; }

 private:
  struct Strains {
    double time = 0;  // ratio of the duration that the interval needs to its present one
    double tube = 0;  // deviation / δ
  };
  std::size_t intervals() const { return time_.size(); }
  /// Sets times and along_ by the profile along the whole length for a speed and for limits × `share`.
  void start(double speed, double share);
  /// Sets the states at the points from along_. Path derivatives over the length of the polyline are those of the
  /// polynomial through five points, three where there are no more; pieces between states of less accuracy need the
  /// more snap the denser the points are.
  void follow_profile();
  /// Sets the states at the points by the parabolas through three points, from the times alone.
  void make_ends();
  struct Best {
    double duration = unlimited;  // duration once limits are kept
    std::vector<double> time;
    std::vector<SepticEnd> ends;
  };
  /// Computes the strains for the present times and ends, which become the best ones if they are quicker; returns
  /// whether all intervals are in the tube.
  bool look(std::vector<Strains>& strains, ProgressScope& progress);
  /// Returns whether the present pieces lie in the tube; a quick look, which ends at the first one that does not.
  bool in_tube(ProgressScope& progress) const;
  void search_profile(std::vector<Strains>& now, ProgressScope& progress);
  void search(ProgressScope& progress);
  bool finish(ProgressScope& progress);
  Strains strains(std::size_t i, double resolution) const;
  double tube_strain(const Bezier& x, std::size_t i, double resolution, int depth) const;
  /// Lets factors spread along the path, so that speeds change slowly enough.
  void smooth(std::vector<double>& factor) const;
  void reduce(const std::vector<Strains>& strains);

  const ProbeProblem& problem_;
  std::size_t first_;
  bool quick_;
  double least_share_;                         // share of velocity at a point below which the head rests there
  double rounding_, reach_ = 0;                // mm: of distances; along which speeds change
  std::vector<double> length_, time_, share_;  // length and duration of each interval, λ of each point
  std::vector<SepticEnd> ends_;                // state at each point
  std::vector<ProfileState> along_;            // state of the profile at each point
  Best best_;
  std::vector<std::size_t> rests_;
};

}  // namespace bahnwerk::probe
