#pragma once
/// Random motion law problems: open and periodic, numbers and ranges of every order, limits of sections.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/cam/problem.hpp"
#include "core/numeric/random.hpp"

namespace bahnwerk::cam::testing {

/// `count` points, 2 at least. Angles, positions and weights are such that all peaks count for much the same.
inline MotionLawProblem random_law(Random& random, std::size_t count) {
  MotionLawProblem out;
  out.periodic = count > 2 && random.chance(0.5);
  const double stroke = 50, seconds = 1.0 / 360;  // per deg
  double at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    MotionPoint point;
    point.at = {at, at};
    point.continuity = 2 + static_cast<int>(random.below(2));
    const double position = stroke * random.uniform();
    const double room = i > 0 && random.chance(0.4) ? random.uniform(0.5, 3) : 0;
    point.values = {{position - room, position + room}};
    Range velocity, acceleration;
    if (random.chance(0.3)) velocity = {-400 * random.uniform(), 400 * random.uniform()};
    if (random.chance(0.1)) velocity = {0, 0};
    if (random.chance(0.1)) acceleration = {-20000 * random.uniform(), 20000 * random.uniform()};
    point.values.push_back(velocity);
    point.values.push_back(acceleration);
    if (!out.periodic && (i == 0 || i + 1 == count)) point.values = {{position, position}, {0, 0}, {0, 0}};
    out.points.push_back(std::move(point));
    at += random.uniform(15, 60);
  }
  out.length = out.periodic ? at : out.points.back().at.min;
  out.cycle_duration = out.length * seconds;
  out.objective.weight = {0, 1, random.uniform(0.01, 0.05), random.uniform(0.0003, 0.001)};
  for (std::size_t i = 0; i < out.sections(); ++i) {
    const Range a = out.points[i].value(0), b = out.points[out.end_point(i)].value(0);
    const Range from = out.points[i].value(1), to = out.points[out.end_point(i)].value(1);
    const double low = std::min(a.min, b.min), high = std::max(a.max, b.max);
    if (random.chance(0.15)) out.points[i].section[0] = {low - random.uniform(1, 8), high + random.uniform(1, 8)};
    if (!random.chance(0.1)) continue;
    if (a.max < b.min && from.max >= 0 && to.max >= 0) out.points[i].section[1].min = 0;
    if (a.min > b.max && from.min <= 0 && to.min <= 0) out.points[i].section[1].max = 0;
  }
  return out;
}

/// The same problem with all durations times `time` and all positions times `stroke`: J of every law is `stroke` times
/// what it was.
inline MotionLawProblem scaled(const MotionLawProblem& problem, double time, double stroke) {
  MotionLawProblem out = problem;
  const auto scale = [&](Range& range, int order) {
    const double factor = stroke / std::pow(time, order);
    range =
        range.fixed() ? Range{range.min * factor, range.min * factor} : Range{range.min * factor, range.max * factor};
  };
  *out.cycle_duration *= time;
  for (MotionPoint& point : out.points) {
    for (std::size_t r = 0; r < point.values.size(); ++r) scale(point.values[r], static_cast<int>(r));
    for (std::size_t r = 0; r < point.section.size(); ++r) scale(point.section[r], static_cast<int>(r));
  }
  for (std::size_t r = 1; r < out.objective.weight.size(); ++r)
    out.objective.weight[r] *= std::pow(time, static_cast<double>(r));
  return out;
}

}  // namespace bahnwerk::cam::testing
