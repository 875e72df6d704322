#include "core/motion/relaxation/windows.hpp"

#include <algorithm>

namespace bahnwerk {
namespace {

// Cells: of a window, and in which two windows fade over.
constexpr std::size_t window = 1200, fading = 100;

}  // namespace

template <int N>
RelaxationMultipliers<N> RelaxationWindows<N>::solve(const RelaxationProblem<N>& problem,
                                                     const RelaxationOptions& options, ProgressScope& pulse) {
  const std::size_t n = problem.cells.size(), beyond = std::min(options.beyond, window),
                    windows = std::max<std::size_t>(1, n / window);
  if (windows == 1) {
    solver_.solve(problem, options, pulse);
    return solver_.multipliers();
  }
  RelaxationMultipliers<N> all;
  all.jerk.resize(n + 2), all.acceleration.resize(n + 1);
  part_.acceleration = problem.acceleration, part_.jerk = problem.jerk;
  for (std::size_t i = 0; i < windows; ++i) {
    const bool first = i == 0, last = i + 1 == windows;
    const std::size_t begin = first ? 0 : i * n / windows, end = last ? n : (i + 1) * n / windows;
    const std::size_t from = first ? 0 : begin - beyond, to = last ? n : end + beyond;
    part_.cells.assign(problem.cells.begin() + static_cast<std::ptrdiff_t>(from),
                       problem.cells.begin() + static_cast<std::ptrdiff_t>(to));
    part_.rest_first = first && problem.rest_first, part_.rest_last = last && problem.rest_last;
    const auto before = [](const RelaxationStep<N>& step, std::size_t cell) { return step.cell < cell; };
    part_.steps.assign(std::lower_bound(problem.steps.begin(), problem.steps.end(), from, before),
                       std::lower_bound(problem.steps.begin(), problem.steps.end(), to, before));
    for (RelaxationStep<N>& step : part_.steps) step.cell -= from;
    solver_.solve(part_, options, pulse);
    const RelaxationMultipliers<N> found = solver_.multipliers();
    // The share of this window at a place, in cells.
    const auto share = [&](std::size_t place) {
      const auto rise = [&](std::size_t border) {
        const double x = (static_cast<double>(place) - static_cast<double>(border)) / fading + 0.5;
        return std::clamp(x, 0.0, 1.0);
      };
      return (first ? 1 : rise(begin)) - (last ? 0 : rise(end));
    };
    const auto add = [&](const std::vector<std::array<double, N>>& part, std::vector<std::array<double, N>>& to_all) {
      for (std::size_t j = 0; j < part.size(); ++j)
        for (std::size_t k = 0; k < N; ++k) to_all[from + j][k] += share(from + j) * part[j][k];
    };
    add(found.jerk, all.jerk), add(found.acceleration, all.acceleration);
  }
  return all;
}

template class RelaxationWindows<2>;
template class RelaxationWindows<3>;
template class RelaxationWindows<5>;
template class RelaxationWindows<8>;

}  // namespace bahnwerk
