#pragma once
/// What several pictures draw in the same way.
#include <cstdio>
#include <string>

#include "docs/draw/chart.hpp"

namespace bahnwerk::draw {

inline const Style blue{"#1f5fbf", 2.2, "", 1, false}, orange{"#d9730d", 2.2, "", 1, false},
    green{"#1d8a5f", 2.2, "", 1, false}, grey{"#8a919b", 1.4, "", 1, false};

/// "name 123.4 ms"
inline std::string milliseconds(const std::string& name, double duration) {
  char text[80];
  std::snprintf(text, sizeof text, "%s %.1f ms", name.c_str(), 1e3 * duration);
  return text;
}

}  // namespace bahnwerk::draw
