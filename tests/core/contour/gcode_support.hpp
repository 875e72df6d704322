#pragma once
// What the tests of the G-code reader share.
#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "core/base/errors.hpp"
#include "core/contour/gcode.hpp"
#include "core/geometry/curve/arc.hpp"
#include "core/machine/limits.hpp"
#include "tests/core/contour/ends_of.hpp"
#include "tests/core/contour/expect_near.hpp"

namespace bahnwerk {

inline std::vector<InputFault> gcode_faults(std::string_view text, const GcodeOptions& options = {}) {
  try {
    read_gcode(text, options);
  } catch (const InvalidInput& e) {
    return e.faults;
  }
  return {};
}

/// The lines of the faults, in order; each has the reader's place.
inline std::vector<int> fault_lines(std::string_view text, const GcodeOptions& options = {}) {
  std::vector<int> lines;
  for (const InputFault& fault : gcode_faults(text, options)) {
    EXPECT_EQ(fault.place, (std::vector<std::string>{"contour", "gcode"}));
    EXPECT_EQ(fault.message.rfind("line ", 0), 0u) << fault.message;
    lines.push_back(std::stoi(fault.message.substr(5)));
  }
  return lines;
}

inline const Arc& arc_of(const Segment& segment) {
  EXPECT_EQ(segment.curve().kind(), CurveKind::arc);
  return static_cast<const Arc&>(segment.curve());
}

/// Every segment begins where the one before ends.
inline void expect_joined(const Contour& contour) {
  for (std::size_t i = 1; i < contour.path.size(); ++i)
    expect_near(end_of(contour.path[i - 1]), begin_of(contour.path[i]), 1e-9);
}

}  // namespace bahnwerk
