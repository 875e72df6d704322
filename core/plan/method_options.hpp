#pragma once
/// The planning methods by name, and their options in documents.
#include <vector>

#include "core/base/named.hpp"
#include "core/machine/limits.hpp"
#include "core/motion/profile/speed_profile.hpp"

namespace bahnwerk {

enum class PlanningMethod { braking_reserve, time_optimal, jerk_limited, natural, constant, critical_points, spline };
inline constexpr Named<PlanningMethod> planning_methods[] = {{PlanningMethod::braking_reserve, "braking_reserve"},
                                                             {PlanningMethod::time_optimal, "time_optimal"},
                                                             {PlanningMethod::jerk_limited, "jerk_limited"},
                                                             {PlanningMethod::natural, "natural"},
                                                             {PlanningMethod::constant, "constant"},
                                                             {PlanningMethod::critical_points, "critical_points"},
                                                             {PlanningMethod::spline, "bspline"}};

/// Options of a document; each method reads those that concern it.
struct MethodOptions {
  double corner_angle = 0.1 * 3.14159265358979323846 / 180;  ///< rad
  double braking_reserve = 0.7;                              ///< K_b [Bock (2.11)]
  Limits along;                                              ///< limits along the tool's path, mm/s and its derivatives
  std::vector<double> shares;                                ///< shares of NaturalOptions, for `natural`
  SpeedProfile profile = SpeedProfile::double_s;  ///< profile of feed changes, for `constant` and `critical_points`
  double feed = 0;                                ///< feed of FeedOptions, for `constant`, mm/s
};

}  // namespace bahnwerk
