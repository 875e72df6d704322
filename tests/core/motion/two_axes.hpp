#pragma once
/// The machine of the motion tests and their benchmark: two equal axes of a fast laser cutter.
#include "core/machine/machine.hpp"

namespace bahnwerk::testing {

inline Machine two_axes() {
  Machine m;
  m.axes = {{"x", 1800, 16000, unlimited}, {"y", 1800, 16000, unlimited}};
  return m;
}

}  // namespace bahnwerk::testing
