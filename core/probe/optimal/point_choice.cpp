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
Limits least_limits(const ProbeProblem& problem) {
  Limits out;
  out.velocity = problem.speed;
  for (const AxisLimits& axis : problem.machine.axes) out.lower_to(axis);
  return out;
}

/// Returns the length of the polygon up to each given point, mm. Points nearer to each other than ten tolerances may be
/// out of order along the path: lengths are those between points that are farther apart, and the distance in that
/// direction between, as far as it grows.
std::vector<double> lengths(const ProbeProblem& problem) {
  const std::vector<Vec>& given = problem.given;
  std::vector<double> along(given.size(), 0.0);
  for (std::size_t from = 0; from + 1 < given.size();) {
    std::size_t to = from + 1;
    while (to + 1 < given.size() && norm(given[to] - given[from]) < 10 * problem.point_tolerance) ++to;
    const Vec way = given[to] - given[from];
    const double length = norm(way);
    for (std::size_t i = from + 1; i < to; ++i) {
      const double share = length > 0 ? dot(given[i] - given[from], way) / length : 0;
      along[i] = std::clamp(along[from] + share, along[i - 1], along[from] + length);
    }
    along[to] = along[from] + length;
    from = to;
  }
  return along;
}

}  // namespace

PointChoice::PointChoice(const ProbeProblem& problem, std::function<void()> report)
    : problem_(problem),
      report_(std::move(report)),
      first_(problem.points.size() + 1, problem.given.size()),
      along_(lengths(problem)),
      time_(problem.given.size()),
      own_(problem.points.size(), 0),
      chosen_(problem.points.size(), 0) {
  const std::size_t n = problem.points.size();
  for (std::size_t g = problem.given.size(); g-- > 0;) first_[problem.point_of[g]] = g;

  const Limits limits = least_limits(problem);
  profile_ = straight_profile(along_.back(), 0, 0, limits);
  for (std::size_t g = 0; g < along_.size(); ++g) time_[g] = probe::time_at(profile_, along_[g]);
  step_ = std::pow(100 * problem.point_tolerance / limits.snap, 0.25);
  const double steps = std::ceil(profile_.duration / step_);
  if (steps < static_cast<double>(n)) {
    for (double k = 0; k <= steps; ++k) knots_.push_back(k / steps * profile_.duration);
    own_.front() = own_.back() = 1;
  } else {
    own_.assign(n, 1);
  }
  fit();
  choose();
}

double PointChoice::time(std::size_t point) const {
  return time_[point + 1 < own_.size() ? first_[point] : time_.size() - 1];
}

PointChoice::Place PointChoice::place(std::size_t point, Vec at) const {
  double farthest = 0;
  for (std::size_t g = first_[point]; g < first_[point + 1]; ++g)
    farthest = std::max(farthest, norm(problem_.given[g] - at));
  Place out;
  out.at = at;
  out.room = std::max(0.0, reach * problem_.point_tolerance - farthest);
  out.along = along_[point + 1 < own_.size() ? first_[point] : along_.size() - 1];
  return out;
}

/// Returns whether a rest at either end passes the point. A point that lies there and is passed on the way is none.
bool PointChoice::at_rest(std::size_t point) const {
  const Vec at = problem_.points[point];
  const double along = along_[first_[point]], near = 10 * problem_.point_tolerance;
  return (norm(at - problem_.points.front()) < problem_.point_tolerance && along < near) ||
         (norm(at - problem_.points.back()) < problem_.point_tolerance && along_.back() - along < near);
}

std::vector<std::size_t> PointChoice::listed(const std::vector<char>& list) const {
  std::vector<std::size_t> index;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list[i]) index.push_back(i);
  return index;
}

bool PointChoice::split(const std::vector<std::size_t>& open, const std::vector<double>& times, bool all) {
  bool more = false;
  for (std::size_t e : open) {
    const std::size_t from = last_[e], to = last_[e + 1];
    const double middle = (times[from] + times[to]) / 2;
    std::size_t best = from + 1;
    for (std::size_t i = from + 1; i < to; ++i) {
      more = true;
      if (all) {
        chosen_[i] = own_[i] = 1;
        places_[i] = place(i, problem_.points[i]);
      }
      if (std::abs(times[i] - middle) < std::abs(times[best] - middle)) best = i;
    }
    chosen_[best] = 1;
  }
  return more;
}

/// Fits curves to all sections between points that stay where they are.
void PointChoice::fit() {
  for (bool near = false; !near;) {
    near = true;
    places_.clear();
    for (std::size_t i = 0; i < own_.size(); ++i) places_.push_back(place(i, problem_.points[i]));
    const std::vector<std::size_t> index = listed(own_);
    for (std::size_t c = 0; c + 1 < index.size(); ++c)
      if (index[c + 1] - index[c] > 1) near = fit(index[c], index[c + 1]) && near;
  }
}

