/// No stage of any kind keeps a worker longer than it may, however large the document, and a plan stops at whichever
/// report it is told to.
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "api/documents/job.hpp"
#include "api/kind.hpp"
#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "large_documents.hpp"
#include "tests/api/checked.hpp"

namespace bahnwerk::api {
namespace {

#ifndef NDEBUG
constexpr double slower = 10;  // for debugging, or with a sanitizer
#else
constexpr double slower = 1;
#endif
/// s of this thread's processor time, which no report may lie apart on any machine, however busy.
constexpr double never = 1 * slower;
/// The rule. What is longer must not have grown with the document.
constexpr double rule = 0.1 * slower;

double thread_seconds() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// The time before every report, by the stage that was shown meanwhile. Planners are deterministic: over several runs
/// each report has its place, and what a busy machine added to one run another did not.
class GapMeter final : public ProgressSink {
 public:
  struct Gap {
    std::string stage, until;
    double seconds = 0;
  };
  /// Plans and measures, once more with every call: of each gap the shortest counts.
  PlannedJob plan(const test::Large& large) {
    next_ = 0;
    stage_ = "(begin)";
    PlannedJob job;
    const std::string document = test::job(large);
    last_ = thread_seconds();
    try {
      job = plan_job(large.kind, document, *this);
    } catch (...) {
      const auto problem = problem_from_current_exception();
      ADD_FAILURE() << problem.type().slug << ": " << problem.what();
    }
    end("(end)");
    return job;
  }
  void report(std::string_view stage, double, std::string_view) override {
    end(stage);
    stage_ = stage;
    last_ = thread_seconds();
  }
  const Gap& longest() const {
    return *std::max_element(gaps.begin(), gaps.end(),
                             [](const Gap& a, const Gap& b) { return a.seconds < b.seconds; });
  }
  std::map<std::string, std::size_t> reports() const {
    std::map<std::string, std::size_t> stages;
    for (const Gap& gap : gaps) ++stages[gap.stage];
    return stages;
  }
  std::vector<Gap> gaps;

 private:
  void end(std::string_view until) {
    const double seconds = thread_seconds() - last_;
    if (next_ == gaps.size()) gaps.push_back({stage_, std::string(until), seconds});
    EXPECT_EQ(gaps[next_].stage, stage_) << "not the same run";
    gaps[next_].seconds = std::min(gaps[next_].seconds, seconds);
    ++next_;
  }
  std::size_t next_ = 0;
  std::string stage_;
  double last_ = 0;
};

struct Stages : testing::TestWithParam<std::size_t> {};

/// A document four times as large is reported of as often per piece, and no part of the work on it is silent: what a
/// planner does without a report in between does not grow with its input.
TEST_P(Stages, ReportOften) {
  const test::Large small = test::large_documents(0.25)[GetParam()], large = test::large_documents()[GetParam()];
  GapMeter few, many;
  few.plan(small);
  EXPECT_EQ(test::result_faults(many.plan(large).result), std::vector<std::string>{});
  if (large.reports_grow) {
    // Small documents are planned on finer grids, too, for the sake of the gap: less than four times as often.
    EXPECT_GE(2 * many.gaps.size(), 3 * few.gaps.size());
  }
  const auto allowed = [&] { return std::min(never, std::max(rule, 2 * few.longest().seconds)); };
  for (int run = 1; run < 4 && many.longest().seconds > allowed(); ++run) many.plan(large);

  struct Total {
    double seconds = 0, longest = 0;
  };
  std::map<std::string, Total> stages;
  for (const auto& gap : many.gaps) {
    Total& stage = stages[gap.stage];
    stage.seconds += gap.seconds;
    stage.longest = std::max(stage.longest, gap.seconds);
  }
  const auto before = few.reports(), after = many.reports();
  for (const auto& [name, stage] : stages)
    std::printf("%-22s %6zu and %7zu reports, %8.3f s, longest gap %6.1f ms\n", name.c_str(),
                before.count(name) ? before.at(name) : 0, after.at(name), stage.seconds, 1e3 * stage.longest);
  const auto& longest = many.longest();
  std::printf("longest gap %.1f ms, of the smaller one %.1f ms\n", 1e3 * longest.seconds, 1e3 * few.longest().seconds);
  EXPECT_LE(longest.seconds, allowed()) << large.name << ": in " << longest.stage << ", until " << longest.until;
}

INSTANTIATE_TEST_SUITE_P(Large, Stages, testing::Range(std::size_t{0}, test::large_documents(0.01).size()),
                         [](const auto& each) {
                           std::string name = test::large_documents(0.01)[each.param].name;
                           std::replace_if(
                               name.begin(), name.end(),
                               [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
                           return name;
                         });

TEST(StagesOfKinds, EveryKindEntersLargeDocuments) {
  std::set<std::string> entered, all;
  for (const test::Large& each : test::large_documents(0.01)) entered.insert(each.kind);
  for (const Kind& kind : kinds()) all.emplace(kind.name);
  EXPECT_EQ(entered, all) << "a kind without a file large_<kind>.cpp";
}

/// Stops at the k-th report; a k beyond the last counts them.
struct StopAt final : ProgressSink {
  explicit StopAt(int at) : left(at) {}
  void report(std::string_view stage, double, std::string_view) override {
    ++reports;
    last = stage;
    if (--left == 0) throw Stopped(StopReason::cancelled);
  }
  int left, reports = 0;
  std::string last;
};

TEST(StagesOfExamples, StopAtWhicheverReportTheyAreTold) {
  for (const test::Large& each : test::small_documents()) {
    const std::string document = test::job(each);
    StopAt all(0);
    test::checked(plan_job(each.kind, document, all));
    ASSERT_GT(all.reports, 3) << each.name;
    // All of the first and the last ones, some between: a search reports thousands of times alike.
    const int step = std::max(1, all.reports / 12);
    for (int k = 1; k <= all.reports; k += k < 6 || k > all.reports - 6 ? 1 : std::min(step, all.reports - 6 - k + 1)) {
      StopAt stop(k);
      EXPECT_THROW(plan_job(each.kind, document, stop), Stopped)
          << each.name << ", report " << k << " of " << all.reports;
      EXPECT_EQ(stop.reports, k) << each.name << ": went on after it was told to stop, in stage " << stop.last;
    }
  }
}

}  // namespace
}  // namespace bahnwerk::api
