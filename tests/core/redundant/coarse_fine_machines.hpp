#pragma once
/// The machines of [Bock Table 2.1], and contours for them.
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/contour/builder.hpp"
#include "core/contour/contour.hpp"
#include "core/numeric/random.hpp"
#include "core/redundant/joint/joint.hpp"
#include "core/redundant/redundancy.hpp"

namespace bahnwerk::test {

/// Returns the plan; a test whose planner has none ends.
template <typename Plan>
Plan found(Expected<Plan, NoPlan> plan) {
  if (!plan) throw std::logic_error("no plan, reason " + std::to_string(static_cast<int>(plan.reason())));
  return *std::move(plan);
}

inline CoarseFineMachine md1() {
  return {{{"x", {1600, 8000}, {2500, 60000}, 45}, {"y", {1600, 8000}, {2500, 60000}, 45}}, 0.001};
}
inline CoarseFineMachine md2() {
  return {{{"x", {1800, 16000}, {2000, 60000}, 20}, {"y", {1800, 16000}, {2000, 60000}, 20}}, 0.001};
}

inline JointTask joint_task(Contour contour, CoarseFineMachine machine) {
  const auto kept = std::make_shared<const Contour>(std::move(contour));
  return {contour_axes(kept, machine.axes.size()), std::move(machine), kept->feeds(), kept->rest_places(), kept->rests};
}

inline RedundancyTask redundancy_task(Contour contour, CoarseFineMachine machine) {
  const auto kept = std::make_shared<const Contour>(std::move(contour));
  return {contour_axes(kept, machine.axes.size()),
          kept,
          std::move(machine),
          kept->feeds(),
          kept->rest_places(),
          kept->rests};
}

/// One straight move.
inline Contour straight(double dx, double dy, double feed = unlimited) {
  ContourBuilder b(2, {0, 0, 0});
  b.block(Mode::position, feed);
  b.line({dx, dy, 0});
  return b.finish();
}

/// Round holes of that radius in a square grid, cut at 400 mm/s.
inline Contour holes(int columns, int rows, double pitch, double radius) {
  ContourBuilder b(2, {0, 0, 0});
  for (int j = 0; j < rows; ++j)
    for (int k = 0; k < columns; ++k) {
      const int i = j % 2 == 0 ? k : columns - 1 - k;
      const Vec centre{i * pitch + 1, j * pitch + 1, 0}, start{centre.x + radius, centre.y, 0};
      b.block(Mode::position, unlimited);
      b.line(start);
      b.block(Mode::cut, 400);
      b.arc(start, centre, true);
    }
  return b.finish();
}

/// Limits of jerk, of so many 1/s times the accelerations.
inline CoarseFineMachine with_jerk(CoarseFineMachine machine, double per_second) {
  for (CoarseFineAxis& axis : machine.axes)
    for (Limits* stage : {&axis.coarse, &axis.fine}) stage->jerk = per_second * stage->acceleration;
  return machine;
}

/// A slot whose sides are tangents of its round ends: curvature jumps at them.
inline Contour slot(double length, double radius, double feed) {
  ContourBuilder b(2, {0, 0, 0});
  b.block(Mode::cut, feed);
  b.line({length, 0, 0});
  b.arc({length, 2 * radius, 0}, {length, radius, 0}, true);
  b.line({0, 2 * radius, 0});
  b.arc({0, 0, 0}, {0, radius, 0}, true);
  return b.finish();
}

/// A closed cardinal spline through points at those distances of its centre, as cubic pieces.
inline Contour free_shape(const std::vector<double>& radii, double feed) {
  const auto n = static_cast<int>(radii.size());
  const auto point = [&](int k) {
    const auto i = static_cast<std::size_t>((k + n) % n);
    const double angle = 2 * 3.14159265358979323846 * static_cast<double>(i) / n;
    return Vec{radii[i] * std::cos(angle), radii[i] * std::sin(angle), 0};
  };
  ContourBuilder b(2, point(0));
  b.block(Mode::cut, feed);
  for (int k = 0; k < n; ++k) {
    const Vec p = point(k), q = point(k + 1), v = 0.5 * (q - point(k - 1)), w = 0.5 * (point(k + 2) - p);
    const Vec c = 3.0 * (q - p) - 2.0 * v - w, d = 2.0 * (p - q) + v + w;
    b.polynomial({{p.x, v.x, c.x, d.x}, {p.y, v.y, c.y, d.y}});
  }
  return b.finish();
}

/// Positioning moves of up to `longest` mm and circles of any size, 3 to 10 of each, some with a dwell.
inline Contour random_contour(Random& random, double longest, int least = 3, unsigned more = 8) {
  ContourBuilder b(2, {0, 0, 0});
  for (int i = 0, n = least + static_cast<int>(random.below(more)); i < n; ++i) {
    b.block(Mode::position, unlimited);
    const Vec at = b.position();
    const double angle = random.uniform(0, 6.28), way = longest * std::pow(10, random.uniform(-2, 0));
    b.line({at.x + way * std::cos(angle), at.y + way * std::sin(angle), 0});
    b.block(Mode::cut, random.uniform(50, 500));
    const Vec from = b.position();
    const double radius = std::pow(10, random.uniform(-0.5, 1.7)), turn = random.uniform(0, 6.28);
    b.arc(from, {from.x + radius * std::cos(turn), from.y + radius * std::sin(turn), 0}, random.below(2) == 0);
    if (random.below(4) == 0) b.dwell(random.uniform(0, 0.2));
  }
  return b.finish();
}

}  // namespace bahnwerk::test
