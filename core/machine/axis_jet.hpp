#pragma once
/// The positions of all axes at one place and their derivatives by one variable (time, arc length or another).
#include <array>
#include <cstddef>

#include "core/numeric/disc.hpp"

namespace bahnwerk {

inline constexpr std::size_t max_axes = 8;

/// A number per axis; entries beyond the machine's axes are 0.
using AxisArray = std::array<double, max_axes>;

/// Positions of the axes and their first three derivatives.
struct AxisJet {
  AxisArray value{}, d1{}, d2{}, d3{};
};

/// Enclosures of the derivatives for all complex values of the variable within a disc.
struct AxisDiscs {
  std::array<Disc, max_axes> d1{}, d2{}, d3{};
};

}  // namespace bahnwerk
