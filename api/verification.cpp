#include "api/verification.hpp"

#include <nlohmann/json.hpp>

namespace bahnwerk::api {

nlohmann::ordered_json verification(const Verification& verdict) {
  nlohmann::ordered_json checks = nlohmann::ordered_json::array();
  for (const auto& c : verdict.checks)
    checks.push_back({{"name", c.name},
                      {"unit", c.unit},
                      {"limit", c.limit},
                      {"value", c.value},
                      {"at", c.at},
                      {"passed", c.passed}});
  return {{"passed", verdict.passed}, {"checks", std::move(checks)}};
}

}  // namespace bahnwerk::api
