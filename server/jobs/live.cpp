#include "server/jobs/live.hpp"

#include <algorithm>

namespace bahnwerk::server {

void LiveJob::publish(double fraction, std::string_view stage, std::string_view message) {
  const std::lock_guard lock(mutex_);
  fraction_ = fraction;
  stage_ = stage;
  message_ = message;
  ++revision_;
}

std::uint64_t LiveJob::revision() const {
  const std::lock_guard lock(mutex_);
  return revision_;
}

Progressed LiveJob::progressed() const {
  const std::lock_guard lock(mutex_);
  return {attempt_, fraction_, stage_, message_, revision_};
}

void LiveJob::raise_above(std::uint64_t stored, std::uint64_t told) {
  const std::lock_guard lock(mutex_);
  if (stored > told) revision_ = std::max(revision_, stored + 1);
}

void LiveJob::overlay(api::Job& job) const {
  if (job.state != api::JobState::running || job.token != attempt_.token) return;
  const std::lock_guard lock(mutex_);
  job.fraction = fraction_;
  job.stage = stage_;
  job.message = message_;
  job.revision = std::max(job.revision, revision_);
  job.state_revision = claimed_;
}

std::shared_ptr<LiveJob> LiveJobs::add(const api::Job& job) {
  auto live = std::make_shared<LiveJob>(job);
  const std::lock_guard lock(mutex_);
  jobs_[job.id] = live;
  return live;
}

void LiveJobs::remove(const LiveJob& live) {
  const std::lock_guard lock(mutex_);
  if (const auto found = jobs_.find(live.id()); found != jobs_.end() && found->second.get() == &live)
    jobs_.erase(found);
}

void LiveJobs::cancel(const std::string& id) {
  const std::lock_guard lock(mutex_);
  if (const auto found = jobs_.find(id); found != jobs_.end()) found->second->cancel = true;
}

void LiveJobs::interrupt_all() {
  const std::lock_guard lock(mutex_);
  for (const auto& [id, live] : jobs_) live->interrupt = true;
}

void LiveJobs::overlay(api::Job& job) const {
  if (!shown_) return;
  std::shared_ptr<LiveJob> live;
  {
    const std::lock_guard lock(mutex_);
    const auto found = jobs_.find(job.id);
    if (found == jobs_.end()) return;
    live = found->second;
  }
  live->overlay(job);
}

std::vector<std::shared_ptr<LiveJob>> LiveJobs::all() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::shared_ptr<LiveJob>> list;
  for (const auto& [id, live] : jobs_) list.push_back(live);
  return list;
}

std::size_t LiveJobs::size() const {
  const std::lock_guard lock(mutex_);
  return jobs_.size();
}

}  // namespace bahnwerk::server
