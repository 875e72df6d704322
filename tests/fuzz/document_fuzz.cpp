// Any text either is a job document, kept byte for byte and with a spec that can be planned, or a problem that can be
// sent; checking it never does anything else.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "api/documents/job.hpp"
#include "api/kind.hpp"
#include "api/problem.hpp"

namespace {

void demand(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bahnwerk::api;
  const std::string_view body(reinterpret_cast<const char*>(data), size);
  try {
    const JobRequest request = parse_job(body);
    demand(request.document == (request.callback ? parse_job(request.document).document : body));
    demand(find_kind(request.kind) != nullptr);
    demand(job_spec(request.document).is_object());
  } catch (const Problem& problem) {
    const std::string_view slug = problem.type().slug;
    demand(slug == "invalid-json" || slug == "schema-violation" || slug == "semantic-violation" ||
           slug == "unknown-kind" || slug == "payload-too-large");
    const auto document = problem.document("/v1/jobs");
    demand(document.at("status").get<int>() >= 400 && !document.dump().empty());
  }
  return 0;
}
