// Rows of a cam's motion: they pass as they are, and each thing changed in them fails the check that names it.
#include "core/verify/setpoints/motion_setpoint_checks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/base/progress.hpp"
#include "core/motion/axes/spline_motion.hpp"
#include "core/motion/setpoints/motion_setpoints.hpp"
#include "tests/core/check_names.hpp"

namespace bahnwerk {
namespace {

struct Edited final : SetpointSource {
  explicit Edited(const SetpointSource& source) : source_(source), columns_(source.columns()) {}
  const std::vector<Column>& columns() const override { return columns_; }
  std::size_t count() const override { return source_.count() + more; }
  double cycle_time() const override { return source_.cycle_time(); }
  double duration() const override { return source_.duration(); }
  void read(std::size_t first, std::size_t rows, double* out) const override {
    for (std::size_t k = first; k < first + rows; ++k, out += columns_.size()) {
      source_.read(std::min(k, source_.count() - 1), 1, out);
      if (edit) edit(k, out);
    }
  }
  std::function<void(std::size_t, double*)> edit;
  std::size_t more = 0;

 private:
  const SetpointSource& source_;

 public:
  std::vector<Column> columns_;
};

/// Two axes: up by 10 and back in 0.3 s each, with x = 10 (10 τ³ − 15 τ⁴ + 6 τ⁵); the second one rests.
struct MotionRows : testing::Test {
  static Polynomial rise(double from, double way) {
    const double T = 0.3, T3 = T * T * T;
    return {from, 0, 0, 10 * way / T3, -15 * way / (T3 * T), 6 * way / (T3 * T * T)};
  }
  std::shared_ptr<const SplineMotion> motion = std::make_shared<const SplineMotion>(
      std::vector<SplineMotion::Piece>{{0.3, {rise(0, 10), Polynomial{4}}}, {0.6, {rise(10, -10), Polynomial{4}}}});
  Machine machine{{{"cam", 200, 5000}, {"table", 1, 1}}, 0.001};
  MotionSetpoints rows{motion, machine, 600};

  std::string failed(const SetpointSource& source) const {
    Progress progress;
    std::string names;
    for (const Check& check : motion_setpoint_checks(*motion, machine, source, progress))
      if (!check.passed) names += check_name(check) + ';';
    return names;
  }
  std::string failed(std::size_t row, std::size_t column, double change) const {
    Edited edited(rows);
    edited.edit = [=](std::size_t k, double* out) {
      if (k == row) out[column] += change;
    };
    return failed(edited);
  }
};

TEST_F(MotionRows, AreThoseOfTheMotion) {
  ASSERT_EQ(rows.columns().size(), 6u);
  EXPECT_EQ(rows.columns()[2].name, "vcam");
  EXPECT_EQ(rows.columns()[5].name, "atable");
  EXPECT_EQ(failed(rows), "");
  double row[6];
  rows.read(150, 1, row);  // half way up: 5, and the largest speed of the law, 15/8 · 10 / 0.3
  EXPECT_NEAR(row[0], 5, 1e-12);
  EXPECT_EQ(row[1], 4);
  EXPECT_NEAR(row[2], 62.5, 1e-11);
  EXPECT_NEAR(row[4], 0, 1e-9);
}

TEST_F(MotionRows, ChangedRowsFail) {
  EXPECT_EQ(failed(150, 0, 1e-12), "setpoints position;");
  EXPECT_EQ(failed(299, 1, 1e-13), "setpoints position;");
  EXPECT_EQ(failed(150, 2, 1e-10), "setpoints velocity;");
  EXPECT_EQ(failed(42, 4, 1e-8), "setpoints acceleration;");
  EXPECT_EQ(failed(600, 0, 1e-300), "setpoints end;");
  EXPECT_EQ(failed(600, 3, 1e-300), "setpoints end;");
  EXPECT_EQ(failed(7, 5, std::numeric_limits<double>::quiet_NaN()), "setpoints acceleration;");
}

TEST_F(MotionRows, JerkAndSnapAreCheckedWhereTheyAreColumns) {
  const MotionSetpoints full(motion, machine, 600, 4);
  ASSERT_EQ(full.columns().size(), 10u);
  EXPECT_EQ(full.columns()[6].name, "jcam");
  EXPECT_EQ(full.columns()[6].unit, "mm/s³");
  EXPECT_EQ(full.columns()[9].name, "stable");
  EXPECT_EQ(failed(full), "");
  const auto spoiled = [&](std::size_t row, std::size_t column, double change) {
    Edited edited(full);
    edited.edit = [=](std::size_t k, double* out) {
      if (k == row) out[column] += change;
    };
    return failed(edited);
  };
  EXPECT_EQ(spoiled(42, 6, 1e-6), "setpoints jerk;");
  EXPECT_EQ(spoiled(42, 8, 1e-4), "setpoints snap;");
  EXPECT_EQ(spoiled(600, 8, 1e-9), "setpoints end;");
}

TEST_F(MotionRows, MissingColumnsAndRowsFail) {
  Edited longer(rows);
  longer.more = 1;
  EXPECT_EQ(failed(longer), "setpoints count;setpoints time;");
  Edited without(rows);
  without.columns_[3].name = "speed";
  EXPECT_EQ(failed(without), "setpoints count;");
}

}  // namespace
}  // namespace bahnwerk
