/// No stage of any kind keeps a worker longer than it may: between two reports lie at most 100 ms of its processor
/// time, and a plan stops at whichever report it is told to.
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <map>
#include <vector>

#include "core/base/errors.hpp"
#include "large_documents.hpp"
#include "tests/api/checked.hpp"
#include "tests/api/documents.hpp"

namespace bahnwerk::api {
namespace {

#ifndef NDEBUG
constexpr double slower = 10;  // for debugging, or with a sanitizer
#else
constexpr double slower = 1;
#endif
constexpr double longest_gap = 0.1 * slower;  // s of this thread's processor time: other load does not count

double thread_seconds() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// The time before every report, by the stage that was shown meanwhile. Planners are deterministic: over several runs
/// each report has its place, and what a busy machine added to one run another did not.
class GapMeter final : public Progress {
 public:
  struct Gap {
    std::string stage, until;
    double seconds = 0;
  };
  void begin() {
    next_ = 0;
    stage_ = "(begin)";
    last_ = thread_seconds();
  }
  void report(std::string_view stage, double, std::string_view) override {
    end(stage);
    stage_ = stage;
    last_ = thread_seconds();
  }
  void end(std::string_view until) {
    const double seconds = thread_seconds() - last_;
    if (next_ == gaps.size()) gaps.push_back({stage_, std::string(until), seconds});
    EXPECT_EQ(gaps[next_].stage, stage_) << "not the same run";
    gaps[next_].seconds = std::min(gaps[next_].seconds, seconds);
    ++next_;
  }
  const Gap& longest() const {
    return *std::max_element(gaps.begin(), gaps.end(),
                             [](const Gap& a, const Gap& b) { return a.seconds < b.seconds; });
  }
  std::vector<Gap> gaps;

 private:
  std::size_t next_ = 0;
  std::string stage_;
  double last_ = 0;
};

struct Stages : testing::TestWithParam<test::Large> {};

TEST_P(Stages, ReportOften) {
  const test::Large& large = GetParam();
  const std::string document = test::job(large);
  constexpr int most_runs = 4;
  GapMeter meter;
  for (int run = 0; run < most_runs; ++run) {
    meter.begin();
    PlannedJob job;
    try {
      job = plan_job(large.kind, document, meter);
    } catch (...) {
      const auto problem = problem_from_current_exception();
      ADD_FAILURE() << problem.type().slug << ": " << problem.what();
    }
    meter.end("(end)");
    if (run == 0) {
      EXPECT_EQ(test::result_faults(job.result), std::vector<std::string>{});
    }
    if (meter.longest().seconds <= longest_gap) break;
  }
  struct Total {
    double seconds = 0, longest = 0;
    std::size_t reports = 0;
  };
  std::map<std::string, Total> stages;
  for (const auto& gap : meter.gaps) {
    Total& stage = stages[gap.stage];
    stage.seconds += gap.seconds;
    stage.longest = std::max(stage.longest, gap.seconds);
    ++stage.reports;
  }
  for (const auto& [name, stage] : stages)
    std::printf("%-22s %7zu reports %8.3f s, longest gap %6.1f ms\n", name.c_str(), stage.reports, stage.seconds,
                1e3 * stage.longest);
  const auto& longest = meter.longest();
  EXPECT_LE(longest.seconds, longest_gap) << large.name << ": in " << longest.stage << ", until " << longest.until;
}

INSTANTIATE_TEST_SUITE_P(Large, Stages, testing::ValuesIn(test::large_documents()), [](const auto& each) {
  std::string name = each.param.name;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
});

/// Stops at the k-th report; a k beyond the last counts them.
struct StopAt final : Progress {
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
  std::vector<test::Large> small{{"small slot", "fill_factor", {{"slot", test::wavy_slot(20)}, {"wires", {3.0}}}}};
  for (const std::string file : {"bracket", "circle", "helix", "line", "polyline"}) {
    const auto document = test::read_json(test::source("examples/" + file + ".json"));
    small.push_back({file, document["kind"], document["spec"]});
  }
  for (const test::Large& each : small) {
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
