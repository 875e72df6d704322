// The setpoints of winding machines, and that their check sees what is wrong with them.
#include "core/motion/setpoints/needle_setpoints.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "core/motion/axes/machine_path.hpp"
#include "core/motion/natural/natural_law.hpp"
#include "core/motion/setpoints/cycles.hpp"
#include "core/verify/setpoints/needle_checks.hpp"
#include "core/verify/setpoints/setpoint_checks.hpp"
#include "tests/core/check_names.hpp"
#include "tests/core/machine/winders.hpp"
#include "tests/core/motion/axes/needle_loop.hpp"

namespace bahnwerk {
namespace {

/// Rows of another source, one column changed.
class Changed final : public SetpointSource {
 public:
  Changed(const SetpointSource& source, std::string column, double factor, double offset)
      : source_(source), name_(std::move(column)), factor_(factor), offset_(offset) {}
  const std::vector<Column>& columns() const override { return source_.columns(); }
  std::size_t count() const override { return source_.count(); }
  double cycle_time() const override { return source_.cycle_time(); }
  double duration() const override { return source_.duration(); }
  void read(std::size_t first, std::size_t rows, double* out) const override {
    source_.read(first, rows, out);
    const std::size_t width = columns().size();
    for (std::size_t c = 0; c < width; ++c)
      if (columns()[c].name == name_)
        for (std::size_t i = 0; i < rows; ++i) out[i * width + c] = factor_ * out[i * width + c] + offset_;
  }

 private:
  const SetpointSource& source_;
  std::string name_;
  double factor_, offset_;
};

struct Wound {
  test::NeedlePath needle = test::stator_turn();
  MachinePath machine = machine_path(needle.tool, needle.orientation, test::winders()[1].configurations);
  Machine limits{machine.kinematics->axes(), 0.002};
  std::shared_ptr<const PathMotion> motion;
  std::unique_ptr<NeedleSetpoints> rows;

