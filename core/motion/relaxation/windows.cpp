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

template class RelaxationWindows<2>;
template class RelaxationWindows<3>;
template class RelaxationWindows<5>;
template class RelaxationWindows<8>;

}  // namespace bahnwerk
