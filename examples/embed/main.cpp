// Plans a contour with the library and prints the first of its setpoints: no service, no JSON.
#include <bahnwerk/base/errors.hpp>
#include <bahnwerk/base/read_rows.hpp>
#include <bahnwerk/contour/builder.hpp>
#include <bahnwerk/plan/contour/contour_plan.hpp>
#include <cstdio>

using namespace bahnwerk;

int main() try {
  // A cut with a line, a quarter of a circle and a line, at most at 400 mm/s.
  ContourBuilder contour(2, {0, 0});
  contour.block(Mode::cut, 400);
  contour.line({60, 0});
  contour.arc({80, 20}, {60, 20}, true);
  contour.line({80, 60});

  // Velocity, acceleration and jerk of each axis, in mm and s; one setpoint every 4 ms.
  Machine machine;
  machine.axes = {{"x", 500, 5000, 200000}, {"y", 500, 5000, 200000}};
  machine.cycle_time = 0.004;

  ContourPlanning planning;
  planning.method = PlanningMethod::jerk_limited;

  const ContourPlan plan = plan_contour(contour.finish(), machine, planning);
  std::printf("%.3f mm in %.6f s, no motion is shorter than %.6f s; %s\n", plan.path_length, plan.duration,
              plan.bound.value, plan.verification.passed ? "verified" : "NOT verified");
  for (const Column& column : plan.setpoints->columns())
    std::printf("%s[%s] ", column.name.c_str(), column.unit.c_str());
  std::printf("\n");
  for_each_row(*plan.setpoints, [&](std::size_t k, const double* row) {
    if (k % 10 != 0) return;
    for (std::size_t i = 0; i < plan.setpoints->columns().size(); ++i) std::printf("%.3f ", row[i]);
    std::printf("\n");
  });
  return plan.verification.passed ? 0 : 1;
} catch (const PlanningError& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
