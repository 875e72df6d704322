#pragma once
/// Rows of the tables as api::Job.
#include "api/job.hpp"
#include "server/store/postgres/connection.hpp"

namespace bahnwerk::server {

/// The columns that job_from expects, from column 0 on, of `jobs j LEFT JOIN runs r`.
inline constexpr const char* postgres_job_columns =
    "j.id, j.kind, j.name, j.reference, j.callback, j.rank, j.deadline, j.time_budget, j.state, "
    "coalesce(r.fraction, j.fraction), coalesce(r.stage, j.stage), coalesce(r.message, j.message), j.attempt, "
    "j.created_at, j.started_at, j.finished_at, j.error, greatest(j.revision, r.revision), j.owner, "
    "j.callback_attempts, j.callback_due, j.callback_delivered, j.callback_error, j.tags, j.token, j.revision, "
    "j.planned_by";
inline constexpr int postgres_job_column_count = 27;

api::Job job_from(const PostgresRows& rows, std::size_t row);  ///< returns the job without its document

}  // namespace bahnwerk::server
