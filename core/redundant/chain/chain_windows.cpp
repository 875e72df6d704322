#include "core/redundant/chain/chain_windows.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "core/numeric/windows.hpp"
#include "core/redundant/chain/clusters.hpp"

namespace bahnwerk {
namespace {

constexpr double small_excess = 0.05;  // largest excess at which a larger penalty is tried
constexpr double stricter = 100;
constexpr double rounding = 1e-9;     // relative rounding of a range that ends at 0
constexpr double much_further = 1.2;  // factor of the look-ahead from which on the first window is solved again

template <std::size_t order>
Chain<order> part(const Chain<order>& whole, std::size_t first, std::size_t last) {
  const auto copy = [](const auto& from, std::size_t a, std::size_t b) {
    return std::decay_t<decltype(from)>(from.begin() + static_cast<std::ptrdiff_t>(a),
                                        from.begin() + static_cast<std::ptrdiff_t>(b));
  };
  Chain<order> chain;
  chain.steps = copy(whole.steps, first, last);
  chain.states = copy(whole.states, first, last + 1);
  chain.controls = copy(whole.controls, first, last);
  chain.energy_weight = whole.energy_weight;
  chain.begins_at_rest = first == 0 && whole.begins_at_rest;
  chain.ends_at_rest = last == whole.cells() && whole.ends_at_rest;
  return chain;
}

template <std::size_t order>
double energy_of(const Chain<order>& chain, const WindowedSolution<order>& s) {
  double energy = 0;
  for (std::size_t c = 0; c < chain.cells(); ++c)
    if constexpr (order == 2)
      energy += chain.steps[c] * s.controls[c] * s.controls[c];
    else
      energy += 0.5 * chain.steps[c] * (s.states[c][2] * s.states[c][2] + s.states[c + 1][2] * s.states[c + 1][2]);
  return energy;
}

/// Returns the time constant of a motion: the time in which the root mean square of its acceleration moves the axis by
/// one unit of length.
template <std::size_t order>
double own_time(const Chain<order>& chain, const ChainSolution<order>& s) {
  const double time = std::accumulate(chain.steps.begin(), chain.steps.end(), 0.0);
  return std::sqrt(std::sqrt(time / s.energy));
}

/// Returns the solution in which the axis stands still, if there is a position inside all boxes.
template <std::size_t order>
std::optional<WindowedSolution<order>> standing(const Chain<order>& chain) {
  if (chain.begin) return std::nullopt;
  const auto holds = [](const Range& r) { return r.lowest <= rounding && r.highest >= -rounding; };
  Range place = chain.states.front()[0];
  for (std::size_t i = 0; i <= chain.cells(); ++i) {
    place.lowest = std::max(place.lowest, chain.states[i][0].lowest);
    place.highest = std::min(place.highest, chain.states[i][0].highest);
    for (std::size_t k = 1; k < order; ++k)
      if (chain.counts(i, k) && !holds(chain.states[i][k])) return std::nullopt;
  }
  if (!(place.lowest <= place.highest) || !std::all_of(chain.controls.begin(), chain.controls.end(), holds))
    return std::nullopt;
  WindowedSolution<order> still;
  still.states.assign(chain.cells() + 1, ChainState<order>{std::isfinite(place.width()) ? place.middle() : 0});
  still.controls.assign(chain.cells(), 0);
  return still;
}

}  // namespace

template <std::size_t order>
ChainSolution<order> solve_raising_penalty(const Chain<order>& chain, ChainOptions options) {
  // If the feasible set is very small, multipliers may be above the penalty, so a little excess does not prove
  // infeasibility.
  ChainSolution<order> solution = solve(chain, options);
  if (solution.excess <= 0 || solution.excess > small_excess) return solution;
  for (const Cluster<order>& c : clusters(chain, solution, 0.0))
    if (c.certificate.value > 0) return solution;  // a proof
  options.penalty *= stricter;
  ChainSolution<order> strict = solve(chain, options);
  return strict.excess < solution.excess ? std::move(strict) : std::move(solution);
}

template <std::size_t order>
WindowedSolution<order> solve_in_windows(const Chain<order>& chain, const ChainOptions& options,
                                         const ChainWindowOptions& windows) {
  if (auto still = standing(chain)) return *std::move(still);
  const std::size_t n = chain.cells();
  WindowedSolution<order> all;
  all.states.resize(n + 1);
  all.controls.resize(n);
  double ahead = windows.ahead;
  solve_windows(std::size_t{0}, n, [&](std::size_t first, auto*) -> WindowResult<std::size_t> {
    std::size_t keep = std::min(first + windows.kept, n), last = keep;
    const auto further = [&](double time) {
      return time < windows.ahead || (time < ahead && last - keep < windows.kept);
    };
    for (double time = 0; last < n && further(time); ++last) time += chain.steps[last];
    if (n - last < windows.kept / 2) keep = last = n;  // avoids a short last window
    Chain<order> window = part(chain, first, last);
    if (first > 0) window.begin = all.states[first];
    const ChainSolution<order> s = solve_raising_penalty(window, options);
    all.iterations += static_cast<std::size_t>(s.iterations);
    const double before = std::exchange(ahead, std::max(windows.ahead, windows.own_times * own_time(window, s)));
    if (first == 0 && last < n && last - keep < windows.kept && ahead > much_further * before) return WindowRetry::same;
    std::copy_n(s.states.begin(), keep - first + 1, all.states.begin() + static_cast<std::ptrdiff_t>(first));
    std::copy_n(s.controls.begin(), keep - first, all.controls.begin() + static_cast<std::ptrdiff_t>(first));
    if (s.excess > windows.followed) {
      const std::vector<Cluster<order>> found = clusters(window, s, windows.followed);
      for (const Cluster<order>& c : found) all.exceeds.emplace_back(first + c.first, first + c.last);
      if (found.empty()) all.exceeds.emplace_back(first, last);  // it does not come to rest
    }
    return keep;
  });
  all.energy = energy_of(chain, all);
  return all;
}

template ChainSolution<2> solve_raising_penalty(const Chain<2>&, ChainOptions);
template ChainSolution<3> solve_raising_penalty(const Chain<3>&, ChainOptions);
template WindowedSolution<2> solve_in_windows(const Chain<2>&, const ChainOptions&, const ChainWindowOptions&);
template WindowedSolution<3> solve_in_windows(const Chain<3>&, const ChainOptions&, const ChainWindowOptions&);

}  // namespace bahnwerk
