#include "api/limits_input.hpp"

#include <array>
#include <nlohmann/json.hpp>

namespace bahnwerk::api {

void take_limits(const nlohmann::json& object, Limits& limits, double unit) {
  const auto given = [&](const char* name) {
    const auto at = object.find(name);
    return at == object.end() || at->is_null() ? nullptr : &*at;
  };
  for (int order = 1; order <= Limits::highest_order; ++order)
    if (const auto* value = given(derivative_name(order))) limits.of(order) = unit * value->get<double>();
  if (const auto* range = given("range"))
    limits.lowest = unit * range->at(0).get<double>(), limits.highest = unit * range->at(1).get<double>();
}

Limits read_limits(const nlohmann::json& object, double unit) {
  Limits limits;
  take_limits(object, limits, unit);
  return limits;
}

}  // namespace bahnwerk::api
