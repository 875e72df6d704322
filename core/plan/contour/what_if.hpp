#pragma once
/// How long the same contour would take under other limits: what a machinist may ask for, or buy.
#include <memory>
#include <string>
#include <vector>

#include "core/plan/contour_plan.hpp"

namespace bahnwerk {

class Progress;

/// The changes that apply to a planning, in this order: twice the tolerance (where corners are rounded), half and twice
/// the jerk (where it is limited), half the accelerations. Jerk and accelerations: of every axis and along the path.
///
/// A duration is the one that a plan with the changed limits has, to the last bit: the law is planned, refined and
/// verified as always (the bound only where the method refines by it), but no setpoint is made. A change with which
/// there is no plan has no duration. Cost: that of as many plans, without what only setpoints and drawings take.
/// Throws Stopped.
std::vector<WhatIf> what_if(const std::shared_ptr<const Contour>& given, const Machine& machine,
                            const ContourPlanning& planning, Progress& progress, double from, double to);

}  // namespace bahnwerk
