#include "server/routes/stored_document.hpp"

#include "api/documents/job.hpp"
#include "api/text/json_parts.hpp"

namespace bahnwerk::server {

std::optional<StoredSpec> stored_spec(Context& context, const std::string& id) {
  const auto job = context.store.get(id, true);
  const api::Kind* kind = job ? api::find_kind(job->request.kind) : nullptr;
  if (!kind) return std::nullopt;
  return StoredSpec{kind, api::job_spec(job->request.document)};
}

std::string read_parts(StoredText& result, const std::vector<std::string>& names) {
  api::JsonParts parts(names);
  std::string piece;
  for (bool more = true; more && result.next(piece); piece.clear()) more = parts.take(piece);
  return parts.document();
}

}  // namespace bahnwerk::server
