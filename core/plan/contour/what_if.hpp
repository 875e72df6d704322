#pragma once
/// Durations of the same contour under other limits, which a machinist may choose or buy.
#include <memory>
#include <string>
#include <vector>

#include "core/base/progress.hpp"
#include "core/plan/contour/contour_plan.hpp"

namespace bahnwerk {

/// Returns the changes that apply to a planning, in this order: twice the tolerance (if corners are rounded), half and
/// twice the jerk (if it is limited), half the accelerations. Jerk and accelerations change for every axis and along
/// the path.
///
/// A duration equals, to the last bit, that of a plan with the changed limits: the law is planned, refined and verified
/// as usual (the bound is computed only if the method refines by it), but no setpoints are made. A change without a
/// plan has no duration. Cost: one plan per change, without setpoints and drawings. Throws Stopped.
std::vector<WhatIf> what_if(const std::shared_ptr<const Contour>& given, const ToolMachine& machine,
                            const ContourPlanning& planning, Progress progress);

}  // namespace bahnwerk
