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
    "created_at, started_at, finished_at, error, revision, owner, callback_attempts, callback_due, callback_delivered, "
    "callback_error, tags, token, planned_by, seq";
inline constexpr int job_seq_column = 26;

api::Job job_from_row(const Query& row);  ///< returns the job without its document

/// Column `whole` of `specs`: a row of version 0.1 has the spec alone; later ones have the document as posted, which
/// was checked then, or is still to be checked.
inline constexpr std::int64_t spec_alone = 0, document_checked = 1, document_unchecked = 2;
inline std::int64_t spec_form(bool checked) { return checked ? document_checked : document_unchecked; }

/// Returns a row of `specs` as a job document; with `whole` false the row contains the spec alone.
std::string unpack_document(const std::string& kind, std::string_view packed, bool whole);

}  // namespace bahnwerk::server
