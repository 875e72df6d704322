#pragma once
/// Member `details` of the result of kind "contour": blocks, passed joints, sections, the lines that take most time,
/// and what other limits would bring.
#include <nlohmann/json_fwd.hpp>

#include "core/plan/contour/contour_plan.hpp"

namespace bahnwerk::api::contour {

/// Returns the member for a plan on the axes of `machine`. `program` tells whether the contour is a program, which has
/// lines; otherwise segments are named by their number, from 0.
nlohmann::ordered_json details(const ContourPlan& plan, const Machine& machine, const ContourPlanning& planning,
                               bool program);

}  // namespace bahnwerk::api::contour
