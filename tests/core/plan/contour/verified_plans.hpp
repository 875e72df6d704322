#pragma once
/// Plans of contours that pass every check and keep their bound.
#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "core/plan/contour/contour_plan.hpp"
#include "tests/core/check_names.hpp"

namespace bahnwerk::test {

/// Axes that are alike, with the limits of the sources' machine and a limit of jerk, mm/s³.
inline Machine axes_alike(double jerk, std::size_t axes = 2) {
  Machine m{{}, 0.001};
  for (const char* name : {"x", "y", "z"})
    if (m.axes.size() < axes) m.axes.push_back({name, 1800, 16000, jerk});
  return m;
}

inline ContourPlan verified_plan(const Contour& contour, const Machine& machine, PlanningMethod method,
                                 double tolerance) {
  Progress progress;
  ContourPlanning planning;
  planning.method = method;
  if (tolerance > 0) planning.corner_mode = CornerMode::blend, planning.blend_tolerance = tolerance;
  ContourPlan p = plan_contour(contour, machine, planning, progress);
  EXPECT_TRUE(p.verification.passed);
  for (const Check& check : p.verification.checks)
    EXPECT_TRUE(check.passed) << check_name(check) << ' ' << check.value << " against " << check.limit << " at "
                              << check.at;
  EXPECT_GE(p.bound.gap, 0);
  return p;
}

}  // namespace bahnwerk::test
