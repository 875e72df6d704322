#pragma once
/// The Progress of a planner in a worker: checks on every call whether to stop (nanoseconds), and publishes rarely.
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/base/progress.hpp"
#include "server/jobs/live.hpp"
#include "server/store/store.hpp"

namespace bahnwerk::server {

class JobProgress final : public ProgressSink {
 public:
  using Clock = std::chrono::steady_clock;
  enum class Stop { none, cancelled, deadline, budget, interrupted, lost };

  struct Hooks {
    std::function<void()> publish;           ///< called for clients, at most every 100 ms
    std::function<std::int64_t()> now_ms;    ///< wall clock, for the deadline
    std::function<Clock::time_point()> now;  ///< steady clock, for budget and throttling
  };
  /// `most` limits the time of planning beside the job's own budget.
  JobProgress(const api::Job& job, std::shared_ptr<LiveJob> live, std::optional<std::chrono::milliseconds> most,
              Hooks hooks);

  /// Throws Stopped when the job has to end; stopped() then gives the reason. Throws std::bad_alloc while planning when
  /// answering threads have no memory but their reserve. From the planner's thread only.
  void report(std::string_view stage, double fraction, std::string_view message = {}) override;
  Stop stopped() const { return stopped_; }
  std::uint64_t reports() const { return reports_; }  ///< number of reports
  /// Returns the number of calls after the planner was told to stop; 0 if it stops at once.
  std::uint64_t reports_after_stop() const { return reports_after_stop_; }

 private:
  Stop reason(std::string_view stage) const;
  std::shared_ptr<LiveJob> live_;
  Hooks hooks_;
  std::optional<std::int64_t> deadline_;
  std::optional<double> budget_;
  Clock::time_point start_, published_;
  std::string stage_;
  double fraction_ = 0;
  Stop stopped_ = Stop::none;
  std::uint64_t reports_ = 0, reports_after_stop_ = 0;
};

}  // namespace bahnwerk::server
