/// Linear and quadratic programs whose optimum is known, through the driver.
#include "core/numeric/interior_point/interior_point.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/numeric/interior_point/bordered_band.hpp"
#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

InteriorPoint start_of(const BorderedBand& program) {
  InteriorPoint point;
  point.x.assign(program.cost().size(), 0);
  point.y.assign(program.equality_side().size(), 0);
  point.s.assign(program.inequality_side().size(), 1);
  point.z.assign(program.inequality_side().size(), 1);
  return point;
}

/// min w so that |x_i − data_i| ≤ w for neighbours tied by x_i = x_(i+1): the middle of the data's range.
TEST(InteriorPoint, LeastLargestDeviationFromAConstantIsHalfTheRange) {
  BorderedBand program;
  const std::size_t w = program.add_border(1);
  const std::vector<double> data{3, -1, 4, 1, -5, 9, 2, 6};
  for (std::size_t i = 0; i < data.size(); ++i) {
    if (i > 0) {
      const std::pair<std::size_t, double> terms[] = {{i - 1, 1}, {i, -1}};
      program.add_equality(terms, 0);
    }
    program.add_variables(1);
  }
  const double one[] = {1};
  for (std::size_t i = 0; i < data.size(); ++i) {
    BorderedRow row;
    row.first = i;
    row.weights = one;
    row.lower = row.upper = data[i];
    row.elastic = w;
    program.add_row(row);
  }
  InteriorPoint point = start_of(program);
  const InteriorPointResult result = solve_interior_point(program, point, {});
  EXPECT_TRUE(result.converged);
  EXPECT_LT(result.iterations, 25);
  EXPECT_NEAR(point.x[program.border_index(w)], 7, 1e-7);
  for (std::size_t i = 0; i < data.size(); ++i) EXPECT_NEAR(point.x[i], 2, 1e-7);
  const DualValue dual = dual_value(program, point.y, point.z);
  EXPECT_NEAR(dual.value, 7, 1e-6);
  for (const double residual : dual.residual) EXPECT_NEAR(residual, 0, 1e-8);
}

/// Weak duality holds for multipliers of any quality.
TEST(InteriorPoint, DualValueLessItsResidualIsBelowEveryFeasibleCost) {
  Random random(7);
  for (int k = 0; k < 50; ++k) {
    BorderedBand program;
    const std::size_t w = program.add_border(1);
    program.add_variables(3);
    std::vector<double> weights(3);
    for (int i = 0; i < 6; ++i) {
      for (double& weight : weights) weight = random.uniform(-1, 1);
      BorderedRow row;
      row.weights = weights;
      row.lower = row.upper = random.uniform(-1, 1);
      row.elastic = w;
      program.add_row(row);
    }
    InteriorPoint point = start_of(program);
    ASSERT_TRUE(solve_interior_point(program, point, {}).converged);
    const double least = point.x[program.border_index(w)];
    for (double& z : point.z) z *= random.uniform(0.5, 1.5);
    const DualValue dual = dual_value(program, point.y, point.z);
    double bound = dual.value;
    for (std::size_t i = 0; i < dual.residual.size(); ++i) bound -= std::abs(dual.residual[i]) * std::abs(point.x[i]);
    EXPECT_LE(bound, least + 1e-8);
  }
}

TEST(InteriorPoint, InfeasibleProgramsDoNotConverge) {
  BorderedBand program;
  program.add_variables(1);
  const double one[] = {1};
  BorderedRow above, below;
  above.weights = below.weights = one;
  above.lower = 1;
  below.upper = 0;
  program.add_row(above);
  program.add_row(below);
  InteriorPoint point = start_of(program);
  EXPECT_FALSE(solve_interior_point(program, point, {}).converged);
}

/// x_i ≤ high and −x_i ≤ −low for each variable, ½ Σ q_i x_i² − Σ q_i a_i x_i to minimise: the nearest point of a box.
class BoxProgram final : public InteriorPointSystem {
 public:
  BoxProgram(std::vector<double> curvature, const std::vector<double>& target, double low, double high)
      : curvature_(std::move(curvature)) {
    for (std::size_t i = 0; i < curvature_.size(); ++i) {
      cost_.push_back(-curvature_[i] * target[i]);
      side_.push_back(high);
      side_.push_back(-low);
    }
  }
  const std::vector<double>& cost() const override { return cost_; }
  const std::vector<double>& equality_side() const override { return none_; }
  const std::vector<double>& inequality_side() const override { return side_; }
  void multiply(const std::vector<double>& x, std::vector<double>& gx, std::vector<double>&) const override {
    for (std::size_t i = 0; i < x.size(); ++i) gx[2 * i] = x[i], gx[2 * i + 1] = -x[i];
  }
  void add_transposed(const std::vector<double>& z, const std::vector<double>&,
                      std::vector<double>& out) const override {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += z[2 * i] - z[2 * i + 1];
  }
  void add_quadratic(const std::vector<double>& x, std::vector<double>& out) const override {
    for (std::size_t i = 0; i < x.size(); ++i) out[i] += curvature_[i] * x[i];
  }
  bool factor(const std::vector<double>& weights) override {
    diagonal_ = curvature_;
    for (std::size_t i = 0; i < diagonal_.size(); ++i) diagonal_[i] += weights[2 * i] + weights[2 * i + 1];
    return true;
  }
  void solve(std::vector<double>& x, std::vector<double>&) const override {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] /= diagonal_[i];
  }

 private:
  std::vector<double> curvature_, cost_, side_, none_, diagonal_;
};

TEST(InteriorPoint, QuadraticProgramsEndAtTheNearestPointOfTheBox) {
  Random random(11);
  for (const bool refined : {false, true}) {
    std::vector<double> curvature, target;
    for (int i = 0; i < 30; ++i) {
      curvature.push_back(random.uniform(0.1, 10));
      target.push_back(random.uniform(-3, 3));
    }
    BoxProgram program(curvature, target, -1, 2);
    InteriorPoint point{std::vector<double>(30, 0.0), {}, std::vector<double>(60, 1.0), std::vector<double>(60, 1.0)};
    InteriorPointOptions options;
    options.common_step = true;
    options.refined = refined;
    EXPECT_TRUE(solve_interior_point(program, point, options).converged);
    // Where the target is at a side, the square root of the gap is what the place is known to.
    for (std::size_t i = 0; i < 30; ++i) EXPECT_NEAR(point.x[i], std::clamp(target[i], -1.0, 2.0), 1e-4);
  }
}

}  // namespace
}  // namespace bahnwerk
