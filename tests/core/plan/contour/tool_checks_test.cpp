// Rows of a polar machine: right ones pass, and every fault of one of them is found.
#include "core/verify/setpoints/tool_checks.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/base/progress.hpp"
#include "core/base/progress_scope.hpp"
#include "core/contour/builder.hpp"
#include "core/machine/polar_machine.hpp"
#include "core/plan/contour/contour_plan.hpp"
#include "tests/core/check_names.hpp"

namespace bahnwerk {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

/// Rows of another source, of which one column is changed.
class Changed final : public SetpointSource {
 public:
  Changed(const SetpointSource& rows, std::size_t column, double factor)
      : rows_(rows), columns_(rows.columns()), column_(column), factor_(factor) {}
  const std::vector<Column>& columns() const override { return columns_; }
  std::size_t count() const override { return rows_.count(); }
  double cycle_time() const override { return rows_.cycle_time(); }
  double duration() const override { return rows_.duration(); }
  void read(std::size_t first, std::size_t rows, double* out) const override {
    rows_.read(first, rows, out);
    for (std::size_t i = 0; i < rows; ++i) out[i * columns_.size() + column_] *= factor_;
  }
  std::vector<Column>& names() { return columns_; }

 private:
  const SetpointSource& rows_;
  std::vector<Column> columns_;
  std::size_t column_;
  double factor_;
};

AxisLimits axis(const char* name, double velocity, double acceleration, const char* unit) {
  AxisLimits limits(name, velocity, acceleration);
  limits.unit = unit;
  return limits;
}

class ToolChecks : public ::testing::Test {
 protected:
  void SetUp() override {
    ContourBuilder b(2, {50, -20, 0});
    b.block(Mode::cut, 200);
    b.line({60, 20, 0});
    b.arc({20, 60, 0}, {20, 20, 0}, true);
    ContourPlanning planning;
    planning.method = PlanningMethod::time_optimal;
    plan_ = plan_contour(b.finish(), ToolMachine({machine_}, 0.001, 2), planning);
  }
  /// Returns the names of the checks that fail.
  std::vector<std::string> failed(const SetpointSource& rows) const {
    Progress silent;
    ProgressScope progress(silent, "test");
    std::vector<std::string> names;
    for (const Check& check :
         check_rows(rows, tool_row_check({plan_.path->path, 0, 2, *machine_, rows, {degrees, 1}}), progress))
      if (!check.passed) names.push_back(check_name(check));
    return names;
  }
  std::shared_ptr<const PolarMachine> machine_ = std::make_shared<const PolarMachine>(
      PolarSizes{}, std::vector{axis("theta", 6, 60, "rad"), axis("r", 600, 6000, "mm")});
  ContourPlan plan_;
};

using Names = std::vector<std::string>;

TEST_F(ToolChecks, RightRowsPass) { EXPECT_EQ(failed(*plan_.setpoints), Names{}); }

TEST_F(ToolChecks, FaultsAreFound) {
  // Columns: theta, r, vtheta, vr, atheta, ar, s, v, mode, block, x, y.
  const SetpointSource& rows = *plan_.setpoints;
  EXPECT_EQ(failed(Changed(rows, 1, 1 + 1e-6)), (Names{"forward kinematics position", "setpoints pose"}));
  EXPECT_EQ(failed(Changed(rows, 2, 1 + 1e-3)),
            (Names{"forward kinematics velocity", "forward kinematics acceleration"}));
  EXPECT_EQ(failed(Changed(rows, 5, 1 + 1e-2)), (Names{"forward kinematics acceleration"}));
  EXPECT_EQ(failed(Changed(rows, 10, 1 + 1e-6)), (Names{"setpoints pose"}));
  Changed unnamed(rows, 0, 1);
  unnamed.names()[10].name = "other";
  EXPECT_EQ(failed(unnamed), (Names{"forward kinematics position"}));
}

}  // namespace
}  // namespace bahnwerk
