#include "core/motion/jerk/start.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk {

namespace {

/// Returns the smaller one of `most` and the v² at the distance h from b, growing as from rest with constant jerk, b =
/// (9/2 J s²)^(2/3), and with at most the acceleration.
double grow(double most, double b, double h, double acceleration, double jerk) {
  most = std::min(most, b + 2 * acceleration * h);
  if (!std::isfinite(jerk)) return most;
  const double k = 4.5 * jerk, s = std::sqrt(b * std::sqrt(b) / k) + h, cube = k * s * s;  // v³
  if (cube * cube >= most * most * most) return most;
  const double v = std::cbrt(cube);
  return v * v;
}

constexpr double part = 0.7;  // used part of the limits along a straight line; bending needs the rest

/// The backward pass over one cell: v² at its left end, and its duration.
template <int N>
void backward(const Grid<N>& grid, std::size_t c, const PathLimits& right, RoughProfile& profile) {
  auto& b = profile.b;
  const double h = grid.length(c), a = part * right.acceleration, j = part * right.jerk;
  b[c] = grow(b[c], b[c + 1], h, a, j);
  const double between = grow(grow(right.cap, b[c], 0.5 * h, a, j), b[c + 1], 0.5 * h, a, j);
  const double m = std::sqrt(std::max({between, b[c], b[c + 1]}));
  profile.duration[c] = h / (m + std::sqrt(b[c])) + h / (m + std::sqrt(b[c + 1]));
}

}  // namespace

template <int N>
PathLimits path_limits(const Station<N>& at, const Machine& machine, const Limits& path, double feed) {
  PathLimits limits{std::min(feed, path.velocity), path.acceleration, path.jerk};
  limits.cap *= limits.cap;
  for (std::size_t k = 0; k < N; ++k) {
    const AxisLimits& axis = machine.axes[k];
    const double d1 = std::abs(at.d1[k]), d2 = std::abs(at.d2[k]), d3 = std::abs(at.d3[k]);
    if (d1 > 0) {
      limits.cap = std::min(limits.cap, axis.velocity * axis.velocity / (d1 * d1));
      limits.acceleration = std::min(limits.acceleration, axis.acceleration / d1);
      limits.jerk = std::min(limits.jerk, axis.jerk / d1);
    }
    if (d2 > 0) limits.cap = std::min(limits.cap, axis.acceleration / d2);
    if (d3 > 0 && std::isfinite(axis.jerk)) {
      const double cube = axis.jerk / d3;  // v³
      if (cube * cube < limits.cap * limits.cap * limits.cap) {
        const double v = std::cbrt(cube);
        limits.cap = v * v;
      }
    }
  }
  return limits;
}

template <int N>
void rough_profile(const Grid<N>& grid, const LaneLimits& limits, const Limits& path,
                   const LargeVector<double>& node_cap, RoughProfile& profile, ProgressScope& progress) {
  const std::size_t n = grid.cells.size();
  auto& b = profile.b;
  b.assign(node_cap.begin(), node_cap.end());
  profile.duration.resize(n);
  const auto limits_at = [&](const Station<N>& at, std::size_t c) {
    return path_limits<N>(at, limits.machine, path, limits.feed[grid.cells[c].segment]);
  };
  for (std::size_t c = 0; c < n; ++c) {
    progress(c, n);
    const PathLimits l = limits_at(grid.left(c), c), r = limits_at(grid.right(c), c);
    if (!grid.cells[c].cusp_left) b[c] = std::min(b[c], l.cap);
    if (!grid.cells[c].cusp_right) b[c + 1] = std::min(b[c + 1], r.cap);
    b[c + 1] = grow(b[c + 1], b[c], grid.length(c), part * l.acceleration, part * l.jerk);
  }
  for (std::size_t c = n; c-- > 0;) {
    progress(n - 1 - c, n);
    backward(grid, c, limits_at(grid.right(c), c), profile);
  }
}

template <int N>
std::size_t brake(const Grid<N>& grid, const LaneLimits& limits, const Limits& path, RoughProfile& profile) {
  std::size_t c = grid.cells.size();
  profile.b[c] = 0;
  while (c-- > 0) {
    const double before = profile.b[c];
    const double feed = limits.feed[grid.cells[c].segment];
    backward(grid, c, path_limits<N>(grid.right(c), limits.machine, path, feed), profile);
    if (profile.b[c] == before) return c;
  }
  return 0;
}

