#include "core/verify/cam/law_verifier.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "core/base/progress.hpp"
#include "core/cam/law_table.hpp"
#include "tests/core/cam/problems.hpp"

namespace bahnwerk {
namespace {

using namespace cam::testing_problems;

/// A law of two sections, rest to rest over 20 mm and back, in 2 s, with its table.
struct Plan {
  cam::MotionLawProblem problem = cam::testing_problems::problem(2, true, {rest(0, 0), rest(1, 20)});
  LawToVerify law{{0, 1, 2}, {0, 1}, {{0, 0, 0, 20, 20, 20}, {20, 20, 20, 0, 0, 0}}, {0, 1}, 2, 0, {}, {}, {}};
  std::size_t steps = 50;
  Plan() {
    problem.objective.weight = {0, 1, 0, 0};
    law.objective = 37.5;
    law.peaks = {20, 37.5, 20 * 10 / std::sqrt(3.0), 1200};
  }
  cam::CamLaw cam_law() const {
    std::vector<cam::LawPiece> pieces;
    for (std::size_t i = 0; i < law.bernstein.size(); ++i) pieces.push_back({law.sections[i], law.bernstein[i]});
    return {law.breaks, pieces, problem.periodic, problem.travel};
  }
};

/// Rows of another table with one number changed.
class Changed final : public SetpointSource {
 public:
  Changed(const SetpointSource& rows, std::size_t row, std::size_t column, double by)
      : rows_(rows), row_(row), column_(column), by_(by) {}
  const std::vector<Column>& columns() const override { return rows_.columns(); }
  std::size_t count() const override { return rows_.count(); }
  double cycle_time() const override { return rows_.cycle_time(); }
  double duration() const override { return rows_.duration(); }
  void read(std::size_t first, std::size_t rows, double* out) const override {
    rows_.read(first, rows, out);
    if (row_ >= first && row_ < first + rows) out[(row_ - first) * 5 + column_] += by_;
  }

