#pragma once
/// The verifier's verdict and the bound as every kind reports them.
#include <nlohmann/json_fwd.hpp>

#include "core/base/verification.hpp"

namespace bahnwerk::api {

/// Reports the checks. `at_unit` is the unit of the places at which their values occur.
nlohmann::ordered_json verification(const Verification& verdict, const char* at_unit = "s");
/// Returns {"duration" | "count" | "objective", "gap", "basis"}; counts are integers.
nlohmann::ordered_json bound(const Bound& bound);

}  // namespace bahnwerk::api
