#pragma once
/// The verifier's verdict and the bound as every kind reports them.
#include <nlohmann/json_fwd.hpp>

#include "core/base/verification.hpp"

namespace bahnwerk::api {

nlohmann::ordered_json verification(const Verification& verdict);
/// Returns {"duration" | "count" | "objective", "gap", "basis"}; counts are integers.
nlohmann::ordered_json bound(const Bound& bound);

}  // namespace bahnwerk::api
