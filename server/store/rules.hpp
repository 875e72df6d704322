#pragma once
/// What becomes of jobs, whatever store they are in: a store has the statements, these functions decide.
#include <cstdint>
#include <string>

#include "api/documents/job.hpp"
#include "server/store/values.hpp"

namespace bahnwerk::server {

/// Distance of the revisions of a job's attempt that was lost and of the next one. Clients may have seen revisions of
/// the lost one that were never stored; whoever takes the job up again continues far above them.
inline constexpr std::int64_t lost_leap = 1 << 20;

/// Removals whose changes a store remembers, at least; whoever asks from before them looks at all jobs.
inline constexpr std::int64_t kept_removals = 1024;

/// Returns a job as its store has it when it has been accepted, without its document and the secret of its callback.
api::Job accepted_job(const NewJob& job, const std::string& id);

/// The state into which a job goes, and its error: a problem document, empty where there is none.
struct Fate {
  api::JobState state;
  std::string error;
};

/// Returns the fate of a running job whose attempt was lost. `losses`: attempts that were lost while nothing else ran,
/// this one included.
Fate after_loss(const std::string& id, std::int64_t losses, bool cancel_requested);
/// Returns the fate of a running job that is put back.
Fate after_requeue(const std::string& id, bool cancel_requested);
/// Returns the fate of a job that is cancelled while it waits.
Fate after_cancel(const std::string& id);
/// Returns the fate of a job whose deadline passes while it waits.
Fate after_deadline(const std::string& id);

}  // namespace bahnwerk::server
