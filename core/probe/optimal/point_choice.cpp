#include "core/probe/optimal/point_choice.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/probe/optimal/point_fit.hpp"
#include "core/probe/straight/straight.hpp"

namespace bahnwerk {
namespace {

constexpr double reach = 0.999;  // of point_tolerance

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

/// Returns the length of the polygon up to each given point, mm. Points nearer to each other than ten tolerances may be
/// out of order along the path: lengths are those between points that are farther apart, in equal steps between.
std::vector<double> lengths(const ProbeProblem& problem) {
  const std::vector<Vec>& given = problem.given;
  std::vector<double> along(given.size(), 0.0);
  for (std::size_t from = 0; from + 1 < given.size();) {
    std::size_t to = from + 1;
    while (to + 1 < given.size() && norm(given[to] - given[from]) < 10 * problem.point_tolerance) ++to;
    const double step = norm(given[to] - given[from]) / static_cast<double>(to - from);
    for (std::size_t i = from + 1; i <= to; ++i) along[i] = along[from] + static_cast<double>(i - from) * step;
    from = to;
  }
  return along;
}

}  // namespace

PointChoice::PointChoice(const ProbeProblem& problem)
    : problem_(problem),
      first_(problem.points.size() + 1, problem.given.size()),
      along_(lengths(problem)),
      time_(problem.points.size()),
      chosen_(problem.points.size(), 0) {
  const std::size_t n = problem.points.size();
  for (std::size_t g = problem.given.size(); g-- > 0;) first_[problem.point_of[g]] = g;

  const ProfileLimits limits = least_limits(problem);
  const Profile profile = straight_profile(along_.back(), 0, 0, limits);
  for (std::size_t i = 0; i < n; ++i)
    time_[i] = probe::time_at(profile, along_[i + 1 < n ? first_[i] : along_.size() - 1]);
  const double step = std::pow(100 * problem.point_tolerance / limits.snap, 0.25);
  const double steps = std::ceil(profile.duration / step);
  if (steps < static_cast<double>(n)) {
    // The points nearest to equidistant times, and all where points are farther apart. The curve has fewer knots, for
    // noise to be averaged.
    knot_ = chosen_;
    std::size_t i = 0;
    for (double k = 0; k <= steps; ++k) {
      const double t = k / steps * profile.duration;
      while (i + 1 < n && std::abs(time_[i + 1] - t) < std::abs(time_[i] - t)) ++i;
      chosen_[i] = 1;
      if (std::fmod(std::min(k, steps - k), 4) == 0) knot_[i] = 1;
    }
    chosen_.front() = chosen_.back() = knot_.front() = knot_.back() = 1;
    const std::vector<std::size_t> index = listed(chosen_);
    for (std::size_t c = 0; c + 1 < index.size(); ++c)
      if (time_[index[c + 1]] - time_[index[c]] > 1.5 * step)
        for (i = index[c]; i <= index[c + 1]; ++i) chosen_[i] = knot_[i] = 1;
  } else {
    knot_.assign(n, 1);
  }
  fit();
}

PointChoice::Place PointChoice::place(std::size_t point, Vec at) const {
  double farthest = 0;
  for (std::size_t g = first_[point]; g < first_[point + 1]; ++g)
    farthest = std::max(farthest, norm(problem_.given[g] - at));
  return {at, std::max(0.0, reach * problem_.point_tolerance - farthest)};
}

std::vector<std::size_t> PointChoice::listed(const std::vector<char>& list) const {
  std::vector<std::size_t> index;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list[i]) index.push_back(i);
  return index;
}

void PointChoice::choose_between(std::size_t from, std::size_t to, std::vector<char>& list) {
  // The point nearest to the middle; one that is chosen already if there is one, for no two to be close together.
  const double middle = (time_[from] + time_[to]) / 2;
  std::size_t best = to;
  const auto before = [&](std::size_t a, std::size_t b) {
    if (chosen_[a] != chosen_[b]) return chosen_[a] > chosen_[b];
    return std::abs(time_[a] - middle) < std::abs(time_[b] - middle);
  };
  for (std::size_t i = from + 1; i < to; ++i)
    if (best == to || before(i, best)) best = i;
  if (best < to) list[best] = 1;
}

void PointChoice::choose_all() {
  knot_.assign(problem_.points.size(), 1);
  fit();
}

void PointChoice::split(const std::vector<std::size_t>& open) {
  for (std::size_t e : open) choose_between(last_[e], last_[e + 1], chosen_);
}

