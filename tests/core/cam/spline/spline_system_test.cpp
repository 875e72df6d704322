#include "core/cam/spline/spline_system.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

namespace bahnwerk::cam {
namespace {

/// The standard cubic spline by its moments M_i = s''(t_i), a tridiagonal system, here dense.
struct Moments {
  std::vector<double> t, y;
  Eigen::VectorXd m;
  Moments(std::vector<double> times, std::vector<double> values, bool periodic)
      : t(std::move(times)), y(std::move(values)) {
    const int n = static_cast<int>(t.size());
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
    const auto h = [&](int i) { return t[static_cast<std::size_t>(i) + 1] - t[static_cast<std::size_t>(i)]; };
    const auto slope = [&](int i) {
      return (y[static_cast<std::size_t>(i) + 1] - y[static_cast<std::size_t>(i)]) / h(i);
    };
    for (int i = 1; i + 1 < n; ++i) {
      a(i, i - 1) = h(i - 1), a(i, i) = 2 * (h(i - 1) + h(i)), a(i, i + 1) = h(i);
      b(i) = 6 * (slope(i) - slope(i - 1));
    }
    if (periodic) {
      a(0, 0) = 1, a(0, n - 1) = -1;
      a(n - 1, n - 2) = h(n - 2), a(n - 1, n - 1) = 2 * (h(n - 2) + h(0)), a(n - 1, 1) = h(0);
      b(n - 1) = 6 * (slope(0) - slope(n - 2));
    } else {
      a(0, 0) = a(n - 1, n - 1) = 1;
    }
    m = a.partialPivLu().solve(b);
  }
  double operator()(double x) const {
    std::size_t i = 0;
    while (i + 2 < t.size() && t[i + 1] <= x) ++i;
    const double h = t[i + 1] - t[i], p = (t[i + 1] - x) / h, q = 1 - p;
    return p * y[i] + q * y[i + 1] +
           h * h / 6 * ((p * p * p - p) * m(static_cast<int>(i)) + (q * q * q - q) * m(static_cast<int>(i) + 1));
  }
};

/// 200 points at uneven times.
void expect_standard_cubic(bool periodic) {
  std::mt19937 random(200);
  std::uniform_real_distribution<double> unit(0, 1);
  SplineTask task;
  task.periodic = periodic;
  std::vector<double> values;
  for (int i = 0; i < 200; ++i) {
    task.breaks.push_back(i + 0.8 * unit(random));
    values.push_back(100 * unit(random));
    task.continuity.push_back(2);
    task.values.push_back({static_cast<std::size_t>(i), 0, values.back()});
  }
  if (periodic) {
    task.breaks.push_back(201);
    values.push_back(values.front());
  } else {
    task.values.push_back({0, 2, 0});
    task.values.push_back({199, 2, 0});
  }
  const auto found = balance_degrees(point_shares(task), sections_with_unknowns(task), 21, 4);
  ASSERT_EQ(found.degrees.size(), 1u);
  EXPECT_EQ(found.degrees[0], std::vector<int>(task.sections(), 3));
  const SolvedSpline solved = solve_spline(task, found.degrees[0]);
  ASSERT_FALSE(solved.singular);
  const CamLaw law = assemble_law(task, solved);
  const Moments standard(task.breaks, values, periodic);
  for (int k = 0; k <= 5000; ++k) {
    const double t = task.breaks.front() + (task.breaks.back() - task.breaks.front()) * k / 5001;
    EXPECT_NEAR(law.evaluate(t, 0), standard(t), 1e-10) << t;
  }
}

TEST(SplineSystem, ANaturalCubicThroughTwoHundredPointsIsTheStandardOne) { expect_standard_cubic(false); }
TEST(SplineSystem, APeriodicCubicThroughTwoHundredPointsIsTheStandardOne) { expect_standard_cubic(true); }

TEST(SplineSystem, APolynomialIsFoundWhateverItsPoints) {
  // s = t⁴ − t on [0, 2] by its values at 0, 0.3, 1, 1.7, 2 with continuity 3: degree 3 on the average does not do, so
  // derivatives are given at the ends.
  SplineTask task;
  task.breaks = {0, 0.3, 1, 1.7, 2};
  task.continuity = {0, 3, 3, 3, 0};
  const auto s = [](double t) { return t * t * t * t - t; };
  for (std::size_t i = 0; i < 5; ++i) task.values.push_back({i, 0, s(task.breaks[i])});
  task.values.push_back({0, 1, -1}), task.values.push_back({0, 2, 0});
  task.values.push_back({4, 1, 31}), task.values.push_back({4, 2, 48});
  const auto found = balance_degrees(point_shares(task), sections_with_unknowns(task), 21, 100);
  ASSERT_FALSE(found.degrees.empty());
  int solved_ones = 0;
  for (const auto& degrees : found.degrees) {
    const SolvedSpline solved = solve_spline(task, degrees);
    if (solved.singular) continue;
    ++solved_ones;
    const CamLaw law = assemble_law(task, solved);
    for (double t = 0; t < 2; t += 0.01) EXPECT_NEAR(law.evaluate(t, 0), s(t), 1e-12);
  }
  EXPECT_GT(solved_ones, 0);
}

TEST(SplineSystem, AGivenSectionPrescribesWhatItsNeighboursBeginWith) {
  SplineTask task;
  task.breaks = {0, 1, 2};
  task.continuity = {0, 2, 0};
  task.given.resize(2);
  task.given[0] = GivenSection{{0, 1}, {{0, 1, 3}}};  // velocities 2 and 4, acceleration 2
  task.values = {{2, 0, 10}};
  const auto found = balance_degrees(point_shares(task), sections_with_unknowns(task), 21, 4);
  ASSERT_EQ(found.degrees, (std::vector<std::vector<int>>{{-1, 3}}));
  const CamLaw law = assemble_law(task, solve_spline(task, found.degrees[0]));
  EXPECT_NEAR(law.in_piece(1, 0, 0), 3, 1e-14);
  EXPECT_NEAR(law.in_piece(1, 0, 1), 4, 1e-13);
  EXPECT_NEAR(law.in_piece(1, 0, 2), 2, 1e-13);
  EXPECT_NEAR(law.in_piece(1, 1, 0), 10, 1e-14);
}

}  // namespace
}  // namespace bahnwerk::cam
