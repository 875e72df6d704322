/// Durations that are known exactly or from an independent fine computation (tests/core/motion/reference/circle.py).
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"
#include "core/plan/contour/contour_plan.hpp"
#include "tests/core/check_names.hpp"
#include "tests/source.hpp"

namespace bahnwerk {
namespace {

Machine machine(double velocity, double acceleration, std::size_t dimension = 2) {
  Machine m;
  for (const char* name : {"x", "y", "z"})
    if (m.axes.size() < dimension) m.axes.push_back({name, velocity, acceleration, unlimited});
  return m;
}

ContourPlan plan(Contour contour, const Machine& m, PlanningMethod method = PlanningMethod::time_optimal) {
  Progress progress;
  ContourPlanning planning;
  planning.method = method;
  return plan_contour(std::move(contour), m, planning, progress);
}

double peak(const ContourPlan& p, const std::string& name) {
  for (const Check& c : p.verification.checks)
    if (check_name(c).find(name) != std::string::npos) return c.value;
  return -1;
}

Contour line(double length, double feed = unlimited) {
  ContourBuilder b(2, {});
  b.block(Mode::cut, feed);
  b.line({length, 0, 0});
  return b.finish();
}

TEST(ClosedForm, LineIsATrapezoid) {
  // 100 mm at V = 1800, A = 16000: the peak √(A·100) = 1264.9 stays below V: a triangle, T = 2 √(100/A).
  const ContourPlan p = plan(line(100), machine(1800, 16000));
  EXPECT_NEAR(p.duration, 2 * std::sqrt(100.0 / 16000), 1e-9 * p.duration);
  EXPECT_TRUE(p.verification.passed);
  EXPECT_GE(p.bound.gap, 0);
  EXPECT_LT(p.bound.gap, 1e-9);
  // 1000 mm reach V: T = L/V + V/A.
  const ContourPlan q = plan(line(1000), machine(1800, 16000));
  EXPECT_NEAR(q.duration, 1000.0 / 1800 + 1800.0 / 16000, 1e-9 * q.duration);
  const ContourPlan f = plan(line(100, 400), machine(1800, 16000));
  EXPECT_NEAR(f.duration, 100.0 / 400 + 400.0 / 16000, 1e-9 * f.duration);
  EXPECT_EQ(f.pieces, 3u);
}

TEST(ClosedForm, MicrometreMoveAndFeedChange) {
  const ContourPlan tiny = plan(line(1e-3), machine(1800, 16000));
  EXPECT_NEAR(tiny.duration, 2 * std::sqrt(1e-3 / 16000), 1e-9 * tiny.duration);
  EXPECT_TRUE(tiny.verification.passed);
  ContourBuilder b(2, {});
  b.block(Mode::cut, 400);
  b.line({100, 0, 0});
  b.block(Mode::position, 200);
  b.line({200, 0, 0});
  const ContourPlan p = plan(b.finish(), machine(1800, 16000));
  const double A = 16000;  // brake from 400 to 200 before the joint
  const double expected = 400 / A + (100 - 400 * 400 / (2 * A) - (400 * 400 - 200 * 200) / (2 * A)) / 400 + 200 / A +
                          (100 - 200 * 200 / (2 * A)) / 200 + 200 / A;
  EXPECT_NEAR(p.duration, expected, 1e-9 * expected);
  EXPECT_NEAR(p.cut_time + p.position_time, p.duration, 1e-12);
}

TEST(ClosedForm, FullReversalStops) {
  ContourBuilder b(2, {});
  b.line({10, 0, 0});
  b.line({0, 0, 0});
  const ContourPlan p = plan(b.finish(), machine(1800, 16000));
  EXPECT_NEAR(p.duration, 4 * std::sqrt(10.0 / 16000), 1e-9 * p.duration);
}

TEST(ClosedForm, DiagonalUsesBothAxes) {
  ContourBuilder b(3, {});
  b.line({60, 80, 0});
  const ContourPlan p = plan(b.finish(), machine(1800, 16000, 3));
  EXPECT_NEAR(p.duration, 2 * std::sqrt(80.0 / 16000), 1e-9 * p.duration);  // y is the slower one
}

Contour circle(double radius, double run_in, double feed) {
  ContourBuilder b(2, {});
  b.block(Mode::cut, feed);
  b.line({run_in, 0, 0});
  b.arc({run_in, 0, 0}, {run_in, radius, 0}, true);
  b.line({2 * run_in, 0, 0});
  return b.finish();
}

TEST(Reference, CircleBetweenTwoLines) {
  std::ifstream file(test::source("tests/core/motion/reference/circle.csv"));
  std::string row;
  ASSERT_TRUE(std::getline(file, row));
  int rows = 0;
  while (std::getline(file, row)) {
    std::replace(row.begin(), row.end(), ',', ' ');
    std::istringstream in(row);
    double radius, run_in, V, A, feed, duration;
    in >> radius >> run_in >> V >> A >> feed >> duration;
    SCOPED_TRACE(row);
    const double f = feed > 0 ? feed : unlimited;
    const ContourPlan p = plan(circle(radius, run_in, f), machine(V, A));
    EXPECT_NEAR(p.duration, duration, 1e-6 * duration);
    EXPECT_TRUE(p.verification.passed);
    EXPECT_GE(p.bound.gap, 0);
    EXPECT_LE(p.bound.gap, 1e-5);
    EXPECT_LE(peak(p, "acceleration x"), A * (1 + 1e-9));
    EXPECT_GE(peak(p, "acceleration x"), A * 0.99);  // sampled law: slowed by less than a cycle
    if (feed > 0) {
      EXPECT_LE(peak(p, "path velocity"), feed * (1 + 1e-9));
    }
    ++rows;
  }
  EXPECT_EQ(rows, 4);
}

TEST(Reference, CircleReachesItsSpeedLimitAndNeverPassesIt) {
  // With a reserve K_b the circle's limit is √(K_b A r) where an axis points along the radius.
  Progress progress;
  ContourPlanning planning;
  planning.braking_reserve = 0.7;
  const Machine m = machine(1800, 16000);
  const ContourPlan p = plan_contour(circle(10, 100, unlimited), m, planning, progress);
  EXPECT_TRUE(p.verification.passed);
  const auto& columns = p.setpoints->columns();
  std::vector<double> rows(p.setpoints->count() * columns.size());
  p.setpoints->read(0, p.setpoints->count(), rows.data());
  double slowest = 1e9;
  const double limit = std::sqrt(0.7 * 16000 * 10), factor = p.setpoints->duration() / p.duration;
  for (std::size_t i = 0; i < p.setpoints->count(); ++i) {
    const double s = rows[i * columns.size() + 6], v = rows[i * columns.size() + 7] * factor;
    const double w = (s - 100) / 10;
    if (w < 0 || w > 2 * M_PI) continue;
    slowest = std::min(slowest, v);
    const double largest = std::max(std::abs(std::sin(w)), std::abs(std::cos(w)));
    EXPECT_LE(v * v, limit * limit / largest * (1 + 1e-4)) << w;
  }
  EXPECT_NEAR(slowest, limit, 0.02 * limit);
}

}  // namespace
}  // namespace bahnwerk
