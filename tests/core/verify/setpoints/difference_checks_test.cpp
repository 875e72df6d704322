// Differences of setpoints against the limits of their motion.
#include "core/verify/setpoints/difference_checks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

namespace bahnwerk {
namespace {

/// One axis q, shown in deg, and s, by functions of time.
class Rows final : public SetpointSource {
 public:
  std::function<double(double)> q, s;
  std::vector<Column> named{{"s", "mm"}, {"q", "deg"}};
  const std::vector<Column>& columns() const override { return named; }
  std::size_t count() const override { return 3001; }
  double cycle_time() const override { return 0.001; }
  double duration() const override { return 3; }
  void read(std::size_t first, std::size_t rows, double* out) const override {
    for (std::size_t k = first; k < first + rows; ++k) {
      const double t = static_cast<double>(k) * 0.001;
      *out++ = s(t), *out++ = 180 / std::numbers::pi * q(t);
    }
  }
};

Verification held(double velocity, double acceleration, double jerk, double path) {
  Verification v;
  v.passed = true;
  v.add({"velocity q", "rad/s", velocity, 0, 0, true});
  v.add({"acceleration q", "rad/s²", acceleration, 0, 0, true});
  v.add({"jerk q", "rad/s³", jerk, 0, 0, true});
  v.add({"end at rest", "mm/s", 0, 0, 0, true});
  v.add({"path velocity", "mm/s", path, 0, 0, true});
  return v;
}
std::vector<Check> checked(const Rows& rows, const Verification& motion) {
  SilentProgress progress;
  Machine machine{{{"q", unlimited}}, 0.001};
  return difference_checks({rows, machine, {180 / std::numbers::pi}, motion}, progress);
}

TEST(DifferenceChecks, ASineKeepsItsDerivativesPeaks) {
  Rows rows;
  const double w = 20;
  rows.q = [&](double t) { return std::sin(w * t); };
  rows.s = [](double t) { return 7 * t; };
  const auto checks = checked(rows, held(w, w * w, w * w * w, 7));
  ASSERT_EQ(checks.size(), 4u);
  const char* const names[] = {"setpoint velocity q", "setpoint acceleration q", "setpoint jerk q",
                               "setpoint path velocity"};
  const char* const units[] = {"rad/s", "rad/s²", "rad/s³", "mm/s"};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(checks[i].name, names[i]);
    EXPECT_EQ(checks[i].unit, units[i]);
    EXPECT_TRUE(checks[i].passed) << checks[i].name << ' ' << checks[i].value;
    EXPECT_NEAR(checks[i].value / checks[i].limit, 1, 2e-4);  // the mean over up to three cycles, w T = 0.02
  }
}

TEST(DifferenceChecks, OneRowThatIsOffShowsInAllOrders) {
  Rows rows;
  rows.q = [](double t) { return 0.1 * t + (std::abs(t - 2.048) < 1e-9 ? 1e-6 : 0); };  // just behind a chunk's border
  rows.s = [](double t) { return 7 * t; };
  const auto checks = checked(rows, held(0.1, 1, 1e3, 8));
  EXPECT_NEAR(checks[0].value, 0.101, 1e-9);
  EXPECT_NEAR(checks[1].value, 2, 1e-6);
  EXPECT_NEAR(checks[2].value, 3e3, 1e-2);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_FALSE(checks[i].passed);
    EXPECT_NEAR(checks[i].at, 2.048, 0.0021);
  }
  EXPECT_TRUE(checks[3].passed);
}

TEST(DifferenceChecks, MissingColumnsAndWhatIsNoNumberFail) {
  Rows rows;
  rows.q = [](double t) { return t == 1 ? std::nan("") : 0; };
  rows.s = [](double) { return 0.0; };
  const auto checks = checked(rows, held(1, 1, 1, 1));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_FALSE(checks[i].passed);
  rows.q = [](double) { return 0.0; };
  rows.named[1].name = "other";
  for (const Check& check : checked(rows, held(1, 1, 1, 1)))
    EXPECT_EQ(check.passed, check.name == "setpoint path velocity");
}

}  // namespace
}  // namespace bahnwerk
