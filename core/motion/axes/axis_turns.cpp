#include "core/motion/axes/axis_turns.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"
#include "core/motion/axes/axis_path.hpp"

namespace bahnwerk {
namespace {

constexpr int most_halvings = 40;

double whole(double value) { return std::nearbyint(value); }

}  // namespace

AxisTurns::AxisTurns(const KinematicAxisPath& path) {
  const Kinematics& machine = path.kinematics();
  bool any = false;
  for (std::size_t k = 0; k < path.axes(); ++k) any = (period_[k] = machine.period(k)) > 0 || any;
  if (!any) return;
  axes_ = path.axes();
  AxisArray now{}, lowest{}, highest{};
  bool begun = false;
  const auto follow = [&](std::size_t segment, double u) {  // continues `now` to a place less than half a period away
    AxisArray q = path.raw_at_parameter(segment, u).value;
    for (std::size_t k = 0; k < axes_; ++k) {
      if (begun && period_[k] > 0) q[k] += period_[k] * whole((now[k] - q[k]) / period_[k]);
      lowest[k] = begun ? std::min(lowest[k], q[k]) : q[k];
      highest[k] = begun ? std::max(highest[k], q[k]) : q[k];
    }
    now = q, begun = true;
  };
  struct Span {
    double begin, end;
    int halvings;
  };
  std::vector<Span> open;
  for (std::size_t segment = 0; segment < path.size(); ++segment) {
    first_.push_back(intervals_.size());
    const Curve& curve = path[segment].curve();
    follow(segment, curve.begin());
    open.assign(1, {curve.begin(), curve.end(), 0});
    while (!open.empty()) {
      const Span span = open.back();
      open.pop_back();
      const double half = (span.end - span.begin) / 2, middle = span.begin + half,
                   way = path[segment].travelled(span.end) - path[segment].travelled(span.begin),
                   radius = std::hypot(way, path.pose_turn(segment, middle, half));
      const MapBounds bounds = path.map_bounds(segment, middle, radius);
      bool close = std::isfinite(radius);
      for (std::size_t k = 0; k < axes_ && close; ++k)
        close = !(period_[k] > 0) || bounds.order[0][k] * radius <= period_[k] / 4;
      if (!close) {
        if (span.halvings == most_halvings)
          throw UnreachablePose("axes turn too fast for the tool to be followed (a singular pose)",
                                path[segment].arc_length(middle), path.pose(segment, middle).coordinates());
        open.push_back({middle, span.end, span.halvings + 1});
        open.push_back({span.begin, middle, span.halvings + 1});
        continue;
      }
      follow(segment, middle);
      intervals_.push_back({span.end, now});
      follow(segment, span.end);
    }
  }
  first_.push_back(intervals_.size());
  for (std::size_t k = 0; k < axes_; ++k) {
    if (!(period_[k] > 0) || intervals_.empty()) continue;
    const AxisLimits& axis = machine.axes()[k];
    const bool ranged = std::isfinite(axis.lowest) && std::isfinite(axis.highest);
    const double wanted = ranged ? axis.lowest + (axis.highest - axis.lowest) / 2 : 0,
                 is = ranged ? lowest[k] + (highest[k] - lowest[k]) / 2 : intervals_.front().middle[k],
                 shift = period_[k] * whole((wanted - is) / period_[k]);
    for (Interval& stretch : intervals_) stretch.middle[k] += shift;
  }
}

void AxisTurns::add(std::size_t segment, double u, AxisArray& position) const {
  if (axes_ == 0) return;
  const auto begin = intervals_.begin() + static_cast<std::ptrdiff_t>(first_[segment]),
             end = intervals_.begin() + static_cast<std::ptrdiff_t>(first_[segment + 1]) - 1;
  const Interval& here = *std::lower_bound(begin, end, u, [](const Interval& s, double at) { return s.end < at; });
  for (std::size_t k = 0; k < axes_; ++k)
    if (period_[k] > 0) position[k] += period_[k] * whole((here.middle[k] - position[k]) / period_[k]);
}

}  // namespace bahnwerk
