#pragma once
/// Position and direction of a machine's tool.
///
/// A tool has up to five coordinates: its position and two angles. A needle's are φ and ψ of Euler's Z-X-Z with the
/// middle one constant [Herrmann (3.2), (4.25)–(4.29)]: its axes are the columns of R_z(φ) R_x(−π/2) R_z(ψ), which is
/// R_z(φ ± π) R_x(π/2) R_z(ψ ± π), and it points along its x axis, (cos φ cos ψ, sin φ cos ψ, −sin ψ): φ is the
/// azimuth, ψ > 0 points down. Machines whose tool does not turn ignore the angles.
#include <array>
#include <cmath>

#include "core/geometry/curve/curve.hpp"
#include "core/numeric/disc.hpp"
#include "core/numeric/taylor.hpp"

namespace bahnwerk {

/// Position and angles of a tool.
struct ToolPose {
  Vec position;             ///< mm
  double phi = 0, psi = 0;  ///< rad
  /// Returns the direction in which a needle points, of unit length.
  Vec direction() const { return {std::cos(phi) * std::cos(psi), std::sin(phi) * std::cos(psi), -std::sin(psi)}; }
  std::array<double, 5> coordinates() const { return {position.x, position.y, position.z, phi, psi}; }
};

/// An angle and its first three derivatives.
struct AngleJet {
  double value = 0, d1 = 0, d2 = 0, d3 = 0;
};

/// A moving tool: all derivatives are by one variable.
struct ToolJet {
  Jet position;
  AngleJet phi, psi;
  ToolPose pose() const { return {position.value, phi.value, psi.value}; }
};

/// Enclosures of a coordinate and its first three derivatives in a disc of the variable.
using DiscJet = Taylor<3, Disc>;
/// Enclosures of the tool's coordinates x, y, z, φ, ψ.
using ToolDiscs = std::array<DiscJet, 5>;

}  // namespace bahnwerk
