#include "server/jobs/deadlines.hpp"

#include <algorithm>
#include <chrono>

#include "server/store/failure.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::chrono::milliseconds longest_sleep{10'000};  ///< the system's clock may be set meanwhile, too
constexpr std::chrono::milliseconds retry{1'000};           ///< after the store failed

}  // namespace

Deadlines::Deadlines(Store& store, const TimeSource& time, std::function<void(const Expired&)> looked)
    : store_(store), time_(time), looked_(std::move(looked)) {
  look();
  thread_.emplace([this] { return look(); }, time_);
}

std::chrono::milliseconds Deadlines::look() {
  try {
    const Expired expired = store_.expire(time_.now_ms());
    for (const std::string& id : expired.ids)
      log::info("job_ended", {{"job", id}, {"state", "failed"}, {"problem", "deadline-exceeded"}});
    if (expired.removed > 0) log::info("jobs_removed", {{"jobs", expired.removed}, {"reason", "retention"}});
    for (const std::string& id : expired.lost) log::warn("attempt_lost", {{"job", id}});
    if (looked_) looked_(expired);
    if (!expired.next) return longest_sleep;
    return std::clamp(std::chrono::milliseconds(*expired.next - time_.now_ms()), std::chrono::milliseconds(0),
                      longest_sleep);
  } catch (const StoreError& error) {
    log_failure("expire_failed", error);
    return retry;
  }
}

}  // namespace bahnwerk::server
