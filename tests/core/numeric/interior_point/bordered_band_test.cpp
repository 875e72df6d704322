/// The factors of banded, bordered systems against the system itself, multiplied out.
#include "core/numeric/interior_point/bordered_band.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

/// Blocks of four variables, joined by equalities, three shared variables, one equality from end to end.
BorderedBand random_program(Random& random, std::size_t blocks) {
  BorderedBand program;
  for (int k = 0; k < 3; ++k) program.add_border(1);
  for (std::size_t block = 0; block < blocks; ++block) {
    if (block > 0) {
      const std::pair<std::size_t, double> terms[] = {{4 * block - 1, random.uniform(1, 2)}, {4 * block, -1}};
      const BorderedRow::Term shared[] = {{1, random.uniform(-1, 1)}};
      program.add_equality(terms, random.uniform(-1, 1), shared);
    }
    program.add_variables(4);
  }
  const std::pair<std::size_t, double> ends[] = {{0, 1}, {4 * blocks - 1, -1}};
  program.add_far_equality(ends, 0.5);
  std::vector<double> weights(4);
  for (std::size_t block = 0; block < blocks; ++block)
    for (int i = 0; i < 7; ++i) {
      for (double& weight : weights) weight = random.uniform(-1, 1);
      BorderedRow row;
      row.first = 4 * block;
      row.weights = weights;
      row.upper = 1;
      if (i % 2 == 0) row.lower = -1;
      if (i % 3 == 0) row.elastic = static_cast<std::size_t>(i) % 3;
      const BorderedRow::Term shared[] = {{2, random.uniform(-1, 1)}};
      if (i % 3 == 1) row.border = shared;
      program.add_row(row);
    }
  return program;
}

TEST(BorderedBand, SolutionsSatisfyTheSystem) {
  Random random(3);
  for (const std::size_t blocks : {std::size_t{2}, std::size_t{9}}) {
    BorderedBand program = random_program(random, blocks);
    const std::size_t variables = program.cost().size(), equalities = program.equality_side().size();
    std::vector<double> weights(program.inequality_side().size());
    for (double& weight : weights) weight = std::pow(10, random.uniform(-2, 2));
    ASSERT_TRUE(program.factor(weights));
    std::vector<double> x(variables), y(equalities);
    for (double& value : x) value = random.uniform(-1, 1);
    for (double& value : y) value = random.uniform(-1, 1);
    const std::vector<double> right_x = x, right_y = y;
    solve_refined(program, weights, x, y);
    std::vector<double> gx(weights.size()), ex(equalities), back(variables);
    program.multiply(x, gx, ex);
    for (std::size_t i = 0; i < gx.size(); ++i) gx[i] *= weights[i];
    program.add_transposed(gx, y, back);
    for (std::size_t i = 0; i < variables; ++i) EXPECT_NEAR(back[i], right_x[i], 1e-9);
    for (std::size_t i = 0; i < equalities; ++i) EXPECT_NEAR(ex[i], right_y[i], 1e-9);
  }
}

/// ⟨Gx, z⟩ + ⟨Ex, y⟩ = ⟨x, Gᵀz + Eᵀy⟩.
TEST(BorderedBand, TransposedIsTheAdjoint) {
  Random random(5);
  const BorderedBand program = random_program(random, 4);
  std::vector<double> x(program.cost().size()), z(program.inequality_side().size()), y(program.equality_side().size());
  for (auto* all : {&x, &z, &y})
    for (double& value : *all) value = random.uniform(-1, 1);
  std::vector<double> gx(z.size()), ex(y.size()), back(x.size());
  program.multiply(x, gx, ex);
  program.add_transposed(z, y, back);
  double left = 0, right = 0;
  for (std::size_t i = 0; i < z.size(); ++i) left += gx[i] * z[i];
  for (std::size_t i = 0; i < y.size(); ++i) left += ex[i] * y[i];
  for (std::size_t i = 0; i < x.size(); ++i) right += back[i] * x[i];
  EXPECT_NEAR(left, right, 1e-12 * (1 + std::abs(left)));
}

TEST(BorderedBand, SquaresAreTheObjectiveOfAQuadraticProgram) {
  // ½ (x² + 4 y²) with x + y = 5 and x ≤ 3.5: x = 4 and y = 1 without the row.
  for (const double most : {10.0, 3.5}) {
    BorderedBand program;
    program.add_variables(2);
    const std::pair<std::size_t, double> sum[] = {{0, 1}, {1, 1}};
    program.add_equality(sum, 5);
    const double one[] = {1}, two[] = {2};
    program.add_square(0, one);
    program.add_square(1, two);
    BorderedRow row;
    row.weights = one;
    row.upper = most;
    program.add_row(row);
    InteriorPoint point{{0, 0}, {0}, {1}, {1}};
    InteriorPointOptions options;
    options.common_step = true;
    EXPECT_TRUE(solve_interior_point(program, point, options).converged);
    EXPECT_NEAR(point.x[0], std::min(4.0, most), 1e-6);
    EXPECT_NEAR(point.x[0] + point.x[1], 5, 1e-9);
  }
}

}  // namespace
}  // namespace bahnwerk