 private:
  const SetpointSource& rows_;
  std::size_t row_, column_;
  double by_;
};

std::set<std::string> failed(const Verification& verdict) {
  std::set<std::string> out;
  for (const Check& check : verdict.checks)
    if (!check.passed) out.insert(check.subject);
  EXPECT_EQ(verdict.passed, out.empty());
  return out;
}
std::set<std::string> failed(const Plan& plan) {
  Progress progress;
  const cam::LawTable table(plan.cam_law(), plan.problem, plan.law.cycle_duration, plan.steps);
  return failed(verify_motion_law(plan.problem, plan.law, table, progress));
}
std::set<std::string> failed_after(const std::function<void(Plan&)>& change) {
  Plan plan;
  change(plan);
  return failed(plan);
}
bool has(const std::set<std::string>& names, const std::string& name) { return names.count(name) > 0; }

TEST(LawVerifier, ARightLawPasses) { EXPECT_EQ(failed(Plan()), std::set<std::string>{}); }

TEST(LawVerifier, ValuesAndRangesThatTheLawMissesFail) {
  EXPECT_TRUE(has(failed_after([](Plan& p) { p.problem.points[1].values[0] = number(20 + 1e-6); }), "value position"));
  EXPECT_TRUE(has(failed_after([](Plan& p) { p.problem.points[1].values[1] = {1e-5, 1}; }), "value velocity"));
  EXPECT_TRUE(has(failed_after([](Plan& p) {
                    p.problem.points[0].values.resize(4), p.problem.points[0].values[3] = {0, 1199};
                  }),
                  "value jerk"));
}

TEST(LawVerifier, JumpsUpToTheContinuityOfAPointFail) {
  // The jerk ends at 1200 and goes on at −1200; derivative 4 does not jump there, derivative 5 does.
  EXPECT_EQ(failed_after([](Plan& p) { p.problem.points[0].continuity = 3; }),
            std::set<std::string>{"continuity jerk"});
  EXPECT_EQ(failed_after([](Plan& p) { p.problem.points[1].continuity = 5; }),
            (std::set<std::string>{"continuity jerk", "continuity derivative 5"}));
  EXPECT_TRUE(has(failed_after([](Plan& p) { p.law.bernstein[1][2] = 19.9; }), "continuity acceleration"));
}

TEST(LawVerifier, ACycleEndsItsTravelFartherThanItBegins) {
  const auto onward = [](double travel) {
    return failed_after([&](Plan& p) {
      p.law.bernstein[1] = {20, 20, 20, 50, 50, 50};
      p.law.objective = 56.25, p.law.peaks = {50, 56.25, 300 / std::sqrt(3.0), 1800};
      p.problem.travel = travel;
    });
  };
  EXPECT_EQ(onward(50), std::set<std::string>{});
  for (const double wrong : {0.0, -50.0, 50 + 1e-6}) {
    EXPECT_TRUE(has(onward(wrong), "value position"));
    EXPECT_TRUE(has(onward(wrong), "continuity position"));
  }
}

TEST(LawVerifier, LimitsOfSectionsHoldBetweenTheRowsToo) {
  const auto limited = [](double most) {
    return failed_after([&](Plan& p) {
      p.problem.points[0].section[1] = {0, most};
      p.steps = 3;  // no row is near the peak
    });
  };
  EXPECT_EQ(limited(37.5), std::set<std::string>{});
  EXPECT_EQ(limited(37.5 - 1e-6), std::set<std::string>{"section limit velocity"});
  EXPECT_TRUE(has(failed_after([](Plan& p) { p.problem.points[1].section[0] = {1, 30}; }), "section limit position"));
}

TEST(LawVerifier, PeaksAndObjectiveThatAreTooSmallFail) {
  EXPECT_EQ(failed_after([](Plan& p) { p.law.peaks[3] = 1199; }), std::set<std::string>{"peak jerk"});
  EXPECT_EQ(failed_after([](Plan& p) { p.law.objective = 37.4; }), std::set<std::string>{"objective"});
  EXPECT_EQ(failed_after([](Plan& p) { p.law.bound = 37.6; }), std::set<std::string>{"bound"});
  EXPECT_EQ(failed_after([](Plan& p) {
              p.problem.drive = cam::DriveLimits{38, 1, 2000};
            }),
            std::set<std::string>{"drive acceleration"});
}

TEST(LawVerifier, RmsValuesAreThoseOfTheCoefficients) {
  const double a = 20 * std::sqrt(120.0 / 7),
               j = 20 * std::sqrt(720.0);  // figures of the polynomial 3-4-5 over 20 in 1 s
  EXPECT_EQ(failed_after([&](Plan& p) { p.law.rms = {0, 0, a, j}; }), std::set<std::string>{});
  EXPECT_EQ(failed_after([&](Plan& p) {
              p.law.rms = {0, 0, a * (1 + 1e-6), j};
            }),
            std::set<std::string>{"rms acceleration"});
  EXPECT_EQ(failed_after([&](Plan& p) { p.law.rms = {0, 0, a, j * (1 - 1e-6)}; }), std::set<std::string>{"rms jerk"});
}

TEST(LawVerifier, ChosenAnglesStayInTheirRanges) {
  EXPECT_EQ(failed_after([](Plan& p) { p.problem.points[1].at = {0.5, 1.5}; }), std::set<std::string>{});
  EXPECT_EQ(failed_after([](Plan& p) { p.problem.points[1].at = {1.1, 1.5}; }), std::set<std::string>{"angles"});
  EXPECT_EQ(failed_after([](Plan& p) {
              p.law.at[1] = 1.2, p.problem.points[1].at = {0, 2};
            }),
            std::set<std::string>{"angles"});
}

TEST(LawVerifier, ClassicalLawsAreHeldAgainstTheirFormulas) {
  EXPECT_EQ(failed_after([](Plan& p) { p.problem.points[0].law = cam::ClassicalLaw::polynomial_345; }),
            std::set<std::string>{});
  EXPECT_EQ(failed_after([](Plan& p) { p.problem.points[0].law = cam::ClassicalLaw::inclined_sine; }),
            std::set<std::string>{"classical law"});
}

TEST(LawVerifier, RowsThatAreNotTheLawFail) {
  const Plan plan;
  const cam::LawTable table(plan.cam_law(), plan.problem, plan.law.cycle_duration, plan.steps);
  Progress progress;
  static const char* names[] = {"table phi", "table s", "table v", "table a", "table j"};
  for (std::size_t column = 0; column < 5; ++column)
    for (const std::size_t row : {0, 7, 25, 50}) {
      const Changed rows(table, row, column, 1e-5);
      EXPECT_EQ(failed(verify_motion_law(plan.problem, plan.law, rows, progress)), std::set<std::string>{names[column]})
          << row;
    }
}

TEST(LawVerifier, AModeThatGoesOnVibratingFails) {
  const auto still = [](double frequency) {
    return failed_after([&](Plan& p) {
      p.problem.points[0].still = p.problem.points[1].still = true;
      p.problem.vibration = {{frequency, 0}};
      // The inclined sine has no residual vibration at whole periods from the second on.
      p.law.bernstein = {{0, 0, 0, 20, 20, 20}, {20, 20, 20, 0, 0, 0}};
    });
  };
  EXPECT_EQ(still(1.3), std::set<std::string>{"residual vibration"});
}

}  // namespace
}  // namespace bahnwerk
