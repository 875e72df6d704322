#pragma once
/// Rows of the tables: jobs as api::Job, documents, chunks.
#include <string>
#include <string_view>

#include "api/job.hpp"
#include "server/store/sqlite/connection.hpp"

namespace bahnwerk::server {

/// The columns that job_from_row expects, from column 0 on.
inline constexpr const char* job_columns =
    "id, kind, name, reference, callback, priority, deadline, time_budget, state, fraction, stage, message, attempt, "
    "created_at, started_at, finished_at, error, revision, seq";
inline constexpr int job_seq_column = 18;

api::Job job_from_row(const Query& row);  ///< returns the job without its document

/// Returns a row of `specs` as a job document; with `whole` false the row is of version 0.1 and contains the spec
/// alone.
std::string unpack_document(const std::string& kind, std::string_view packed, bool whole);

}  // namespace bahnwerk::server
