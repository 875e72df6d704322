#pragma once
/// Chains of frames after Denavit and Hartenberg, written down from the source's tables: they share nothing with the
/// formulas under test.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/machine/tool.hpp"

namespace bahnwerk::test {

struct Frame {
  std::array<std::array<long double, 4>, 4> row{};
  std::array<long double, 4>& operator[](std::size_t i) { return row[i]; }
  const std::array<long double, 4>& operator[](std::size_t i) const { return row[i]; }
};

inline Frame operator*(const Frame& a, const Frame& b) {
  Frame r{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t k = 0; k < 4; ++k) r[i][j] += a[i][k] * b[k][j];
  return r;
}

/// [Herrmann (3.6)].
inline Frame joint(long double theta, long double d, long double a, long double alpha) {
  const long double c = std::cos(theta), s = std::sin(theta), ca = std::cos(alpha), sa = std::sin(alpha);
  return {{{{c, -s * ca, s * sa, a * c}, {s, c * ca, -c * sa, a * s}, {0, sa, ca, d}, {0, 0, 0, 1}}}};
}

/// Of a frame that only turns and moves.
inline Frame inverse(const Frame& f) {
  Frame r{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      r[i][j] = f[j][i];
      r[i][3] -= f[j][i] * f[j][3];
    }
  r[3][3] = 1;
  return r;
}

/// R_z(phi) R_x(theta) R_z(psi) at a position.
inline Frame euler(const ToolPose& pose, long double theta) {
  Frame f = joint(pose.phi, 0, 0, theta) * joint(pose.psi, 0, 0, 0);
  for (std::size_t i = 0; i < 3; ++i) f[i][3] = pose.position[i];
  return f;
}

inline double largest_difference(const Frame& a, const Frame& b) {
  long double most = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) most = std::max(most, std::abs(a[i][j] - b[i][j]));
  return static_cast<double>(most);
}

}  // namespace bahnwerk::test
