#pragma once
/// What the verifier says of laws made by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "core/verify/law/verifier.hpp"
#include "tests/core/check_names.hpp"
#include "tests/core/verify/reference.hpp"

namespace bahnwerk::reference {

inline constexpr double corner_angle = 0.1 * std::numbers::pi / 180;
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

inline Verification verdict(const Contour& contour, const Machine& m, const TimeLaw& law, int order = 2) {
  Progress silent;
  return verify_motion({contour, m, law, corner_angle, order}, silent);
}
inline const Check& find(const Verification& v, const std::string& name) {
  for (const Check& c : v.checks)
    if (check_name(c) == name) return c;
  ADD_FAILURE() << "no check named " << name;
  static const Check none;
  return none;
}
/// Exactly the named checks fail.
inline void expect_failed(const Verification& v, const std::vector<std::string>& names) {
  EXPECT_EQ(v.passed, names.empty());
  for (const Check& c : v.checks) {
    const bool expected = std::find(names.begin(), names.end(), check_name(c)) != names.end();
    EXPECT_EQ(!c.passed, expected) << check_name(c) << " " << c.value << " against " << c.limit << " at " << c.at;
  }
}
inline TimeLaw edited(const TimeLaw& law, std::size_t i, const std::function<void(LawPiece&)>& edit) {
  TimeLaw other;
  for (std::size_t k = 0; k < law.pieces().size(); ++k) {
    LawPiece p = law.pieces()[k];
    if (k == i) edit(p);
    other.append(p);
  }
  return other;
}

}  // namespace bahnwerk::reference
