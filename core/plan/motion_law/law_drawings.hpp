#pragma once
/// Drawings of a planned motion law as SVG.
#include <string>

#include "core/plan/motion_law/law_plan.hpp"

namespace bahnwerk {

/// s, v, a, j over the master, one above the other. Numbers at points are dots, ranges are boxes as wide as the range
/// of the point's angle and as high as the range of the value (open ends reach the frame) [Nolte, Bild 4]; limits of
/// sections are dashed. The law is drawn over what it is compared with: the law of `active_set`, or the classical one.
std::string law_drawing(const LawPlan& plan);
/// Draws the amplitudes of the acceleration's harmonics, of the law and of the classical one, side by side.
std::string spectrum_drawing(const LawPlan& plan);

}  // namespace bahnwerk
