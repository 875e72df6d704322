#include "core/motion/relaxation/windows.hpp"

#include <algorithm>
#include <utility>

namespace bahnwerk {

template <int N>
const RelaxationMultipliers<N>& RelaxationWindows<N>::next(const RelaxationProblem<N>& part, std::size_t begin,
                                                           const RelaxationOptions& options, ProgressScope& progress) {
  solver_.solve(part, options, progress);
  RelaxationMultipliers<N> found = solver_.multipliers();
  if (begin > 0) {
    const auto fade = [&](const auto& before, auto& after) {
      for (std::size_t j = 0; j < std::min(begin + fading / 2, before.size()); ++j) {
        const double x = (static_cast<double>(j) - static_cast<double>(begin)) / fading + 0.5,
                     share = std::clamp(x, 0.0, 1.0);
        for (std::size_t k = 0; k < N; ++k) after[j][k] = share * after[j][k] + (1 - share) * before[j][k];
      }
    };
    fade(now_.jerk, found.jerk), fade(now_.acceleration, found.acceleration);
  }
  return now_ = std::move(found);
}

template <int N>
void RelaxationWindows<N>::drop(std::size_t cells) {
  const auto count = static_cast<std::ptrdiff_t>(cells);
  now_.jerk.erase(now_.jerk.begin(), now_.jerk.begin() + count);
  now_.acceleration.erase(now_.acceleration.begin(), now_.acceleration.begin() + count);
}

template <int N>
RelaxationMultipliers<N> RelaxationWindows<N>::solve(const RelaxationProblem<N>& problem,
                                                     const RelaxationOptions& options, ProgressScope& progress) {
  const std::size_t n = problem.cells.size(), beyond = std::clamp(options.beyond, fading, window);
  RelaxationMultipliers<N> all;
  RelaxationProblem<N> part;
  part.acceleration = problem.acceleration, part.jerk = problem.jerk;
  for (std::size_t from = 0, begin = 0, end = 0; end < n; begin = end) {
    end = n - begin > window + beyond ? begin + window : n;
    const std::size_t first = begin > 0 ? begin - beyond : 0, last = end < n ? end + beyond : n;
    part.cells.assign(problem.cells.begin() + static_cast<std::ptrdiff_t>(first),
                      problem.cells.begin() + static_cast<std::ptrdiff_t>(last));
    part.rest_first = first == 0 && problem.rest_first, part.rest_last = last == n && problem.rest_last;
    const auto before = [](const RelaxationStep<N>& step, std::size_t cell) { return step.cell < cell; };
    part.steps.assign(std::lower_bound(problem.steps.begin(), problem.steps.end(), first, before),
                      std::lower_bound(problem.steps.begin(), problem.steps.end(), last, before));
    for (RelaxationStep<N>& step : part.steps) step.cell -= first;
    if (begin > 0) drop(first - from);
    from = first;
    const RelaxationMultipliers<N>& found = next(part, begin - first, options, progress);
    const auto put = [&](const auto& some, auto& to) {
      to.resize(first), to.insert(to.end(), some.begin(), some.end());
    };
    put(found.jerk, all.jerk), put(found.acceleration, all.acceleration);
  }
  return all;
}

template class RelaxationWindows<2>;
template class RelaxationWindows<3>;
template class RelaxationWindows<5>;
template class RelaxationWindows<8>;

}  // namespace bahnwerk
