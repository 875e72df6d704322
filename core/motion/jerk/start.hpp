#pragma once
/// A rough speed profile of one section, from which the interior-point method starts and by which the grid is divided.
///
/// It consists of caps from velocity, curvature and h‴ and one forward and one backward pass, in which v² grows no
/// faster than from rest with a constant jerk, v² = (9/2 J s²)^(2/3), and no faster than 2 A. It is neither optimal nor
/// feasible. O(nodes).
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/motion/grid/grid.hpp"
#include "core/motion/grid/sections.hpp"
#include "core/motion/jerk/cell.hpp"

namespace bahnwerk {

/// Limits along the path at one place.
struct PathLimits {
  double cap = unlimited;           ///< largest v², mm²/s²
  double acceleration = unlimited;  ///< acceleration along a straight line, mm/s²
  double jerk = unlimited;          ///< jerk along a straight line, mm/s³
};

/// `path` are the limits along the path, `feed` is the largest speed, mm/s.
template <int N>
PathLimits path_limits(const Station<N>& at, const Machine& machine, const Limits& path, double feed);

/// v² at every node, and the approximate duration of each cell, s (with rest at its ends allowed).
struct RoughProfile {
  LargeVector<double> b, duration;
  LargeVector<double> smooth_b;  ///< made by smooth()
  LargeVector<double> s, t;  ///< place (mm) and time (s) of each node from the section's beginning; made by smooth()
  LargeVector<double> half_window;  ///< half width of the window at each node, s; made by smooth()
};
/// `limits` are those of lanes and feeds, `path` those along the path. `node_cap` is the largest v² of each node from
/// joints and feeds, mm²/s²; it is zero at both ends.
template <int N>
void rough_profile(const Grid<N>& grid, const LaneLimits& limits, const Limits& path,
                   const LargeVector<double>& node_cap, RoughProfile& profile, ProgressScope& progress);

/// Brings a profile to rest at its end. Returns the last node whose value is unchanged, 0 if there is none. O(nodes
/// changed).
template <int N>
std::size_t brake(const Grid<N>& grid, const LaneLimits& limits, const Limits& path, RoughProfile& profile);

/// `narrowing` averages over less time where the profile has a minimum so narrow that its mean would be far too large.
enum class Smoothing { none, even, narrowing };

/// Smooths the tangent jumps of a profile, at which jerk would be far too large: `smooth_b` becomes the square of the
/// mean speed over `window` s, over less next to the section's ends. O(nodes).
template <int N>
void smooth(const Grid<N>& grid, double window, Smoothing smoothing, RoughProfile& profile, ProgressScope& progress);

extern template PathLimits path_limits<2>(const Station<2>&, const Machine&, const Limits&, double);
extern template PathLimits path_limits<3>(const Station<3>&, const Machine&, const Limits&, double);
extern template PathLimits path_limits<5>(const Station<5>&, const Machine&, const Limits&, double);
extern template PathLimits path_limits<8>(const Station<8>&, const Machine&, const Limits&, double);
extern template void rough_profile<2>(const Grid<2>&, const LaneLimits&, const Limits&, const LargeVector<double>&,
                                      RoughProfile&, ProgressScope&);
extern template void rough_profile<3>(const Grid<3>&, const LaneLimits&, const Limits&, const LargeVector<double>&,
                                      RoughProfile&, ProgressScope&);
extern template void rough_profile<5>(const Grid<5>&, const LaneLimits&, const Limits&, const LargeVector<double>&,
                                      RoughProfile&, ProgressScope&);
extern template void rough_profile<8>(const Grid<8>&, const LaneLimits&, const Limits&, const LargeVector<double>&,
                                      RoughProfile&, ProgressScope&);

extern template std::size_t brake<2>(const Grid<2>&, const LaneLimits&, const Limits&, RoughProfile&);
extern template std::size_t brake<3>(const Grid<3>&, const LaneLimits&, const Limits&, RoughProfile&);
extern template std::size_t brake<5>(const Grid<5>&, const LaneLimits&, const Limits&, RoughProfile&);
extern template std::size_t brake<8>(const Grid<8>&, const LaneLimits&, const Limits&, RoughProfile&);
extern template void smooth<2>(const Grid<2>&, double, Smoothing, RoughProfile&, ProgressScope&);
extern template void smooth<3>(const Grid<3>&, double, Smoothing, RoughProfile&, ProgressScope&);
extern template void smooth<5>(const Grid<5>&, double, Smoothing, RoughProfile&, ProgressScope&);
extern template void smooth<8>(const Grid<8>&, double, Smoothing, RoughProfile&, ProgressScope&);

}  // namespace bahnwerk
