#pragma once
/// The points at which cells of the optimal probe motion begin and end, where the problem has more of them than that
/// takes.
///
/// A motion with a bounded snap S that passes points every h s differs between them from a smooth motion through the
/// same points by about S h⁴/100. Where that is less than point_tolerance, points between say nothing more, and cells
/// shorter than h only follow what noise the points have. So points are chosen about h apart, by the time of the
/// quickest straight as long as the polyline, never nearer than a third of h, and moved to a smooth curve near to all
/// (core/probe/optimal/point_fit.hpp); a motion through them is tried on all points (core/probe/optimal/passing.hpp).
/// Where it misses one, split() chooses more. Points that a rest at either end passes are not chosen at first.
#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "core/motion/profile/profile.hpp"
#include "core/probe/problem.hpp"

namespace bahnwerk {

struct ChosenPoints {
  std::vector<std::size_t> index;  ///< indices of points, ascending, the first and the last one among them
  std::vector<Vec> at;             ///< place of each, mm
  std::vector<double> ball;        ///< radius about the place in which the motion may pass, mm
  /// The curve near each point: its parameter, about the length, mm, and its derivatives of orders 1 to 3 with respect
  /// to it; 0 for points that stay at their own places.
  std::vector<double> along;
  std::vector<std::array<Vec, 3>> curve;
  std::vector<double> tube;  ///< radius about the segment from each to the next one, mm
};

class PointChoice {
 public:
  /// `report` is called before each fit of a curve and may throw.
  explicit PointChoice(
      const ProbeProblem& problem, std::function<void()> report = [] {});

  /// Returns the chosen points.
  ChosenPoints chosen();
  /// Chooses more points between the chosen points of each edge of `open`, an edge of the last chosen(): the one that
  /// is passed next to the middle of the time between, where points are passed at `times`, or all, which then stay
  /// where they are. Returns whether there are such.
  bool split(const std::vector<std::size_t>& open, const std::vector<double>& times, bool all);

 private:
  struct Place {
    Vec at;           // mm
    double room = 0;  // distance from there that point_tolerance leaves to all given points of the point, mm
    double along = 0;
    bool fitted = false;  // the place is on the smooth curve
    std::array<Vec, 3> curve{};
  };
  Place place(std::size_t point, Vec at) const;
  bool at_rest(std::size_t point) const;
  double time(std::size_t point) const;
  std::vector<std::size_t> listed(const std::vector<char>& list) const;
  void fit();
  void choose();
  bool fit(std::size_t from, std::size_t to);

  const ProbeProblem& problem_;
  std::function<void()> report_;
  std::vector<std::size_t> first_;  // the first given point of each point
  std::vector<Place> places_;       // the points' own places, or those on the smooth curve
  Profile profile_;                 // of the quickest straight as long as the polyline
  std::vector<double> along_;       // mm, of each given point, about
  std::vector<double> time_;        // s, of each given point, about
  double step_ = 0;                 // h, s
  std::vector<double> knots_;       // s, of the smooth curve
  std::vector<char> own_;           // the point stays at its own place
  std::vector<char> chosen_;        // the point is chosen
  std::vector<std::size_t> last_;   // what chosen() returned
};

}  // namespace bahnwerk
