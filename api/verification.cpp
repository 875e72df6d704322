#include "api/verification.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>

#include "api/check_text.hpp"

namespace bahnwerk::api {

nlohmann::ordered_json verification(const Verification& verdict, const char* at_unit) {
  nlohmann::ordered_json checks = nlohmann::ordered_json::array();
  for (const auto& c : verdict.checks)
    checks.push_back({{"name", check_name(c)},
                      {"group", check_group(c)},
                      {"unit", check_unit(c)},
                      {"limit", c.limit},
                      {"value", c.value},
                      {"at", c.at},
                      {"at_unit", at_unit},
                      {"passed", c.passed}});
  return {{"passed", verdict.passed}, {"checks", std::move(checks)}};
}

nlohmann::ordered_json bound(const Bound& bound) {
  nlohmann::ordered_json out;
  switch (bound.quantity) {
    case BoundQuantity::duration:
      out["duration"] = bound.value;
      break;
    case BoundQuantity::count:
      out["count"] = static_cast<std::uint64_t>(bound.value);
      break;
    case BoundQuantity::objective:
      out["objective"] = bound.value;
      break;
  }
  out["gap"] = bound.gap;
  out["basis"] = bound.basis;
  return out;
}

}  // namespace bahnwerk::api
