#include "docs/draw/plans.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/base/progress.hpp"
#include "core/contour/blend.hpp"
#include "core/motion/jerk/jerk_limited.hpp"

namespace bahnwerk::draw {

namespace {

/// v over s from the largest v² at a path point.
std::vector<Line> limit_lines(const Contour& contour,
                              const std::function<double(const PathPoint&, double feed)>& speed2) {
  constexpr int steps = 400;  // per segment
  std::vector<Line> lines;
  const std::vector<double> feeds = contour.feeds();
  for (std::size_t i = 0; i < contour.path.size(); ++i) {
    const Segment& segment = contour.path[i];
    Line& line = lines.emplace_back();
    for (int j = 0; j <= steps; ++j) {
      const double s = segment.s0() + segment.length() * j / steps;
      const PathPoint at = segment.at(s);
      line.push_back({s, std::sqrt(speed2(at, feeds[i]))});
    }
  }
  return lines;
}

double velocity_cap(const PathPoint& at, const Machine& machine, double feed) {
  double most = feed * feed;
  for (std::size_t k = 0; k < machine.dimension(); ++k) {
    const double v = machine.axes[k].velocity / std::abs(at.d1[k]);
    most = std::min(most, v * v);
  }
  return most;
}

}  // namespace

AccelerationLimitedResult plan(const Contour& contour, const Machine& machine, bool keep_reserve,
                               const GridOptions& grid, double tolerance) {
  AccelerationLimitedOptions options;
  options.keep_reserve = keep_reserve;
  options.braking_reserve = reserve;
  options.grid = grid;
  options.tolerance = tolerance;
  Progress silent;
  return plan_acceleration_limited(contour, machine, options, silent);
}

TimeLaw plan_smooth(const Contour& contour, const Machine& machine) {
  Progress silent;
  return plan_jerk_limited(contour, machine, {}, silent).law;
}

Contour rounded(const Contour& contour, double tolerance, const Machine& machine) {
  BlendOptions options;
  options.tolerance = tolerance;
  Progress silent;
  return blend(contour, options, machine, silent);
}

PathMotion motion(const Contour& contour, const TimeLaw& law) {
  return {contour_axes(std::make_shared<const Contour>(contour), contour.dimension), law};
}

namespace {
constexpr double step = 2e-4;  // s, at most, from one state drawn to the next
int steps_of(double duration) { return std::max(2, static_cast<int>(std::ceil(duration / step))); }
}  // namespace

void along(const Motion& motion, const std::function<void(double t, const MotionState&)>& look) {
  for (std::size_t piece = 0; piece < motion.pieces(); ++piece) {
    const double begin = motion.begin(piece), duration = motion.end(piece) - begin;
    const int steps = steps_of(duration);
    for (int i = 0; i <= steps; ++i) {
      const double t = begin + duration * i / steps;
      look(t, motion.in_piece(piece, t));
    }
  }
}

Line speed_over_length(const TimeLaw& law) {
  Line line;
  for (const LawPiece& p : law.pieces()) {
    const int steps = steps_of(p.duration);
    for (int i = 0; i <= steps; ++i) {
      const LawState at = p.at(p.duration * i / steps);
      line.push_back({at.s, at.v});
    }
  }
  return line;
}

Line use_over_time(const Motion& motion, const Machine& machine, std::size_t axis) {
  Line line;
  along(motion, [&](double t, const MotionState& at) {
    line.push_back({t, std::abs(at[2][axis]) / machine.axes[axis].acceleration});
  });
  return line;
}

Line largest_use(const Motion& motion, const Machine& machine, Quantity quantity) {
  Line line;
  along(motion, [&](double t, const MotionState& at) {
    double most = 0;
    for (std::size_t k = 0; k < machine.dimension(); ++k) {
      const AxisLimits& axis = machine.axes[k];
      const double share = quantity == Quantity::velocity       ? at[1][k] / axis.velocity
                           : quantity == Quantity::acceleration ? at[2][k] / axis.acceleration
                                                                : at[3][k] / axis.jerk;
      most = std::max(most, std::abs(share));
    }
    line.push_back({t, most});
  });
  return line;
}

double share_at_limit(const Motion& motion, const Machine& machine) {
  double used = 0, last_time = 0;
  bool last = false;
  along(motion, [&](double t, const MotionState& at) {
    bool full = false;
    for (std::size_t k = 0; k < machine.dimension(); ++k)
      full = full || std::abs(at[2][k]) > 0.999 * machine.axes[k].acceleration ||
             std::abs(at[1][k]) > 0.999 * machine.axes[k].velocity;
    if (full && last) used += t - last_time;
    last = full;
    last_time = t;
  });
  return used / motion.duration();
}

std::vector<Line> highest_speed(const Contour& contour, const Machine& machine) {
  return limit_lines(contour, [&](const PathPoint& at, double feed) {
    const double bend = std::abs(at.d1[0] * at.d2[1] - at.d1[1] * at.d2[0]);
    const double room =
        machine.axes[0].acceleration * std::abs(at.d1[1]) + machine.axes[1].acceleration * std::abs(at.d1[0]);
    return std::min(velocity_cap(at, machine, feed), room / bend);
  });
}

std::vector<Line> reserve_speed(const Contour& contour, const Machine& machine) {
  return limit_lines(contour, [&](const PathPoint& at, double feed) {
    double most = velocity_cap(at, machine, feed);
    for (std::size_t k = 0; k < machine.dimension(); ++k)
      most = std::min(most, reserve * machine.axes[k].acceleration / std::abs(at.d2[k]));
    return most;
  });
}

}  // namespace bahnwerk::draw
