#include "core/verify/setpoints/needle_checks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/core/plan/winding/wound_turn.hpp"

namespace bahnwerk {
namespace {

using test::failed, test::Wound;

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

TEST(NeedleChecks, SeeWhatIsWrong) {
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

TEST(NeedleChecks, MissingColumnsFail) {
  const Wound wound;
  Progress progress;
  const std::vector<Check> checks =
      needle_checks({*wound.machine.axes, *wound.machine.kinematics, *wound.rows, {1, 1, 1}}, progress);
  EXPECT_EQ(failed(checks), "forward kinematics position");
}

}  // namespace
}  // namespace bahnwerk
