#pragma once
/// The points at which cells of the optimal probe motion begin and end, where the problem has more of them than that
/// takes.
///
/// A motion with a bounded snap S that passes points every h s differs between them from a smooth motion through the
/// same points by about S h⁴/100. Where that is less than point_tolerance, points between say nothing more, and cells
/// that are shorter than h only follow what noise the points have. So points are chosen about h apart, by the time of
/// the quickest straight as long as the polyline; the chosen ones are moved to a smooth curve that is near enough to
/// all (core/probe/optimal/point_fit.hpp), and a motion through them is tried on all points
/// (core/probe/optimal/passing.hpp). Where it misses one, split() chooses more.
#include <cstddef>
#include <vector>

#include "core/probe/problem.hpp"

namespace bahnwerk {

struct ChosenPoints {
  std::vector<std::size_t> index;  ///< indices of points, ascending, the first and the last one among them
  std::vector<Vec> at;             ///< place of each, mm
  std::vector<double> ball;        ///< radius about the place in which the motion may pass, mm
  std::vector<double> tube;        ///< radius about the segment from each to the next one, mm
};

class PointChoice {
 public:
  explicit PointChoice(const ProbeProblem& problem);

  /// Returns the chosen points; chooses more where no smooth curve through them is near enough to the others.
  ChosenPoints chosen();
  /// Chooses one point or three more between the chosen points of each edge of `open`, an edge of the last chosen().
  void split(const std::vector<std::size_t>& open);
  /// Chooses all points.
  void choose_all() { chosen_.assign(chosen_.size(), 1); }

 private:
  void split_gap(std::size_t from, std::size_t to);
  bool fit(std::size_t from, std::size_t to);

  const ProbeProblem& problem_;
  std::vector<Vec> centre_;      // place near to all given points that a point stands for
  std::vector<double> radius_;   // distance from there that point_tolerance leaves
  std::vector<double> time_;     // s, about
  std::vector<char> chosen_;
  std::vector<Vec> smooth_;      // places on the smooth curve
  std::vector<double> room_;     // distance from there that point_tolerance leaves
  std::vector<std::size_t> last_;  // what chosen() returned
};

}  // namespace bahnwerk