template <int N>
void smooth(const Grid<N>& grid, double window, Smoothing smoothing, RoughProfile& profile, ProgressScope& progress) {
  const bool narrowing = smoothing == Smoothing::narrowing;
  // Times v²: a narrow trough may be as narrow for a good reason, a cusp for instance. Narrow windows show less of what
  // is beside it.
  const double most = narrowing ? 8 : 4;
  constexpr double widening = 0.25;  // growth of half a window per time
  constexpr int most_halvings = 12;
  const std::size_t n = grid.cells.size();
  auto &b = profile.b, &duration = profile.duration, &smooth_b = profile.smooth_b, &s = profile.s, &t = profile.t,
       &half = profile.half_window;
  s.resize(n + 1);
  t.resize(n + 1);
  half.resize(n + 1);
  s[0] = t[0] = 0;
  for (std::size_t c = 0; c < n; ++c) {
    s[c + 1] = s[c] + grid.length(c);
    t[c + 1] = t[c] + duration[c];
  }
  /// Way at a time inside cell c: the cubic through the speeds at both ends.
  const auto way = [&](std::size_t c, double time) {
    const double T = duration[c], x = (time - t[c]) / T, h = s[c + 1] - s[c];
    const double v0 = T * std::sqrt(b[c]), v1 = T * std::sqrt(b[c + 1]);
    return s[c] + x * (v0 + x * (3 * h - 2 * v0 - v1 + x * (v0 + v1 - 2 * h)));
  };
  std::size_t from = 0, to = 0;
  /// Returns the square of the mean speed within a time w of node i. O(1) for queries in the order of nodes.
  const auto mean = [&](std::size_t i, double w) {
    while (from > 0 && t[from] > t[i] - w) --from;  // the beginning of a wider window may lie before the last one
    while (from + 1 < i && t[from + 1] <= t[i] - w) ++from;
    while (to > i && t[to] > t[i] + w) --to;
    while (to + 1 < n && t[to + 1] <= t[i] + w) ++to;
    const double v = (way(to, t[i] + w) - way(from, t[i] - w)) / (2 * w);
    return v * v;
  };
  for (std::size_t i = 0; i <= n; ++i) half[i] = std::min({0.5 * window, t[i], t[n] - t[i]});
  if (narrowing) {
    for (std::size_t i = 1; i < n; ++i) {
      progress(i, n);
      for (int k = 0; k < most_halvings && half[i] > 0 && mean(i, half[i]) > most * b[i]; ++k) half[i] *= 0.5;
    }
    for (std::size_t i = 1; i <= n; ++i) half[i] = std::min(half[i], half[i - 1] + widening * (t[i] - t[i - 1]));
    for (std::size_t i = n; i-- > 0;) half[i] = std::min(half[i], half[i + 1] + widening * (t[i + 1] - t[i]));
    from = to = 0;
  }
  smooth_b.assign(b.begin(), b.end());
  for (std::size_t i = 1; i < n; ++i) {
    progress(i, n);
    if (half[i] > 0) smooth_b[i] = std::min(mean(i, half[i]), most * b[i]);
  }
}

template PathLimits path_limits<2>(const Station<2>&, const Machine&, const Limits&, double);
template PathLimits path_limits<3>(const Station<3>&, const Machine&, const Limits&, double);
template PathLimits path_limits<5>(const Station<5>&, const Machine&, const Limits&, double);
template PathLimits path_limits<8>(const Station<8>&, const Machine&, const Limits&, double);
template void rough_profile<2>(const Grid<2>&, const LaneLimits&, const Limits&, const LargeVector<double>&,
                               RoughProfile&, ProgressScope&);
template void rough_profile<3>(const Grid<3>&, const LaneLimits&, const Limits&, const LargeVector<double>&,
                               RoughProfile&, ProgressScope&);
template void rough_profile<5>(const Grid<5>&, const LaneLimits&, const Limits&, const LargeVector<double>&,
                               RoughProfile&, ProgressScope&);
template void rough_profile<8>(const Grid<8>&, const LaneLimits&, const Limits&, const LargeVector<double>&,
                               RoughProfile&, ProgressScope&);

template std::size_t brake<2>(const Grid<2>&, const LaneLimits&, const Limits&, RoughProfile&);
template std::size_t brake<3>(const Grid<3>&, const LaneLimits&, const Limits&, RoughProfile&);
template std::size_t brake<5>(const Grid<5>&, const LaneLimits&, const Limits&, RoughProfile&);
template std::size_t brake<8>(const Grid<8>&, const LaneLimits&, const Limits&, RoughProfile&);
template void smooth<2>(const Grid<2>&, double, Smoothing, RoughProfile&, ProgressScope&);
template void smooth<3>(const Grid<3>&, double, Smoothing, RoughProfile&, ProgressScope&);
template void smooth<5>(const Grid<5>&, double, Smoothing, RoughProfile&, ProgressScope&);
template void smooth<8>(const Grid<8>&, double, Smoothing, RoughProfile&, ProgressScope&);

}  // namespace bahnwerk
