/// Slots as they come from drawings: coordinates rounded to a tenth of a micrometre, far from the origin, tangents
/// along the axes up to that rounding. Turning points of an axis then fall onto joints, where differences are rounding
/// and nothing else.
#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"
#include "core/numeric/random.hpp"
#include "core/plan/contour/contour_plan.hpp"

namespace bahnwerk {
namespace {

double rounded(double x) { return std::round(x * 1e7) / 1e7; }

TEST(Slots, AreVerifiedWithinTheirBound) {
  Random random(17);
  Machine machine;
  machine.axes = {{"x", 1800, 16000, unlimited}, {"y", 1800, 16000, unlimited}};
  for (int i = 0; i < 400; ++i) {
    SCOPED_TRACE(i);
    const double x = rounded(random.uniform(-2000, 2000)), y = rounded(random.uniform(-2000, 2000));
    const double r = rounded(random.uniform(0.5, 20)), length = rounded(random.uniform(1, 50));
    const double w = random.chance(0.5) ? 0 : random.uniform(-3, 3);  // upright, or turned
    const auto at = [&](double u, double v) {
      const Vec p{x + u * std::cos(w) - v * std::sin(w), y + u * std::sin(w) + v * std::cos(w), 0};
      return w == 0 ? p : Vec{rounded(p.x), rounded(p.y), 0};
    };
    ContourBuilder b(2, at(0, 0));
    b.block(Mode::cut, random.chance(0.5) ? 400 : unlimited);
    // A rounded rectangle with quarter arcs, then a slot with half circles from its start.
    b.line(at(length, 0));
    b.arc(at(length + r, r), at(length, r), true);
    b.line(at(length + r, r + length));
    b.arc(at(length, length + 2 * r), at(length, r + length), true);
    b.line(at(0, length + 2 * r));
    b.arc(at(-r, length + r), at(0, length + r), true);
    b.line(at(-r, r));
    b.arc(at(0, 0), at(0, r), true);
    b.line(at(length, 0));
    b.arc(at(length, 2 * r), at(length, r), true);
    b.line(at(-length, 2 * r));
    b.arc(at(-length, 0), at(-length, r), true);
    b.line(at(0, 0));
    Progress progress;
    ContourPlanning planning;
    planning.method = PlanningMethod::time_optimal;
    const ContourPlan plan = plan_contour(b.finish(), machine, planning, progress);
    ASSERT_TRUE(plan.verification.passed);
    ASSERT_GE(plan.bound.gap, 0);
    ASSERT_LE(plan.bound.gap, 1e-5);
  }
}

}  // namespace
}  // namespace bahnwerk
