#pragma once
/// The limit of the number of setpoints of a motion.
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "core/base/errors.hpp"

namespace bahnwerk {

/// Throws InvalidInput at `place`, the document's place of the cycle time, if a motion of `duration` s would have more
/// than `most` setpoints.
inline void limit_setpoints(double duration, double cycle_time, double most, const std::vector<std::string>& place) {
  const double count = std::ceil(duration / cycle_time) + 1;
  if (!(count > most)) return;
  char text[120];
  std::snprintf(text, sizeof text, "the motion has %.0f setpoints, at most %.0f are allowed", count, most);
  throw InvalidInput(std::vector<InputFault>{{place, text}});
}

}  // namespace bahnwerk
