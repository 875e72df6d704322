#pragma once
/// Kind "probe_path": a measuring head through given points inside a tube.
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/plan/probe/probe_plan.hpp"

namespace bahnwerk {
class Progress;
}
namespace bahnwerk::api {
struct PlannedJob;
}

namespace bahnwerk::api::probe_path {

/// The spec in core's terms; throws InvalidInput naming every fault.
ProbeRequest request(const nlohmann::json& spec);
/// What the document says and the plan does not use.
std::vector<std::string> notes(const nlohmann::json& spec);

void check(const nlohmann::json& spec);
PlannedJob plan(const nlohmann::json& spec, Progress& progress);

/// The result's details: methods, points, phases, pieces.
nlohmann::ordered_json details(const nlohmann::json& spec, const ProbeRequest& request, const ProbePlan& plan);

}  // namespace bahnwerk::api::probe_path
