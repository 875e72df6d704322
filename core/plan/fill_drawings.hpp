#pragma once
/// Drawings of a fill plan as SVG, shared by the service and the documentation.
#include <string>

#include "core/plan/fill_plan.hpp"

namespace bahnwerk {

/// Returns a layout drawn in its slot; the title names algorithm, wire, count and copper.
std::string layout_drawing(const FillRequest& request, const FilledLayout& filled);
/// Returns the chart of fill factors over wire diameters, one curve per algorithm.
std::string fill_factor_chart(const FillPlan& plan, const std::string& title);

}  // namespace bahnwerk
