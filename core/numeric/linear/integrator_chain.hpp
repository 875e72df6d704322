#pragma once
/// A chain of `order` integrators whose input is constant in each cell: order 2 has the state (position, velocity) and
/// the input acceleration, order 3 the state (position, velocity, acceleration) and the input jerk.
#include <array>
#include <cstddef>

namespace bahnwerk {

template <std::size_t order>
using ChainState = std::array<double, order>;

/// Returns the state at the end of a cell of duration h that begins with state x and has the constant input u.
template <std::size_t order>
ChainState<order> advanced(const ChainState<order>& x, double h, double u) {
  if constexpr (order == 2)
    return {x[0] + h * (x[1] + 0.5 * h * u), x[1] + h * u};
  else
    return {x[0] + h * (x[1] + h * (0.5 * x[2] + h * u / 6)), x[1] + h * (x[2] + 0.5 * h * u), x[2] + h * u};
}
/// Returns the gradient with respect to the state at the begin of a cell from the gradient g with respect to the state
/// at its end (the transpose of `advanced`).
template <std::size_t order>
ChainState<order> pulled_back(const ChainState<order>& g, double h) {
  if constexpr (order == 2)
    return {g[0], g[1] + h * g[0]};
  else
    return {g[0], g[1] + h * g[0], g[2] + h * (g[1] + 0.5 * h * g[0])};
}
/// Returns the gradient with respect to a cell's input from the gradient g with respect to the state at its end.
template <std::size_t order>
double by_control(const ChainState<order>& g, double h) {
  if constexpr (order == 2)
    return h * (g[1] + 0.5 * h * g[0]);
  else
    return h * (g[2] + h * (0.5 * g[1] + h * g[0] / 6));
}

}  // namespace bahnwerk
