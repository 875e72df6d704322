#pragma once
/// Kind "probe_path": a measuring head through given points inside a tube.
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/plan/probe/probe_plan.hpp"

namespace bahnwerk::api::probe_path {

/// Returns the spec in core's terms; throws InvalidInput naming every fault.
ProbeRequest request(const nlohmann::json& spec);
/// Returns sentences on what the document contains and the plan does not use.
std::vector<std::string> notes(const nlohmann::json& spec);

/// Returns sentences on the plan: that the head rests at every corner, and why.
std::vector<std::string> notes(const ProbeRequest& request, const ProbePlan& plan);

/// Returns the result's details: methods, points, phases, pieces.
nlohmann::ordered_json details(const ProbeRequest& request, const std::vector<std::string>& notes,
                               const ProbePlan& plan);

}  // namespace bahnwerk::api::probe_path