  Wound() {
    std::vector<bool> rests(needle.tool.size() + 1, false);
    rests.front() = rests.back() = true;
    const PathTask task{*machine.axes, limits, std::vector<double>(needle.tool.size(), unlimited), rests};
    NaturalOptions options;
    for (std::size_t i = 0; i < needle.tool.size(); ++i) options.shares.push_back(i % 2 == 1 ? 1 : 0);
    SilentProgress progress;
    TimeLaw law = plan_natural(task, options, progress, 0, 1);
    const Cycles cycles = whole_cycles(law.duration(), limits.cycle_time);
    law.slow(cycles.factor);
    motion = std::make_shared<const PathMotion>(machine.axes, std::move(law));
    rows = std::make_unique<NeedleSetpoints>(motion, machine.axes, limits, cycles.count,
                                             [](std::size_t, double, const LawState&) { return 25.0; });
  }
  std::vector<Check> needle_checks_of(const SetpointSource& source) const {
    SilentProgress progress;
    return needle_checks({*machine.axes, *machine.kinematics, source, NeedleSetpoints::shown(limits)}, progress);
  }
  std::vector<Check> setpoint_checks_of(const SetpointSource& source, double lag = 0) const {
    SilentProgress progress;
    SetpointInput input{*machine.axes, limits, motion->law(), source};
    input.shown = NeedleSetpoints::shown(limits);
    input.lag = lag;
    return setpoint_checks(input, progress);
  }
};

std::string failed(const std::vector<Check>& checks) {
  std::string names;
  for (const Check& check : checks)
    if (!check.passed) names += (names.empty() ? "" : ", ") + check_name(check);
  return names;
}

TEST(NeedleSetpoints, PassBothChecks) {
  const Wound wound;
  EXPECT_EQ(failed(wound.needle_checks_of(*wound.rows)), "");
  EXPECT_EQ(failed(wound.setpoint_checks_of(*wound.rows)), "");
}

std::vector<double> all_rows(const SetpointSource& source) {
  std::vector<double> all(source.count() * source.columns().size());
  source.read(0, source.count(), all.data());
  return all;
}

TEST(NeedleSetpoints, SteppedRowsAreTheSameInEverySliceAndOffTheLawByTheirLag) {
  const Wound wound;
  SilentProgress progress;
  ProgressScope stage_progress(progress, "interpolate", 0, 1);
  const std::size_t cycles = wound.rows->count() - 1;
  for (const Interpolator interpolator : {Interpolator::taylor1, Interpolator::taylor2, Interpolator::quartic}) {
    const auto stepped =
        std::make_shared<const Interpolation>(wound.motion, interpolator, 0.002, cycles, stage_progress);
    const NeedleSetpoints rows(
        wound.motion, wound.machine.axes, wound.limits, cycles,
        [](std::size_t, double, const LawState&) { return 25.0; }, stepped);
    EXPECT_EQ(failed(wound.needle_checks_of(rows)), "");
    EXPECT_EQ(failed(wound.setpoint_checks_of(rows)), "setpoints path");
    EXPECT_EQ(failed(wound.setpoint_checks_of(rows, 0.5)), "");
    const std::vector<double> all = all_rows(rows), exact = all_rows(*wound.rows);
    const std::size_t width = rows.columns().size();
    std::vector<double> slice(100 * width);
    for (std::size_t first = 0; first + 100 < cycles; first += 97) {
      rows.read(first, 100, slice.data());
      for (std::size_t i = 0; i < slice.size(); ++i) ASSERT_EQ(slice[i], all[first * width + i]);
    }
    double lag = 0;
    for (std::size_t k = 0; k <= cycles; ++k)
      lag = std::max(lag, std::abs(all[k * width + 25] - exact[k * width + 25]));
    EXPECT_NEAR(lag, stepped->fluctuation().lag, 1e-9);
    EXPECT_GT(lag, 1e-6);
  }
}

TEST(NeedleSetpoints, RatesOfThePoseAreItsDerivatives) {
  const Wound wound;
  const std::vector<double> all = all_rows(*wound.rows);
  const std::size_t width = wound.rows->columns().size();
  ASSERT_EQ(width, 33u);
  for (std::size_t c = 0; c < 5; ++c) {
    EXPECT_EQ(wound.rows->columns()[28 + c].name, "v" + wound.rows->columns()[20 + c].name);
    double off = 0, largest = 0;
    for (std::size_t k = 1; k + 1 < wound.rows->count(); ++k) {
      const double difference = (all[(k + 1) * width + 20 + c] - all[(k - 1) * width + 20 + c]) / 0.004;
      off = std::max(off, std::abs(difference - all[k * width + 28 + c]));
      largest = std::max(largest, std::abs(difference));
    }
    EXPECT_GT(largest, 0);
    EXPECT_LE(off, 1e-3 * largest) << c;
  }
}

TEST(NeedleSetpoints, ChecksSeeWhatIsWrong) {
  const Wound wound;
  const auto seen = [&](const char* column, double factor, double offset) {
    return failed(wound.needle_checks_of(Changed(*wound.rows, column, factor, offset)));
  };
  EXPECT_EQ(seen("q1", 1, 2e-6), "forward kinematics position, setpoints pose");
  EXPECT_EQ(seen("q4", 1, 1e-5), "forward kinematics position, forward kinematics angle, setpoints pose");
  EXPECT_EQ(seen("q4", std::numbers::pi / 180, 0),
            "forward kinematics position, forward kinematics angle, setpoints pose");
  EXPECT_EQ(seen("x", 1, 2e-6), "setpoints pose");
  EXPECT_EQ(seen("phi", 1, 1e-5), "setpoints pose");
  EXPECT_EQ(seen("phi", 1, 360), "");  // whole turns are the same pose
  EXPECT_EQ(seen("psi", 1, std::nan("")), "setpoints pose");
  EXPECT_EQ(seen("q3", 1, std::nan("")), "forward kinematics position, forward kinematics angle, setpoints pose");
  EXPECT_NE(failed(wound.setpoint_checks_of(Changed(*wound.rows, "vq4", 1 + 1e-9, 0))), "");
  EXPECT_NE(failed(wound.setpoint_checks_of(Changed(*wound.rows, "aq2", 1 + 1e-9, 0))), "");
}

TEST(NeedleSetpoints, JerkIsTheDerivativeOfAcceleration) {
  const Wound wound;
  const std::size_t width = wound.rows->columns().size();
  std::vector<double> all(wound.rows->count() * width);
  wound.rows->read(0, wound.rows->count(), all.data());
  const double h = wound.rows->cycle_time();
  for (std::size_t k = 0; k < 5; ++k) {
    double largest = 0, off = 0;
    for (std::size_t i = 2; i + 2 < wound.rows->count(); ++i) {
      const auto j = [&](std::size_t row) { return all[row * width + 15 + k]; };
      const double slope = (all[(i + 1) * width + 10 + k] - all[(i - 1) * width + 10 + k]) / (2 * h);
      // Within the jerks around it: it may jump from one piece of the law to the next.
      const double low = std::min({j(i - 1), j(i), j(i + 1)}), high = std::max({j(i - 1), j(i), j(i + 1)});
      largest = std::max(largest, std::abs(j(i)));
      off = std::max(off, std::max(low - slope, slope - high));
    }
    EXPECT_LE(off, 0.05 * largest) << k;
  }
}

TEST(NeedleChecks, MissingColumnsFail) {
  const Wound wound;
  SilentProgress progress;
  const std::vector<Check> checks =
      needle_checks({*wound.machine.axes, *wound.machine.kinematics, *wound.rows, {1, 1, 1}}, progress);
  EXPECT_EQ(failed(checks), "forward kinematics position");
}

}  // namespace
}  // namespace bahnwerk
