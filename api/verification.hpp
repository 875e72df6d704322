#pragma once
/// The verifier's verdict as every kind reports it.
#include <nlohmann/json_fwd.hpp>

#include "core/base/verification.hpp"

namespace bahnwerk::api {

nlohmann::ordered_json verification(const Verification& verdict);

}  // namespace bahnwerk::api
