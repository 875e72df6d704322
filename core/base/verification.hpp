#pragma once
/// What every plan says about itself: the checks of the independent verifier and the proven lower bound.
#include <string>
#include <utility>
#include <vector>

namespace bahnwerk {

/// One line of the verifier's verdict: the true continuous peak `value` at `at` seconds against `limit`.
struct Check {
  std::string name;
  std::string unit;
  double limit = 0;
  double value = 0;
  double at = 0;
  bool passed = false;
};

/// A limit is exceeded at `at` seconds: motion that lasts `factor` times as long keeps it.
struct TooFast {
  double at = 0;
  double factor = 1;
};

struct Verification {
  bool passed = false;
  std::vector<Check> checks;
  /// Where axes exceed their limits: once, by the most strained axis, of every motion between two rests.
  std::vector<TooFast> too_fast;
  /// One more check, behind those that there are.
  void add(Check check) {
    passed = passed && check.passed;
    checks.push_back(std::move(check));
  }
};

/// No motion under the same limits is shorter than `duration` (s). gap = planned / duration − 1.
struct Bound {
  double duration = 0;
  double gap = 0;
  std::string basis;
};

}  // namespace bahnwerk
