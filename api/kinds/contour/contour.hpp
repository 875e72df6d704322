#pragma once
/// Kind "contour": reads its spec into the terms of core.
#include <nlohmann/json_fwd.hpp>

#include "api/kind.hpp"
#include "core/contour/contour.hpp"
#include "core/machine/tool_machine.hpp"
#include "core/plan/contour/contour_plan.hpp"

namespace bahnwerk::api::contour {

/// Largest number of segments, and of setpoints of one job.
inline constexpr std::size_t max_segments = 2'000'000;
inline constexpr double max_setpoints = 20'000'000;

/// Reads the machine of a spec that passed its schema, unless it has coarse and fine axes. Throws InvalidInput.
ToolMachine machine(const nlohmann::json& spec);
/// Reads the planning options of a spec that passed its schema.
ContourPlanning planning(const nlohmann::json& spec);
/// Reads the contour. Throws InvalidInput naming every fault, with places relative to the spec.
Contour geometry(const nlohmann::json& spec, Progress progress);
Contour geometry(const nlohmann::json& spec);

}  // namespace bahnwerk::api::contour
