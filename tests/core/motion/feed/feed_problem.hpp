#pragma once
/// Paths for the tests of feeds: lines with links of continuous curvature between, on a Cartesian machine with two
/// axes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/geometry/curve/line.hpp"
#include "core/geometry/curve/rational.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/motion/feed/constant_feed.hpp"
#include "core/numeric/random.hpp"
#include "core/verify/law/verifier.hpp"
#include "tests/core/check_names.hpp"

namespace bahnwerk::test {

struct FeedProblem {
  Path tool;
  Machine machine{{{"x", 500, 4000, 80000}, {"y", 400, 3000, 60000}}, 0.001};
  std::unique_ptr<CartesianAxisPath> axes;
  std::unique_ptr<PathTask> task;

  /// Lines of `legs` mm, each turned by `turns` rad against the one before, with links that take `room` mm of both.
  FeedProblem(const std::vector<double>& legs, const std::vector<double>& turns, double room) {
    Vec at{};
    double angle = 0.3;
    for (std::size_t i = 0; i < legs.size(); ++i) {
      const Vec along{std::cos(angle), std::sin(angle)};
      const Vec to = at + legs[i] * along;
      tool.append(std::make_shared<Line>(at, to), tool.size());
      at = to;
      if (i + 1 == legs.size()) break;
      angle += turns[i];
      const Vec next{std::cos(angle), std::sin(angle)}, corner = at + room * along, end = corner + room * next;
      tool.append(
          std::make_shared<Rational>(Rational::bezier({at, at + 0.4 * room * along, at + 0.7 * room * along,
                                                       corner + 0.3 * room * next, corner + 0.6 * room * next, end})),
          tool.size());
      at = end;
    }
    axes = std::make_unique<CartesianAxisPath>(tool, 2);
    std::vector<bool> rests(tool.size() + 1, false);
    rests.front() = rests.back() = true;
    task = std::make_unique<PathTask>(
        PathTask{*axes, machine, std::vector<double>(tool.size(), unlimited), std::move(rests)});
  }
  /// One to six lines, random limits and feeds.
  explicit FeedProblem(Random& random) : FeedProblem(Shape(random)) {
    for (AxisLimits& axis : machine.axes) {
      axis.velocity = std::pow(10, random.uniform(1, 3));
      axis.acceleration = axis.velocity * std::pow(10, random.uniform(0, 1.5));
      axis.jerk = axis.acceleration * std::pow(10, random.uniform(0, 2));
    }
    for (double& feed : task->feeds)
      if (random.chance(0.3)) feed = std::pow(10, random.uniform(0, 2.5));
  }
  FeedProblem(const FeedProblem&) = delete;
  FeedProblem& operator=(const FeedProblem&) = delete;

 private:
  struct Shape {
    std::vector<double> legs, turns;
    double room;
    explicit Shape(Random& random) : room(std::pow(10, random.uniform(-0.5, 1.5))) {
      const std::size_t n = 1 + random.below(6);
      for (std::size_t i = 0; i < n; ++i) {
        legs.push_back(std::pow(10, random.uniform(-1, 2)));
        turns.push_back(random.uniform(0.1, 2) * (random.chance(0.5) ? 1 : -1));
      }
    }
  };
  explicit FeedProblem(const Shape& shape) : FeedProblem(shape.legs, shape.turns, shape.room) {}
};

/// What is not verified of a law; limits exceeded by up to `excess` of them count as kept.
inline std::string faults(const FeedProblem& problem, const TimeLaw& law, const Limits& along, int order,
                          double excess = 0) {
  VerifierInput input{*problem.axes, problem.machine, law, problem.task->feeds, problem.task->rests};
  input.corner_angle = FeedOptions{}.corner_angle;
  input.order = order;
  input.along = along;
  Progress progress;
  std::string list;
  for (const Check& check : verify_motion(input, progress).checks)
    if (!check.passed && !(check.value <= check.limit * (1 + excess)))
      list += check_name(check) + " " + std::to_string(check.value) + " / " + std::to_string(check.limit) + " at " +
              std::to_string(check.at) + "; ";
  return list;
}

/// Planned on ever finer grids until a law is verified but for what counts as rounding, as the pipeline does.
template <class Plan>
TimeLaw verified(const FeedProblem& problem, FeedOptions options, Plan&& plan, const std::string& what) {
  const int order = speed_profile_row(options.profile).order;
  Limits along = options.path;
  if (order == 2) along.jerk = unlimited;
  for (int attempt = 1;; ++attempt, options.nodes *= 2) {
    Progress progress;
    TimeLaw law = plan(*problem.task, options, progress);
    const std::string wrong = faults(problem, law, along, order, 1e-4);
    if (wrong.empty()) return law;
    if (attempt < 4) continue;
    ADD_FAILURE() << what << ": " << wrong;
    return law;
  }
}

inline double fastest(const TimeLaw& law) {
  double most = 0;
  for (const LawPiece& piece : law.pieces()) most = std::max({most, piece.v, piece.at(piece.duration).v});
  return most;
}

}  // namespace bahnwerk::test
