// Any body of a POST is either a job or a problem with pointers into the body; checking it never does anything else.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "api/job.hpp"
#include "api/problem.hpp"

namespace {

void demand(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const auto request = bahnwerk::api::parse_job({reinterpret_cast<const char*>(data), size});
    demand(!request.kind.empty() && !request.spec.empty());
  } catch (const bahnwerk::api::Problem& problem) {
    const auto document = problem.document("/v1/jobs");
    demand(document["status"].get<int>() >= 400 && document["status"].get<int>() < 500);
    demand(!document.dump().empty());
  }
  return 0;
}