/// Fits curves to all sections between the knots of which there are other points.
void PointChoice::fit() {
  for (bool near = false; !near;) {
    near = true;
    places_.clear();
    for (std::size_t i = 0; i < knot_.size(); ++i) places_.push_back(place(i, problem_.points[i]));
    fitted_.assign(knot_.size(), 0);
    const std::vector<std::size_t> index = listed(knot_);
    for (std::size_t c = 0; c + 1 < index.size();) {
      std::size_t end = c;
      while (end + 1 < index.size() && index[end + 1] - index[end] > 1) ++end;
      if (end > c) near = fit(index[c], index[end]) && near;
      c = std::max(end, c + 1);
    }
  }
  for (std::size_t i = 0; i < chosen_.size(); ++i) chosen_[i] = chosen_[i] || knot_[i];
}

/// Fits a curve to the section from point `from` to point `to`; returns whether it is near enough to all given points.
/// Otherwise it has more knots next time.
bool PointChoice::fit(std::size_t from, std::size_t to) {
  constexpr double near_enough = 0.97, small = 0.05;
  std::vector<Vec> points;
  std::vector<double> along;
  std::vector<std::size_t> knots, first;  // per point from `from` on: its first point of the fit
  for (std::size_t i = from; i <= to; ++i) {
    first.push_back(points.size());
    // The curve goes through the ends themselves, whatever else counts as them.
    const bool begin = i == 0, end = i == problem_.edges();
    for (std::size_t g = end ? first_[i + 1] - 1 : first_[i]; g < (begin ? 1 : first_[i + 1]); ++g) {
      points.push_back(problem_.given[g]);
      along.push_back(along_[g]);
    }
    if (knot_[i]) knots.push_back(i == to ? points.size() - 1 : first.back());
  }
  first.push_back(points.size());
  const PointFit fit =
      fit_points(points, std::move(along), problem_.point_tolerance, knots, from == 0, to == problem_.edges());
  bool near = true;
  std::size_t last = from;
  for (std::size_t i = from + 1; i <= to; ++i) {
    if (!knot_[i]) continue;
    double most = 0, squares = 0, neighbours = 0;
    for (std::size_t p = first[last - from]; p < first[i - from + 1]; ++p) {
      most = std::max(most, norm(fit.off[p]));
      squares += dot(fit.off[p], fit.off[p]);
      if (p > first[last - from]) neighbours += dot(fit.off[p - 1], fit.off[p]);
    }
    // Noise differs from point to point; what neighbours have in common is the shape of the path.
    const bool shape = most > small * problem_.point_tolerance && neighbours > 0.5 * squares;
    if (most > near_enough * problem_.point_tolerance || shape) {
      near = false;
      choose_between(last, i, knot_);
    }
    last = i;
  }
  for (std::size_t i = from; near && i <= to; ++i) {
    places_[i] = place(i, (fit.at[first[i - from]] + fit.at[first[i - from + 1] - 1]) / 2);
    fitted_[i] = 1;
  }
  return near;
}

ChosenPoints PointChoice::chosen() {
  const std::size_t n = chosen_.size();
  ChosenPoints out;
  out.index = last_ = listed(chosen_);
  for (std::size_t c = 0; c < out.index.size(); ++c) {
    const std::size_t i = out.index[c], before = c > 0 ? out.index[c - 1] : i,
                      behind = c + 1 < out.index.size() ? out.index[c + 1] : i;
    out.at.push_back(places_[i].at);
    double room = places_[i].room;
    // On the curve, the points beside it keep half of their room.
    for (std::size_t k = before; fitted_[i] && k <= behind; ++k)
      if (k > 0 && k + 1 < n) room = std::min(room, places_[k].room / 2);
    out.ball.push_back(i == 0 || i + 1 == n ? 0 : room);
  }
  for (std::size_t c = 0; c + 1 < out.index.size(); ++c) {
    const std::size_t from = out.index[c], to = out.index[c + 1];
    const double moved = std::max(norm(out.at[c] - problem_.points[from]), norm(out.at[c + 1] - problem_.points[to]));
    double beside = 0;
    for (std::size_t i = from + 1; i < to; ++i)
      beside = std::max(beside, distance_from_edge(problem_.points[i], out.at[c], out.at[c + 1]));
    // The points between have to be inside with room; what leaves their edges' tubes is found afterwards.
    out.tube.push_back(std::max(problem_.tolerance - moved - beside, std::max(1.5 * beside, problem_.tolerance / 2)));
    if (to == from + 1 && moved == 0) out.tube.back() = problem_.tolerance;
  }
  return out;
}

}  // namespace bahnwerk
