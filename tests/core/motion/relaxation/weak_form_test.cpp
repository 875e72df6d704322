#include "core/motion/relaxation/weak_form.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace bahnwerk {
namespace {

/// A line along (0.6, 0.8) in cells of different lengths.
RelaxationProblem<2> straight(const std::vector<double>& lengths) {
  RelaxationProblem<2> problem;
  for (const double h : lengths) {
    RelaxationCell<2> cell;
    cell.length = h, cell.displacement = {0.6 * h, 0.8 * h}, cell.begin = cell.end = {0.6, 0.8}, cell.cap = 100;
    problem.cells.push_back(cell);
  }
  problem.acceleration = {10, 20}, problem.jerk = {300, 500};
  return problem;
}

const std::vector<double> lengths{1, 0.5, 2, 2, 0.25, 1};
constexpr std::size_t padding = 2;  // empty cells at each end

TEST(WeakForm, TheWeightsOfTimeSumToTheLengthOfACell) {
  WeakForm<2> form;
  form.take(straight(lengths));
  ASSERT_EQ(form.cells.size(), lengths.size() + 2 * padding);
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const auto& time = form.cells[i + padding].time;
    EXPECT_NEAR(time[0] + time[1] + time[2], lengths[i], 1e-14);
    for (const double t : time) EXPECT_GT(t, 0);
  }
  for (const double t : form.cells.front().time) EXPECT_EQ(t, 0);
}

TEST(WeakForm, TheMassOfANodeIsHalfOfBothItsCells) {
  WeakForm<2> form;
  form.take(straight(lengths));
  ASSERT_EQ(form.mass.size(), lengths.size() + 1);
  for (std::size_t i = 0; i <= lengths.size(); ++i) {
    const double before = i > 0 ? lengths[i - 1] : 0, after = i < lengths.size() ? lengths[i] : 0;
    EXPECT_NEAR(form.mass[i], (before + after) / 2, 1e-14);
  }
}

TEST(WeakForm, AtConstantSpeedOnALineNothingAccelerates) {
  RelaxationProblem<2> problem = straight(lengths);
  problem.rest_first = problem.rest_last = false;
  WeakForm<2> form;
  form.take(problem);
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t node = 0; node <= lengths.size(); ++node) {
      // A hat reaches over the cells before and behind its node.
      double sum = 0;
      if (node > 0) sum += form.cells[node - 1 + padding].acceleration[1][k];
      if (node < lengths.size()) sum += form.cells[node + padding].acceleration[0][k];
      if (node > 0 && node < lengths.size()) {
        EXPECT_NEAR(sum, 0, 1e-14) << node;
      }
    }
}

TEST(WeakForm, AStepOfSpeedIsTheAccelerationAtItsNode) {
  // b = 3 before a node, 5 behind it: ∫ hat a ds = q′ (5 − 3)/2, relative to A ∫ hat ds.
  WeakForm<2> form;
  const RelaxationProblem<2> problem = straight(lengths);
  form.take(problem);
  for (std::size_t node = 1; node < lengths.size(); ++node)
    for (std::size_t k = 0; k < 2; ++k) {
      const double sum =
          3 * form.cells[node - 1 + padding].acceleration[1][k] + 5 * form.cells[node + padding].acceleration[0][k];
      const double q1 = k == 0 ? 0.6 : 0.8, expected = q1 / (problem.acceleration[k] * form.mass[node]);
      EXPECT_NEAR(std::abs(sum), expected, 1e-13) << node;
    }
}

}  // namespace
}  // namespace bahnwerk
