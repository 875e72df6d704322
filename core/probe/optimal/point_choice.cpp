#include "core/probe/optimal/point_choice.hpp"

#include <algorithm>
#include <cmath>

#include "core/probe/optimal/point_fit.hpp"
#include "core/probe/straight/straight.hpp"

namespace bahnwerk {
namespace {

constexpr double reach = 0.999;  // of point_tolerance

/// Fewer points than that between two chosen ones are chosen, too.
constexpr std::size_t few = 3;

/// The least limits of any axis.
ProfileLimits least_limits(const ProbeProblem& problem) {
  ProfileLimits out;
  out.velocity = problem.speed;
  for (const AxisLimits& axis : problem.machine.axes) {
    out.acceleration = std::min(out.acceleration, axis.acceleration);
    out.jerk = std::min(out.jerk, axis.jerk);
    out.snap = std::min(out.snap, axis.snap);
  }
  return out;
}

}  // namespace

PointChoice::PointChoice(const ProbeProblem& problem)
    : problem_(problem),
      centre_(problem.points),
      radius_(problem.points.size()),
      time_(problem.points.size()),
      chosen_(problem.points.size(), 0) {
  const std::size_t n = problem.points.size();
  for (std::size_t i = 0, end = 0; i < n; ++i) {
    const std::size_t begin = end;
    while (end < problem.given.size() && problem.point_of[end] == i) ++end;
    const auto farthest = [&](Vec from) {
      double most = 0;
      for (std::size_t g = begin; g < end; ++g) most = std::max(most, norm(problem.given[g] - from));
      return most;
    };
    double most = farthest(centre_[i]);
    if (most > 0 && i > 0 && i + 1 < n) {
      Vec low = problem.given[begin], high = low;
      for (std::size_t g = begin; g < end; ++g)
        for (std::size_t k = 0; k < 3; ++k)
          low[k] = std::min(low[k], problem.given[g][k]), high[k] = std::max(high[k], problem.given[g][k]);
      const Vec middle = (low + high) / 2;
      // The tube is about the point itself.
      if (farthest(middle) < most && norm(middle - centre_[i]) < 0.1 * problem.tolerance)
        centre_[i] = middle, most = farthest(middle);
    }
    radius_[i] = std::max(0.0, reach * (problem.point_tolerance - most));
  }
  std::vector<double> along(n, 0.0);
  for (std::size_t i = 1; i < n; ++i) along[i] = along[i - 1] + norm(problem.points[i] - problem.points[i - 1]);
  const ProfileLimits limits = least_limits(problem);
  const Profile profile = straight_profile(along.back(), 0, 0, limits);
  for (std::size_t i = 0; i < n; ++i) time_[i] = probe::time_at(profile, along[i]);
  const double step = std::pow(100 * problem.point_tolerance / limits.snap, 0.25);
  const double steps = std::ceil(profile.duration / step);
  if (!(steps < static_cast<double>(n))) {
    choose_all();
    return;
  }
  // The points nearest to equidistant times.
  std::size_t i = 0;
  for (double k = 0; k <= steps; ++k) {
    const double t = k / steps * profile.duration;
    while (i + 1 < n && std::abs(time_[i + 1] - t) < std::abs(time_[i] - t)) ++i;
    chosen_[i] = 1;
  }
  chosen_.front() = chosen_.back() = 1;
}

void PointChoice::split_gap(std::size_t from, std::size_t to) {
  if (to - from <= few + 1) {
    std::fill(chosen_.begin() + static_cast<std::ptrdiff_t>(from), chosen_.begin() + static_cast<std::ptrdiff_t>(to), 1);
    return;
  }
  const double middle = (time_[from] + time_[to]) / 2;
  std::size_t at = from + 1;
  while (at + 2 < to && time_[at] < middle) ++at;
  chosen_[at] = 1;
}

void PointChoice::split(const std::vector<std::size_t>& open) {
  for (std::size_t e : open) split_gap(last_[e], last_[e + 1]);
}

/// Fits a curve to the points from `from` to `to`, between all chosen ones of which there are others; returns whether
/// it is near enough. Otherwise it has chosen more.
bool PointChoice::fit(std::size_t from, std::size_t to) {
  constexpr double near_enough = 0.97, least_radius = 0.05;
  const auto begin = static_cast<std::ptrdiff_t>(from), end = static_cast<std::ptrdiff_t>(to) + 1;
  const std::vector<Vec> points(centre_.begin() + begin, centre_.begin() + end);
  std::vector<double> radius(radius_.begin() + begin, radius_.begin() + end);
  for (double& r : radius) r = std::max(r, least_radius * problem_.point_tolerance);
  std::vector<std::size_t> knots;
  for (std::size_t i = from; i <= to; ++i)
    if (chosen_[i]) knots.push_back(i - from);
  const PointFit fit = fit_points(points, radius, knots, from == 0, to + 1 == centre_.size());
  bool near = true;
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    double most = 0;
    for (std::size_t i = knots[k]; i <= knots[k + 1]; ++i)
      most = std::max(most, fit.distance[i] * radius[i] / std::max(radius_[from + i], 1e-3 * radius[i]));
    if (most <= near_enough) continue;
    near = false;
    split_gap(from + knots[k], from + knots[k + 1]);
  }
  for (std::size_t i = 0; near && i < points.size(); ++i) {
    smooth_[from + i] = fit.at[i];
    room_[from + i] = radius_[from + i] - fit.distance[i] * radius[i];
  }
  return near;
}

