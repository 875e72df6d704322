#pragma once
/// The jobs that are being planned, with their current state. The store follows a little later.
#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "api/documents/job.hpp"
#include "server/store/values.hpp"

namespace bahnwerk::server {

/// An attempt at a job. The planner's thread writes; other threads read, or request it to stop.
class LiveJob {
 public:
  explicit LiveJob(const api::Job& job)
      : attempt_{job.id, job.token}, claimed_(job.revision), revision_(job.revision) {}
  const std::string& id() const { return attempt_.id; }
  const Attempt& attempt() const { return attempt_; }

  void publish(double fraction, std::string_view stage, std::string_view message);  ///< increases the revision
  std::uint64_t revision() const;
  Progressed progressed() const;  ///< returns the current progress
  /// `stored` is the revision that the store has after it was told `told`. Where it is another one, what is published
  /// gets a greater revision than that.
  void raise_above(std::uint64_t stored, std::uint64_t told);
  void overlay(api::Job& job) const;  ///< replaces the store's progress of this attempt by the current one

  std::atomic<bool> cancel{false};     ///< a client has cancelled the job
  std::atomic<bool> interrupt{false};  ///< the service ends; the job goes back to the queue
  std::atomic<bool> lost{false};       ///< the store reports that the attempt is over: no result of it can be stored

 private:
  const Attempt attempt_;
  const std::uint64_t claimed_;  ///< the revision with which it began to run
  mutable std::mutex mutex_;
  double fraction_ = 0;
  std::string stage_, message_;
  std::uint64_t revision_;
};

class LiveJobs {
 public:
  /// `shown` false: overlay() does nothing, so that clients see of every job, whichever process plans it, what is
  /// stored.
  explicit LiveJobs(bool shown = true) : shown_(shown) {}
  std::shared_ptr<LiveJob> add(const api::Job& job);
  void remove(const LiveJob& live);  ///< removes the job, unless a later attempt has taken its place
  void cancel(const std::string& id);
  void interrupt_all();
  void overlay(api::Job& job) const;
  std::vector<std::shared_ptr<LiveJob>> all() const;
  std::size_t size() const;

 private:
  const bool shown_;
  mutable std::mutex mutex_;
  std::map<std::string, std::shared_ptr<LiveJob>> jobs_;
};

}  // namespace bahnwerk::server
