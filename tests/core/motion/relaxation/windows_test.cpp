// Long relaxations in windows: feasible multipliers, nearly as good as those of the whole.
#include "core/motion/relaxation/windows.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "tests/core/motion/relaxation/problems.hpp"

namespace bahnwerk {
namespace {

/// Returns the multipliers of a whole problem, window by window.
RelaxationMultipliers<2> in_windows(const RelaxationProblem<2>& problem, ProgressScope& progress) {
  const RelaxationOptions options;
  const WindowLengths lengths = RelaxationWindows<2>::lengths(options);
  RelaxationWindows<2> windows;
  RelaxationMultipliers<2> all;
  const std::size_t n = problem.cells.size();
  solve_windows(std::size_t{0}, n, [&](std::size_t begin, const std::size_t* before) {
    const auto first_of = [&](std::size_t window) { return window - std::min(window, options.beyond); };
    const Window window = lengths.at(begin, n);
    const std::size_t first = first_of(begin);
    RelaxationProblem<2> part = problem;
    part.cells.assign(problem.cells.begin() + first, problem.cells.begin() + window.end);
    part.rest_first = first == 0 && problem.rest_first, part.rest_last = window.end == n && problem.rest_last;
    part.steps.clear();
    for (RelaxationStep<2> step : problem.steps)
      if (step.cell >= first && step.cell < window.end) step.cell -= first, part.steps.push_back(step);
    if (before) windows.drop(first - first_of(*before));
    const RelaxationMultipliers<2>& found = windows.next(part, begin - first, options, progress);
    const auto put = [&](const auto& some, auto& to) {
      to.resize(first), to.insert(to.end(), some.begin(), some.end());
    };
    put(found.jerk, all.jerk), put(found.acceleration, all.acceleration);
    return window.keep;
  });
  return all;
}

TEST(RelaxationWindows, LoseNextToNothingAgainstTheWhole) {
  // Five times around, 1 000 cells each.
  auto p = test::circle(10, 1000, 400, 16000, 1e6);
  const auto once = p.cells;
  for (int i = 0; i < 4; ++i) p.cells.insert(p.cells.end(), once.begin(), once.end());
  for (const std::size_t cell : {std::size_t{700}, std::size_t{2600}}) {
    p.steps.push_back({cell, 0, {1e-4, 1e-4}, {}});
    for (std::size_t i = cell; i < cell + 40; ++i) p.cells[i].cap /= 4;  // something to slow down for
  }
  Progress silent;
  ProgressScope progress(silent, "test");
  RelaxationSolver<2> whole;
  const double optimum = whole.solve(p, {}, progress).duration;
  const auto m = in_windows(p, progress);
  ASSERT_EQ(m.jerk.size(), p.cells.size() + 2);
  ASSERT_EQ(m.acceleration.size(), p.cells.size() + 1);
  for (const auto& l : m.jerk) EXPECT_LE(p.jerk[0] * std::abs(l[0]) + p.jerk[1] * std::abs(l[1]), 1 + 1e-12);
  // The dual counts no steps: what they allow at most.
  double steps = 0;
  for (const auto& step : p.steps)
    for (std::size_t j = step.cell; j < step.cell + 3; ++j)
      for (std::size_t k = 0; k < 2; ++k) steps += p.jerk[k] * std::abs(m.jerk[j][k]) * step.time[k];
  const double dual = test::dual_of(p, m);
  EXPECT_LE(dual - steps, optimum * (1 + 1e-6));
  EXPECT_GE(dual, optimum * (1 - 1e-3));
}

TEST(RelaxationWindows, AreTheWholeForShortProblems) {
  const auto p = test::circle(10, 300, 400, 16000, 1e6);
  Progress silent;
  ProgressScope progress(silent, "test");
  RelaxationSolver<2> whole;
  whole.solve(p, {}, progress);
  EXPECT_EQ(in_windows(p, progress).jerk, whole.multipliers().jerk);
}

}  // namespace
}  // namespace bahnwerk
