#pragma once
/// Drawings of a fill plan as SVG, the same for the service and for the documentation.
#include <string>

#include "core/plan/fill_plan.hpp"

namespace bahnwerk {

/// A layout in its slot; its title names algorithm, wire, count and copper.
std::string layout_drawing(const FillRequest& request, const FilledLayout& filled);
/// Fill factors over the wires, a curve for each algorithm.
std::string fill_factor_chart(const FillPlan& plan, const std::string& title);

}  // namespace bahnwerk