ChosenPoints PointChoice::chosen() {
  const std::size_t n = centre_.size();
  std::vector<std::size_t> index;
  for (bool changed = true; changed;) {
    changed = false;
    smooth_ = centre_;
    room_ = radius_;
    index.clear();
    for (std::size_t i = 0; i < n; ++i)
      if (chosen_[i]) index.push_back(i);
    for (std::size_t c = 0; c + 1 < index.size(); ++c)
      if (index[c + 1] - index[c] > 1 && index[c + 1] - index[c] <= few) split_gap(index[c], index[c + 1]), changed = true;
    for (std::size_t c = 0; !changed && c + 1 < index.size();) {
      std::size_t end = c;
      while (end + 1 < index.size() && index[end + 1] - index[end] > 1) ++end;
      if (end > c) changed = !fit(index[c], index[end]);
      c = std::max(end, c + 1);
    }
  }
  ChosenPoints out;
  out.index = index;
  for (std::size_t c = 0; c < index.size(); ++c) {
    const std::size_t i = index[c];
    out.at.push_back(smooth_[i]);
    // A chosen point may be passed as far from the curve as leaves the points beside it half of their room.
    double room = room_[i];
    if (c > 0 && i - index[c - 1] > 1)
      for (std::size_t k = index[c - 1]; k < i; ++k) room = std::min(room, k == 0 ? room : room_[k] / 2);
    if (c + 1 < index.size() && index[c + 1] - i > 1)
      for (std::size_t k = i + 1; k <= index[c + 1]; ++k) room = std::min(room, k + 1 == n ? room : room_[k] / 2);
    out.ball.push_back(i == 0 || i + 1 == n ? 0 : room);
  }
  for (std::size_t c = 0; c + 1 < index.size(); ++c) {
    const double moved = std::max(norm(out.at[c] - problem_.points[index[c]]),
                                  norm(out.at[c + 1] - problem_.points[index[c + 1]]));
    double beside = 0;
    for (std::size_t i = index[c] + 1; i < index[c + 1]; ++i)
      beside = std::max(beside, distance_from_edge(problem_.points[i], out.at[c], out.at[c + 1]));
    // The points between have to be inside with room; what leaves their edges' tubes is found afterwards.
    out.tube.push_back(std::max(problem_.tolerance - moved - beside, std::max(1.5 * beside, problem_.tolerance / 2)));
    if (index[c + 1] == index[c] + 1 && moved == 0) out.tube.back() = problem_.tolerance;
  }
  last_ = index;
  return out;
}

}  // namespace bahnwerk
