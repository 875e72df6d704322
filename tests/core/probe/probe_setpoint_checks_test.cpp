#include "core/verify/probe/probe_setpoint_checks.hpp"

#include <functional>

#include "core/base/progress.hpp"
#include "core/probe/arcs/arcs.hpp"
#include "core/probe/resting_motion.hpp"
#include "core/verify/setpoints/motion_setpoint_checks.hpp"
#include "tests/core/check_names.hpp"
#include "tests/core/probe/probe_cases.hpp"

namespace bahnwerk {
namespace {

using namespace probe_cases;

/// Rows as they have to be, in a table that a test may change.
class Table final : public SetpointSource {
 public:
  Table(const ProbeProblem& problem, const ProbeMotion& plan, std::size_t cycles) : problem_(problem) {
    for (const char* name : {"x", "y", "vx", "vy", "ax", "ay", "jx", "jy", "deviation", "v"})
      columns_.push_back({name, ""});
    const RestingMotion motion(plan.motion, problem.points.back());
    for (std::size_t k = 0; k <= cycles; ++k) {
      const double t = static_cast<double>(k) * problem.machine.cycle_time;
      const MotionState x = k == cycles ? motion.final_state() : motion.evaluate(t);
      const std::size_t edge = t < plan.times[1] ? 0 : 1;
      rows_.push_back({x[0][0], x[0][1], x[1][0], x[1][1], x[2][0], x[2][1], x[3][0], x[3][1],
                       distance_from_edge({x[0][0], x[0][1]}, problem.points[edge], problem.points[edge + 1]),
                       std::hypot(x[1][0], x[1][1])});
    }
  }
  const std::vector<Column>& columns() const override { return columns_; }
  std::size_t count() const override { return rows_.size(); }
  double cycle_time() const override { return problem_.machine.cycle_time; }
  double duration() const override { return static_cast<double>(count() - 1) * cycle_time(); }
  void read(std::size_t first, std::size_t rows, double* out) const override {
    for (std::size_t k = first; k < first + rows; ++k) out = std::copy(rows_[k].begin(), rows_[k].end(), out);
  }
  std::vector<Column> columns_;
  std::vector<std::vector<double>> rows_;

 private:
  const ProbeProblem& problem_;
};

class ProbeSetpointChecks : public testing::Test {
 protected:
  std::vector<std::string> failed(const std::function<void(Table&)>& change) const {
    Table table(problem_, plan_, cycles_);
    change(table);
    const RestingMotion motion(plan_.motion, problem_.points.back());
    Progress silent;
    std::vector<std::string> names;
    const ProbeToVerify input{problem_, motion, plan_.times};
    RowChecks both;
    both.push_back(motion_row_check({motion, problem_.machine, table}));
    both.push_back(probe_row_check(input, table));
    ProgressScope scope(silent, "rows");
    read_rows(table, both, scope);
    for (const auto& rows : both)
      for (const Check& check : rows->checks())
        if (!check.passed) names.push_back(check_name(check));
    return names;
  }
  ProbeProblem problem_ = problem({{0, 0}, {10, 0}, {10, 8}}, 0.2);
  std::size_t cycles_ = 0;
  ProbeMotion plan_ = [this] {
    Progress silent;
    const ProbeMotion planned = plan_arcs(problem_, silent);
    cycles_ = static_cast<std::size_t>(std::ceil(planned.duration() / 0.001));
    const double served = static_cast<double>(cycles_) * 0.001;
    return slowed(planned, served / planned.duration(), served);
  }();
};

using Names = std::vector<std::string>;

TEST_F(ProbeSetpointChecks, RightRowsPass) {
  EXPECT_EQ(failed([](Table&) {}), Names{});
}

TEST_F(ProbeSetpointChecks, EveryColumnOfEveryRowIsHeld) {
  const std::vector<std::pair<std::size_t, std::string>> columns{
      {4, "setpoints acceleration"}, {7, "setpoints jerk"}, {8, "setpoints deviation"}, {9, "setpoints speed"}};
  for (const std::size_t row : {std::size_t{1}, cycles_ / 2, cycles_ - 1})
    for (const auto& [column, name] : columns)
      EXPECT_EQ(failed([&, at = column](Table& table) { table.rows_[row][at] += 1e-6; }), Names{name}) << row;
}

TEST_F(ProbeSetpointChecks, MissingColumnsFail) {
  const Names names = failed([](Table& table) { table.columns_[8].name = "distance"; });
  EXPECT_EQ(names, (Names{"setpoints deviation", "setpoints speed"}));
}

TEST_F(ProbeSetpointChecks, TheLastRowIsTheEnd) {
  EXPECT_EQ(failed([](Table& table) { table.rows_.back()[0] += 1e-13; }), Names{"setpoints end"});
}

}  // namespace
}  // namespace bahnwerk
