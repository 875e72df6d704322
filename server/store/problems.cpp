#include "server/store/problems.hpp"

#include <nlohmann/json.hpp>

#include "api/problem.hpp"

namespace bahnwerk::server {
namespace {

std::string document(const std::string& id, const char* type, const std::string& detail) {
  return api::Problem(type, detail).document("/v1/jobs/" + id).dump();
}

}  // namespace

std::string cancelled_error(const std::string& id) { return document(id, "cancelled", "The job was cancelled."); }

std::string deadline_error(const std::string& id) {
  return document(id, "deadline-exceeded", "The deadline passed while the job waited in the queue.");
}

std::string lost_error(const std::string& id, std::int64_t losses) {
  return document(id, "worker-lost",
                  "The process ended " + std::to_string(losses) +
                      " times while it planned this job and no other; it is not tried again.");
}

}  // namespace bahnwerk::server