/// Chooses points at most a step apart, where there are such, and no nearer than a third of it.
void PointChoice::choose() {
  const std::size_t n = own_.size();
  chosen_.front() = chosen_.back() = 1;
  std::size_t last = 0, k = 0;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    while (k + 2 < knots_.size() && knots_[k + 1] <= time(i)) ++k;
    const double step = knots_.empty() ? step_ : knots_[k + 1] - knots_[k];
    if (!own_[i] && time(i + 1) - time(last) <= 1.0001 * step) continue;
    if (std::min(time(i) - time(last), time(n - 1) - time(i)) < step / 3 || at_rest(i)) continue;
    chosen_[i] = 1;
    last = i;
  }
}

/// Fits a curve to the section from point `from` to point `to`; returns whether it is near enough to all given points.
/// Otherwise it has more knots next time, or points stay where they are.
bool PointChoice::fit(std::size_t from, std::size_t to) {
  constexpr double near_enough = 0.97;
  report_();
  std::vector<Vec> points;
  std::vector<double> along;
  std::vector<std::size_t> first;  // per point from `from` on: its first point of the fit
  for (std::size_t i = from; i <= to; ++i) {
    first.push_back(points.size());
    // The curve goes through the ends themselves, whatever else counts as them.
    const bool begin = i == 0, end = i == problem_.edges();
    for (std::size_t g = end ? first_[i + 1] - 1 : first_[i]; g < (begin ? 1 : first_[i + 1]); ++g) {
      points.push_back(problem_.given[g]);
      along.push_back(along_[g]);
    }
  }
  first.push_back(points.size());
  // The knots of the section, as times and as lengths.
  std::vector<double> knots{time(from)}, places{along.front()};
  const double least = 1e-9 * along.back();
  for (double knot : knots_) {
    const double length = profile_.sample(knot).s;
    if (!(length > places.back() + least && length < along.back() - least)) continue;
    knots.push_back(knot);
    places.push_back(length);
  }
  knots.push_back(time(to));
  places.push_back(along.back());
  const PointFit fit =
      fit_points(points, std::move(along), problem_.point_tolerance, places, from == 0, to == problem_.edges());

  bool near = true;
  std::size_t i = from;
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    const std::size_t begin = i;
    double most = 0;
    for (; i <= to && (time(i) < knots[k + 1] || k + 2 == knots.size()); ++i)
      for (std::size_t p = first[i - from]; p < first[i - from + 1]; ++p) most = std::max(most, norm(fit.off[p]));
    if (most <= near_enough * problem_.point_tolerance) continue;
    near = false;
    if (i - begin > 3)
      knots_.push_back((knots[k] + knots[k + 1]) / 2);
    else
      for (std::size_t o = std::max(begin, from + 1) - 1; o <= std::min(i, to); ++o) own_[o] = 1;
  }
  std::sort(knots_.begin(), knots_.end());
  for (i = from; near && i <= to; ++i) {
    const std::size_t p = first[i - from], q = first[i - from + 1] - 1;
    places_[i] = place(i, (fit.at[p] + fit.at[q]) / 2);
    places_[i].along = fit.along[p];
    places_[i].fitted = true;
    if (!own_[i]) places_[i].curve = fit.derivative[p];
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
    out.along.push_back(places_[i].along);
    out.curve.push_back(places_[i].curve);
    double room = places_[i].room;
    // On the curve, the points beside it keep half of their tolerance.
    for (std::size_t k = before; places_[i].fitted && k <= behind; ++k)
      if (k > 0 && k + 1 < n) room = std::min(room, places_[k].room / 2);
    out.ball.push_back(i == 0 || i + 1 == n ? 0 : room);
  }
  for (std::size_t c = 0; c + 1 < out.index.size(); ++c) {
    const std::size_t from = out.index[c], to = out.index[c + 1];
    const double moved = std::max(norm(out.at[c] - problem_.points[from]), norm(out.at[c + 1] - problem_.points[to]));
    double beside = 0;
    for (std::size_t i = from + 1; i < to; ++i)
      beside = std::max(beside, distance_from_edge(problem_.points[i], out.at[c], out.at[c + 1]));
    // The points between have to be inside with a margin; what leaves their edges' tubes is found afterwards.
    out.tube.push_back(std::max(problem_.tolerance - moved - beside, std::max(1.5 * beside, problem_.tolerance / 2)));
    if (to == from + 1 && moved == 0) out.tube.back() = problem_.tolerance;
  }
  return out;
}

}  // namespace bahnwerk
