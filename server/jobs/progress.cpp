#include "server/jobs/progress.hpp"

#include <algorithm>
#include <limits>
#include <new>

#include "core/base/errors.hpp"
#include "server/runtime/memory.hpp"

namespace bahnwerk::server {
namespace {

constexpr auto publish_interval = std::chrono::milliseconds(100);
constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

JobProgress::JobProgress(const api::Job& job, std::shared_ptr<LiveJob> live,
                         std::optional<std::chrono::milliseconds> most, Hooks hooks)
    : live_(std::move(live)),
      hooks_(std::move(hooks)),
      deadline_(job.request.deadline),
      budget_(job.request.time_budget),
      start_(hooks_.now()),
      published_(start_ - publish_interval) {
  if (most) budget_ = std::min(budget_.value_or(infinity), std::chrono::duration<double>(*most).count());
}

JobProgress::Stop JobProgress::reason(std::string_view stage) const {
  if (live_->lost) return Stop::lost;
  if (live_->cancel) return Stop::cancelled;
  if (live_->interrupt) return Stop::interrupted;
  if (deadline_ && hooks_.now_ms() >= *deadline_) return Stop::deadline;
  if (stage == "storing") return Stop::none;  // the budget is one of planning
  if (budget_ && std::chrono::duration<double>(hooks_.now() - start_).count() >= *budget_) return Stop::budget;
  return Stop::none;
}

void JobProgress::report(std::string_view stage, double fraction, std::string_view message) {
  ++reports_;
  if (stopped_ != Stop::none) ++reports_after_stop_;
  stopped_ = reason(stage);
  switch (stopped_) {
    case Stop::none:
      break;
    case Stop::deadline:
      throw Stopped(StopReason::deadline);
    case Stop::budget:
      throw Stopped(StopReason::budget);
    case Stop::cancelled:
    case Stop::interrupted:
    case Stop::lost:
      throw Stopped(StopReason::cancelled);
  }
  if (uses_memory() && memory_is_short()) throw std::bad_alloc();
  // Progress never runs backwards, whatever a planner's stages claim; NaN counts as no news.
  if (fraction > fraction_) fraction_ = std::min(fraction, 1.0);
  const auto now = hooks_.now();
  if (now - published_ < publish_interval && stage == stage_) return;
  if (now - published_ < publish_interval / 10) return;  // stages may flicker by
  published_ = now;
  stage_ = stage;
  live_->publish(fraction_, stage, message);
  hooks_.publish();
}

}  // namespace bahnwerk::server
