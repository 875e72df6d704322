#pragma once
/// An axis path as planners evaluate it: N lanes, where N is 2, 3, 5 or 8 (with_lanes() below).
///
/// Lanes beyond the path's axes, and lanes of axes that stand still but for rounding, repeat the first moving axis with
/// its limits, which changes nothing. Axes through kinematics have any units: they and their limits are scaled so that
/// no |q′| exceeds 1, which does not change the set of allowed motions. Cartesian axes need no scaling and stay
/// unchanged to the last bit.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/machine/machine.hpp"
#include "core/motion/axes/axis_path.hpp"
#include "core/numeric/lanes.hpp"

namespace bahnwerk {

/// A node seen from one side: path length from the beginning of its segment (short differences stay exact on long
/// paths), curve parameter, and the lanes' derivatives by path length.
template <int N>
struct Station {
  double s = 0, u = 0;
  Lanes<N> d1{}, d2{}, d3{};
};

/// An axis path with N lanes.
template <int N>
class LanePath {
 public:
  /// `path` outlives it. O(panels) for axes through kinematics, else O(1).
  explicit LanePath(const AxisPath& path);

  std::size_t size() const { return path_.size(); }
  double length() const { return path_.length(); }
  const Segment& operator[](std::size_t i) const { return path_[i]; }
  const Path& tool() const { return path_.tool(); }
  const AxisPath& axes() const { return path_; }
  bool linear(std::size_t segment) const { return path_.linear(segment); }
  bool cartesian() const { return path_.cartesian(); }

  Station<N> at(std::size_t segment, double u) const;
  /// Returns the station without `s`, which takes an integral along free-form curves.
  Station<N> derivatives(std::size_t segment, double u) const;
  void at_parameters(std::size_t segment, PathBatch& batch) const { path_.at_parameters(segment, batch); }
  /// Returns point i of a batch.
  Station<N> station(const PathBatch& batch, std::size_t i) const;

  /// Returns the limits of the lanes; names are those of the axes.
  Machine limits(const Machine& machine) const;

 private:
  std::size_t axis(std::size_t lane) const { return axis_[lane]; }
  Lanes<N> lanes(const std::array<PathBatch::Row, max_axes>& rows, std::size_t i, bool planar) const;
  Lanes<N> lanes(const AxisArray& values) const;

  const AxisPath& path_;
  Lanes<N> scale_;
  std::array<std::size_t, N> axis_{};
};

template <int N>
LanePath<N>::LanePath(const AxisPath& path) : path_(path) {
  for (std::size_t k = 0; k < N; ++k) scale_[k] = 1, axis_[k] = k < path.axes() ? k : 0;
  if (path.cartesian()) return;
  constexpr double margin = 1.1;  // panels are samples
  const AxisArray most = largest_rates(path);
  std::size_t moving = 0;
  while (moving + 1 < path.axes() && most[moving] == 0) ++moving;
  for (std::size_t k = 0; k < N; ++k) {
    if (k >= path.axes() || most[k] == 0) axis_[k] = moving;
    if (most[axis(k)] > 0) scale_[k] = 1 / (margin * most[axis(k)]);
  }
}

template <int N>
Lanes<N> LanePath<N>::lanes(const std::array<PathBatch::Row, max_axes>& rows, std::size_t i, bool planar) const {
  if constexpr (N == 2)
    if (path_.cartesian() && path_.axes() == 2) return Lanes<2>{rows[0][i], rows[1][i]};
  if constexpr (N == 3)
    if (path_.cartesian() && path_.axes() == 3) return Lanes<3>{rows[0][i], rows[1][i], planar ? 0 : rows[2][i]};
  Lanes<N> r{};
  for (std::size_t k = 0; k < N; ++k) r[k] = planar && axis(k) == 2 ? 0 : scale_[k] * rows[axis(k)][i];
  return r;
}

template <int N>
Lanes<N> LanePath<N>::lanes(const AxisArray& values) const {
  Lanes<N> r{};
  for (std::size_t k = 0; k < N; ++k) r[k] = scale_[k] * values[axis(k)];
  return r;
}

template <int N>
Station<N> LanePath<N>::derivatives(std::size_t segment, double u) const {
  if constexpr (N < 8)
    if (path_.cartesian() && path_.axes() == N) {  // the path's own derivatives, without a conversion from eight axes
      const PathPoint p = path_[segment].at_parameter(u);
      Station<N> station;
      station.u = u;
      for (std::size_t k = 0; k < N; ++k) station.d1[k] = p.d1[k], station.d2[k] = p.d2[k], station.d3[k] = p.d3[k];
      return station;
    }
  const AxisJet q = path_.at_parameter(segment, u);
  return {0, u, lanes(q.d1), lanes(q.d2), lanes(q.d3)};
}

template <int N>
Station<N> LanePath<N>::at(std::size_t segment, double u) const {
  Station<N> station = derivatives(segment, u);
  station.s = path_[segment].travelled(u);
  return station;
}

template <int N>
Station<N> LanePath<N>::station(const PathBatch& batch, std::size_t i) const {
  return {batch.s[i], batch.u[i], lanes(batch.d1, i, batch.planar), lanes(batch.d2, i, batch.planar),
          lanes(batch.d3, i, batch.planar)};
}

template <int N>
Machine LanePath<N>::limits(const Machine& machine) const {
  Machine scaled = machine;
  scaled.axes.resize(N);
  for (std::size_t k = 0; k < N; ++k) {
    AxisLimits& lane = scaled.axes[k] = machine.axes[axis(k)];
    lane.velocity *= scale_[k];
    lane.acceleration *= scale_[k];
    lane.jerk *= scale_[k];
  }
  return scaled;
}

/// Calls plan(std::integral_constant<int, N>) with the least N that holds a path of so many axes.
template <class Plan>
auto with_lanes(std::size_t axes, Plan&& plan) {
  if (axes <= 2) return plan(std::integral_constant<int, 2>{});
  if (axes == 3) return plan(std::integral_constant<int, 3>{});
  if (axes <= 5) return plan(std::integral_constant<int, 5>{});
  return plan(std::integral_constant<int, 8>{});
}

}  // namespace bahnwerk
