#pragma once
/// Joint plans, what each of them has to keep, and machines to make them for.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "core/base/progress.hpp"
#include "core/numeric/peak.hpp"
#include "core/numeric/random.hpp"
#include "core/redundant/joint/joint.hpp"
#include "tests/core/redundant/coarse_fine_machines.hpp"
#include "tests/core/redundant/fine_motion.hpp"

namespace bahnwerk::test {

inline JointResult plan(const JointTask& task, const JointOptions& options = {}) {
  Progress progress;
  return found(plan_joint(task, options, progress));
}

/// Peaks between samples of every axis, found by the sweep that knows nothing of the planner; what the coarse motion
/// jumps by where its pieces meet; rest at both ends; and the sum of both axes at `samples` times.
inline void expect_valid(const JointTask& task, const JointResult& r, int samples = 500) {
  const std::size_t axes = task.machine.axes.size();
  const bool jerk = task.machine.limited_order() == 3;
  const double T = r.chosen.duration;
  const std::shared_ptr<const Motion> fine = fine_motion(r.head, *r.coarse);
  EXPECT_DOUBLE_EQ(r.head->duration(), T);
  EXPECT_DOUBLE_EQ(r.coarse->duration(), T);
  EXPECT_DOUBLE_EQ(fine->duration(), T);
  EXPECT_GE(T, r.fastest * (1 - 1e-12));
  std::vector<double> limits;
  for (const CoarseFineAxis& a : task.machine.axes)
    for (const double limit :
         {a.coarse.velocity, a.coarse.acceleration, a.stroke, a.fine.velocity, a.fine.acceleration})
      limits.push_back(limit);
  if (jerk)
    for (const CoarseFineAxis& a : task.machine.axes)
      for (const double limit : {a.coarse.jerk, a.fine.jerk}) limits.push_back(limit);
  PeakSweep sweep(limits);
  std::size_t coarse_piece = 0;
  for (std::size_t piece = 0; piece < fine->pieces(); ++piece) {
    const double begin = fine->begin(piece), end = fine->end(piece);
    if (!(end > begin)) continue;
    while (coarse_piece + 1 < r.coarse->pieces() && r.coarse->begin(coarse_piece + 1) <= begin) ++coarse_piece;
    sweep.sweep(begin, end, false, piece, [&](PeakSamples& s) {
      const auto n = static_cast<std::size_t>(s.rule.points);
      for (std::size_t i = 0; i < n; ++i) {
        const double t = s.at(static_cast<int>(i));
        const MotionState c = r.coarse->in_piece(coarse_piece, t), f = fine->in_piece(piece, t);
        for (std::size_t k = 0; k < axes; ++k) {
          const double values[] = {c[1][k], c[2][k], f[0][k], f[1][k], f[2][k]};
          for (std::size_t q = 0; q < 5; ++q) s.values[(5 * k + q) * n + i] = values[q];
          if (jerk) {
            s.values[(5 * axes + 2 * k) * n + i] = c[3][k];
            s.values[(5 * axes + 2 * k + 1) * n + i] = f[3][k];
          }
        }
      }
      return true;
    });
  }
  for (std::size_t c = 0; c < limits.size(); ++c) EXPECT_LE(sweep[c].value, limits[c] * (1 + 1e-8)) << c;

  for (std::size_t k = 0; k < axes; ++k) {
    const double scale = task.machine.axes[k].coarse.velocity;
    for (const MotionState& x : {r.coarse->in_piece(0, 0), r.coarse->final_state(), fine->in_piece(0, 0)}) {
      EXPECT_NEAR(x[1][k], 0, 1e-9 * scale);
      if (jerk) {
        EXPECT_NEAR(x[2][k], 0, 1e-7 * task.machine.axes[k].coarse.acceleration);
      }
    }
    for (std::size_t i = 1; i < r.coarse->pieces(); ++i) {
      const double t = r.coarse->begin(i);
      const MotionState a = r.coarse->in_piece(i - 1, t), b = r.coarse->in_piece(i, t);
      ASSERT_NEAR(a[0][k], b[0][k], 1e-9);
      ASSERT_NEAR(a[1][k], b[1][k], 1e-9 * scale);
      if (jerk) {
        ASSERT_NEAR(a[2][k], b[2][k], 1e-6 * task.machine.axes[k].coarse.acceleration);
      }
    }
  }
  std::size_t h = 0, c = 0, f = 0;
  for (int i = 0; i <= samples; ++i) {
    const double t = T * i / samples;
    const MotionState x = r.head->evaluate(t, h), xc = r.coarse->evaluate(t, c), xf = fine->evaluate(t, f);
    for (std::size_t k = 0; k < axes; ++k) ASSERT_NEAR(xc[0][k] + xf[0][k], x[0][k], 1e-12);
  }
}

/// ∫a² of all axes; Gauss' rule is exact for polynomials of degree 5.
inline double energy(const Motion& coarse) {
  constexpr double node[] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526};
  constexpr double weight[] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538};
  double sum = 0;
  for (std::size_t i = 0; i < coarse.pieces(); ++i) {
    const double half = 0.5 * (coarse.end(i) - coarse.begin(i)), middle = coarse.begin(i) + half;
    if (!(half > 0)) continue;
    for (std::size_t q = 0; q < 4; ++q) {
      const MotionState x = coarse.in_piece(i, middle + half * node[q]);
      for (std::size_t k = 0; k < coarse.axes(); ++k) sum += half * weight[q] * x[2][k] * x[2][k];
    }
  }
  return sum;
}

inline CoarseFineMachine random_machine(Random& random) {
  CoarseFineMachine machine;
  for (const char* name : {"x", "y"}) {
    CoarseFineAxis axis;
    axis.name = name;
    axis.coarse.velocity = std::pow(10, random.uniform(2.7, 3.5));
    axis.coarse.acceleration = std::pow(10, random.uniform(3.5, 4.5));
    axis.fine.velocity = std::pow(10, random.uniform(2.7, 3.5));
    axis.fine.acceleration = std::pow(10, random.uniform(4, 5));
    axis.stroke = std::pow(10, random.uniform(0.7, 2));
    machine.axes.push_back(axis);
  }
  return machine;
}

}  // namespace bahnwerk::test
