#include "core/probe/straight/rows.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/probe/straight/straight.hpp"

namespace bahnwerk::probe {
namespace {

constexpr double room = 1e-3;  // part of the allowed distance that is left for rounding

class RowFinder {
 public:
  explicit RowFinder(const ProbeProblem& problem) : points_(problem.points), reach_(problem.points.size()) {
    std::vector<double> taken(points_.size(), 0.0);
    for (std::size_t i = 0; i < problem.given.size() && i < problem.point_of.size(); ++i) {
      double& most = taken[problem.point_of[i]];
      most = std::max(most, norm(problem.given[i] - points_[problem.point_of[i]]));
    }
    const double rounding = coordinate_rounding(problem) / 4;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      reach_[i] = std::max(rounding, (1 - room) * std::min(problem.point_tolerance - taken[i], problem.tolerance));
    }
  }

  std::size_t last() const { return points_.size() - 1; }

  /// Returns whether the straight from a to b passes what is in between.
  bool passes(std::size_t a, std::size_t b) const {
    const Vec chord = points_[b] - points_[a];
    const double length = norm(chord);
    if (!(length > 0)) return false;
    double before = 0;
    for (std::size_t i = a + 1; i < b; ++i) {
      const Vec from = points_[i] - points_[a];
      const double along = dot(from, chord) / length;
      if (!(along > before) || !(along < length) || norm(cross(from, chord)) > reach_[i] * length) return false;
      before = along;
    }
    return true;
  }

  /// Returns the end, in steps of `step` = ±1, of a long straight from a: the furthest one wherever the straights to
  /// nearer points pass, too, or where that is seen within `tries` trials.
  std::size_t furthest(std::size_t a, int step) const {
    const std::size_t most = step > 0 ? last() - a : a;
    const auto to = [&](std::size_t n) { return step > 0 ? a + n : a - n; };
    const auto good = [&](std::size_t n) { return step > 0 ? passes(a, to(n)) : passes(to(n), a); };
    std::size_t n = 1, width = 1;
    for (; n < most && good(std::min(most, n + width)); width *= 2) n = std::min(most, n + width);
    for (; width > 0; width /= 2)
      if (n + width <= most && good(n + width)) n += width;
    constexpr std::size_t tries = 40;
    const std::size_t end = cone_end(a, step);
    for (std::size_t m = end; m > n && end - m < tries; --m)
      if (good(m)) return to(m);
    return to(n);
  }

  /// Returns the number of points behind a up to which straights from a can pass at all. The directions in which one
  /// passes point k are a cone; behind a point whose cone does not meet the narrowest one there are none.
  std::size_t cone_end(std::size_t a, int step) const {
    const std::size_t most = step > 0 ? last() - a : a;
    Vec axis;
    double narrowest = 4;
    for (std::size_t n = 1; n <= most; ++n) {
      const std::size_t i = step > 0 ? a + n : a - n;
      const Vec way = points_[i] - points_[a];
      const double length = norm(way);
      if (!(length > reach_[i])) continue;
      const Vec direction = way / length;
      const double half = std::asin(reach_[i] / length);
      if (narrowest < 4) {
        const double angle = std::atan2(norm(cross(axis, direction)), dot(axis, direction));
        // The straight may end at point n itself: its direction has to be in the narrowest cone.
        if (angle > narrowest + half) return n - 1;
      }
      if (half < narrowest) narrowest = half, axis = direction;
    }
    return most;
  }

  /// Points at which straights may meet, ascending.
  std::vector<std::size_t> meeting_points() const {
    constexpr std::size_t few = 60, between = 4;
    std::vector<char> is(points_.size(), points_.size() <= few ? 1 : 0);
    if (points_.size() > few) {
      for (std::size_t i = 0; i < last(); i = furthest(i, 1)) is[i] = 1;
      for (std::size_t i = last(); i > 0; i = furthest(i, -1)) is[i] = 1;
      is.front() = 1;
      for (std::size_t a = 0; a < last();) {
        std::size_t b = a + 1;
        while (!is[b]) ++b;
        // Evenly, from either end alike.
        for (std::size_t k = 1; 2 * k <= between; ++k)
          is[a + k * (b - a) / (between + 1)] = 2, is[b - k * (b - a) / (between + 1)] = 2;
        is[a] = is[b] = 1;
        a = b;
      }
    }
    std::vector<std::size_t> list;
    for (std::size_t i = 0; i < is.size(); ++i)
      if (is[i]) list.push_back(i);
    return list;
  }

  /// Returns the points at which straights meet, both ends included, that make the sum of `cost` of the straights
  /// least.
  std::vector<std::size_t> shortest(const std::function<double(std::size_t, std::size_t)>& cost) const {
    const std::vector<std::size_t> at = meeting_points();
    std::vector<double> best(at.size(), unlimited);
    std::vector<std::size_t> before(at.size(), 0);
    best[0] = 0;
    for (std::size_t a = 0; a + 1 < at.size(); ++a) {
      if (!(best[a] < unlimited)) continue;
      const std::size_t end = at[a] + cone_end(at[a], 1);
      for (std::size_t b = a + 1; b < at.size() && at[b] <= std::max(end, at[a] + 1); ++b) {
        if (!passes(at[a], at[b])) continue;
        const double sum = best[a] + cost(at[a], at[b]);
        if (sum < best[b]) best[b] = sum, before[b] = a;
      }
    }
    std::vector<std::size_t> path{at.back()};
    for (std::size_t b = at.size() - 1; b > 0; b = before[b]) path.push_back(at[before[b]]);
    std::reverse(path.begin(), path.end());
    return path;
  }

 private:
  const std::vector<Vec>& points_;
  std::vector<double> reach_;
};

}  // namespace

std::vector<std::size_t> straight_rows(const ProbeProblem& problem) {
  const RowFinder finder(problem);
  const std::vector<std::size_t> meet =
      finder.shortest([&](std::size_t a, std::size_t b) { return rest_to_rest_duration(problem, a, b); });
  std::vector<std::size_t> end(problem.points.size(), finder.last());
  for (std::size_t m = 0; m + 1 < meet.size(); ++m)
    for (std::size_t i = meet[m]; i < meet[m + 1]; ++i) end[i] = meet[m + 1];
  return end;
}

}  // namespace bahnwerk::probe
