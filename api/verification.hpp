#pragma once
/// The judge's verdict as every kind reports it.
#include <nlohmann/json_fwd.hpp>

#include "core/plan.hpp"

namespace bahnwerk::api {

nlohmann::ordered_json verification(const Verification& verdict);

}  // namespace bahnwerk::api
