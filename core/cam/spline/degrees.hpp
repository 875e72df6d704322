#pragma once
/// Balance of polynomial degrees [Nolte 4]: each condition at a point is given to one of the two sections that meet
/// there; a section's degree is the number of its conditions less one.
///
/// Those distributions are taken whose largest degree is the least, and among them those whose sum of squared
/// degrees is the least: an exact dynamic program over the shares of the points, along a path or around a cycle.
#include <cstddef>
#include <vector>

namespace bahnwerk::cam {

/// Range of the number of a point's `total` conditions that the section before it may take; the section behind it takes
/// the others.
struct PointShare {
  int total = 0;
  int before_min = 0, before_max = 0;
};

struct DegreeDistributions {
  /// Degree of every section, −1 where the section asks for none; each is a different best distribution. Where all are
  /// listed the first one gives the earliest sections the most; else it is the one whose points share their conditions
  /// most evenly between both sides. Empty: there is no distribution with all degrees in 0 … max_degree.
  std::vector<std::vector<int>> degrees;
  bool complete = true;   ///< false: there are more than were asked for; these differ everywhere, not at one end alone
  int least_maximum = 0;  ///< the largest degree of the best distributions, even where it is above the limit
};

/// Distributes the degrees. `shares` has one entry per point. `sections` says whether section i, behind point i, has
/// unknowns; it has shares.size() entries around a cycle, one less along a path. Points beside a section without
/// unknowns give all conditions to their other side (the caller says so in `shares`). O(points · most conditions², that
/// once more per condition of the first point for a cycle).
DegreeDistributions balance_degrees(const std::vector<PointShare>& shares, const std::vector<bool>& sections,
                                    int max_degree, std::size_t at_most);

/// Returns the distributions that follow the balanced ones: by their sum of squares, which is within 2 % of the least,
/// with a largest degree that is one more at most; up to `at_most` of them, which differ all over the law. They serve
/// where all balanced ones are singular.
std::vector<std::vector<int>> next_degrees(const std::vector<PointShare>& shares, const std::vector<bool>& sections,
                                           int max_degree, std::size_t at_most);

}  // namespace bahnwerk::cam
