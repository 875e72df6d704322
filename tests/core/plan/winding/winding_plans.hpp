#pragma once
/// How plans of such coils are made and judged.
#include <gtest/gtest.h>

#include <string>

#include "tests/core/check_names.hpp"
#include "tests/core/plan/winding/winding_requests.hpp"

namespace bahnwerk {

inline WindingPlan planned(const WindingRequest& request) {
  Progress progress;
  return plan_winding(request, progress);
}

inline void expect_verified(const WindingPlan& p, const std::string& what) {
  for (const Check& check : p.motion.verification.checks)
    EXPECT_TRUE(check.passed) << what << ": " << check_name(check) << ' ' << check.value << " against " << check.limit
                              << " at " << check.at;
  EXPECT_TRUE(p.motion.verification.passed) << what;
}
inline const Check* find(const WindingPlan& p, const std::string& name) {
  for (const Check& check : p.motion.verification.checks)
    if (check_name(check) == name) return &check;
  return nullptr;
}

}  // namespace bahnwerk
