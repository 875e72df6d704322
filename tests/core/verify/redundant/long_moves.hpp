#pragma once
/// Long moves of a head on coarse and fine axes.
#include <cmath>
#include <vector>

#include "core/contour/builder.hpp"
#include "core/machine/machine.hpp"

namespace bahnwerk::test {

inline const std::vector<AxisLimits> coarse{{"xc", 1800, 16000}, {"yc", 1800, 16000}};

inline std::vector<AxisLimits> fine(double stroke) {
  std::vector<AxisLimits> axes{{"xf", 2000, 60000}, {"yf", 2000, 60000}};
  for (AxisLimits& axis : axes) axis.lowest = -stroke, axis.highest = stroke;
  return axes;
}

/// Both together.
inline const Machine head{{{"x", 3800, 76000}, {"y", 3800, 76000}}};

inline Contour moves(const std::vector<Vec>& to, double dwell = 0) {
  ContourBuilder b(2, {0, 0, 0});
  for (const Vec& v : to) {
    b.block(Mode::position, unlimited);
    b.line(v);
    if (dwell > 0) b.dwell(dwell);
  }
  return b.finish();
}

/// What the coarse axis takes from rest to rest over a way.
inline double least(double way) {
  return way < 1800 * 1800 / 16000.0 ? 2 * std::sqrt(way / 16000) : way / 1800 + 1800 / 16000.0;
}

}  // namespace bahnwerk::test
