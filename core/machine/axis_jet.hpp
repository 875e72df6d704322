#pragma once
/// The positions of all axes at one place and their derivatives by whatever the axes are followed along.
#include <array>
#include <cstddef>

namespace bahnwerk {

inline constexpr std::size_t max_axes = 8;

/// One number per axis; those beyond the machine's are 0.
using AxisArray = std::array<double, max_axes>;

struct AxisJet {
  AxisArray value{}, d1{}, d2{}, d3{};
};

}  // namespace bahnwerk
