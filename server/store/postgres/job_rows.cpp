#include "server/store/postgres/job_rows.hpp"

namespace bahnwerk::server {

api::Job job_from(const PostgresRows& rows, std::size_t row) {
  api::Job job;
  job.id = rows.uuid(row, 0);
  job.request.kind = rows.text(row, 1);
  job.request.name = rows.optional_text(row, 2);
  job.request.reference = rows.optional_text(row, 3);
  if (!rows.null(row, 4)) job.request.callback = api::Callback{rows.text(row, 4)};
  job.request.priority = -static_cast<int>(rows.integer(row, 5));
  job.request.deadline = rows.optional_time(row, 6);
  job.request.time_budget = rows.optional_number(row, 7);
  const auto state = api::job_state(rows.text(row, 8));
  if (!state) throw StoreError("store: unknown state " + rows.text(row, 8), false);
  job.state = *state;
  job.fraction = rows.number(row, 9);
  job.stage = rows.text(row, 10);
  job.message = rows.text(row, 11);
  job.attempt = static_cast<int>(rows.integer(row, 12));
  job.created_at = rows.time(row, 13);
  job.started_at = rows.optional_time(row, 14);
  job.finished_at = rows.optional_time(row, 15);
  job.error = rows.optional_text(row, 16);
  job.revision = static_cast<std::uint64_t>(rows.integer(row, 17));
  job.owner = rows.optional_text(row, 18);
  job.delivery = {static_cast<int>(rows.integer(row, 19)), rows.optional_time(row, 21), rows.optional_time(row, 20),
                  rows.optional_text(row, 22)};
  if (!rows.null(row, 23)) job.request.tags = rows.texts(row, 23);
  job.token = rows.integer(row, 24);
  job.planned_by = rows.optional_text(row, 26);
  // Progress is stored beside the job's row, which changes with its state alone, or with its callback.
  job.state_revision =
      job.state == api::JobState::running ? static_cast<std::uint64_t>(rows.integer(row, 25)) : job.revision;
  return job;
}

}  // namespace bahnwerk::server
