#pragma once
/// What planning a document yields.
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "core/base/setpoint_source.hpp"

namespace bahnwerk::api {

struct PlannedJob {
  nlohmann::ordered_json result;              ///< the result document, with the setpoints' summary
  std::unique_ptr<SetpointSource> setpoints;  ///< nullptr where the kind has none
  bool verified = false;
  std::string failure = {};  ///< of a plan that is not verified: which checks failed, for a person
};

}  // namespace bahnwerk::api
