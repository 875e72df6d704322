#include "server/store/sqlite/rows.hpp"

#include <nlohmann/json.hpp>

#include "server/store/codec.hpp"
#include "server/store/store.hpp"

namespace bahnwerk::server {

api::Job job_from_row(const Query& row) {
  api::Job job;
  job.id = row.text(0);
  job.request.kind = row.text(1);
  job.request.name = row.optional_text(2);
  job.request.reference = row.optional_text(3);
  if (!row.null(4)) job.request.callback = api::Callback{row.text(4)};
  job.request.priority = static_cast<int>(row.integer(5));
  job.request.deadline = row.optional_integer(6);
  if (!row.null(7)) job.request.time_budget = row.number(7);
  const auto state = api::job_state(row.text(8));
  if (!state) throw StoreError("store: unknown state " + row.text(8), false);
  job.state = *state;
  job.fraction = row.number(9);
  job.stage = row.text(10);
  job.message = row.text(11);
  job.attempt = static_cast<int>(row.integer(12));
  job.created_at = row.integer(13);
  job.started_at = row.optional_integer(14);
  job.finished_at = row.optional_integer(15);
  job.error = row.optional_text(16);
  job.revision = static_cast<std::uint64_t>(row.integer(17));
  job.owner = row.optional_text(18);
  job.delivery = {static_cast<int>(row.integer(19)), row.optional_integer(21), row.optional_integer(20),
                  row.optional_text(22)};
  if (!row.null(23)) job.request.tags = nlohmann::json::parse(row.text(23)).get<std::vector<std::string>>();
  job.token = row.integer(24);
  job.planned_by = row.optional_text(25);
  if (job.state != api::JobState::running) job.state_revision = job.revision;
  return job;
}

std::string unpack_document(const std::string& kind, std::string_view packed, bool whole) {
  std::string text = unpack_text(packed);
  if (!whole) text = "{\"kind\":\"" + kind + "\",\"spec\":" + text + "}";
  return text;
}

}  // namespace bahnwerk::server
