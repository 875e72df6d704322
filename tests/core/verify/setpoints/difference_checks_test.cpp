// Differences of setpoints against the limits of their motion.
#include "core/verify/setpoints/difference_checks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "core/base/progress.hpp"
#include "tests/core/check_names.hpp"

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
  v.add(Check{{quantity::axis, 1, "rad", "q"}, velocity, 0, 0, true});
  v.add(Check{{quantity::axis, 2, "rad", "q"}, acceleration, 0, 0, true});
  v.add(Check{{quantity::axis, 3, "rad", "q"}, jerk, 0, 0, true});
  v.add(Check{{quantity::end_rest, 1}, 0, 0, 0, true});
  v.add(Check{{quantity::path, 1}, path, 0, 0, true});
  return v;
}
std::vector<Check> checked(const Rows& rows, const Verification& motion) {
  Progress progress;
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
    EXPECT_EQ(check_name(checks[i]), names[i]);
    EXPECT_EQ(check_unit(checks[i]), units[i]);
    EXPECT_TRUE(checks[i].passed) << check_name(checks[i]) << ' ' << checks[i].value;
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
    EXPECT_EQ(check.passed, check_name(check) == "setpoint path velocity");
}

TEST(DifferenceChecks, AStepOfTheAccelerationCountsBesideTheJerk) {
  // Passed at a jerk of 600, with a step of 0.6 in the acceleration between two rows: 600 T.
  Rows rows;
  rows.q = [](double t) { return t < 1.0005 ? 100 * t * t * t : 100 * t * t * t + 0.3 * (t - 1.0005) * (t - 1.0005); };
  rows.s = [](double t) { return t; };
  const auto checks = checked(rows, held(1e9, 1e9, 700, 2));
  EXPECT_FALSE(checks[2].passed);
  EXPECT_NEAR(checks[2].value, 600 * 1.75, 1) << "the step counts with up to 3/4";
  EXPECT_NEAR(checks[2].at, 1.0005, 0.002);
}

TEST(DifferenceChecks, AFeedMayFluctuateByItsToleranceAndRowsByTheirRounding) {
  Rows rows;
  rows.q = [](double) { return 0.0; };
  rows.s = [](double t) { return 7 * t + 1e-5 * std::sin(1000 * std::numbers::pi * t + 1); };
  const Verification motion = held(1, 1, 1, 7);
  Progress progress;
  const Machine machine{{{"q", unlimited}}, 0.001};
  DifferenceInput input{rows, machine, {180 / std::numbers::pi}, motion};
  EXPECT_FALSE(difference_checks(input, progress).at(3).passed) << "0.017 too fast";
  input.feed_tolerance = 0.002;
  EXPECT_FALSE(difference_checks(input, progress).at(3).passed);
  input.feed_tolerance = 0.003;
  const Check kept = difference_checks(input, progress).at(3);
  EXPECT_TRUE(kept.passed);
  EXPECT_NEAR(kept.limit, 7.021, 1e-12);
  // Rows off by 1e-9 deg: 8e-9 over T³ = 1e-9.
  rows.s = [](double t) { return t; };
  rows.q = [](double t) { return std::numbers::pi / 180 * 1e-9 * std::cos(1000 * std::numbers::pi * t); };
  const Verification tight = held(1, 1, 0.1, 7);
  DifferenceInput strict{rows, machine, {180 / std::numbers::pi}, tight};
  EXPECT_FALSE(difference_checks(strict, progress).at(2).passed);
  strict.rounding = 1.01e-9;
  EXPECT_TRUE(difference_checks(strict, progress).at(2).passed);
}

}  // namespace
}  // namespace bahnwerk
