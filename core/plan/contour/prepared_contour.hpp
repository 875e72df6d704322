#pragma once
/// A contour on its machine as the document states it, and rounded where that is requested. Nothing is planned.
#include <memory>
#include <vector>

#include "core/base/progress.hpp"
#include "core/contour/blend.hpp"
#include "core/contour/contour.hpp"
#include "core/plan/contour/contour_axes.hpp"
#include "core/plan/contour/contour_plan.hpp"
#include "core/plan/path_plan.hpp"

namespace bahnwerk {

struct PreparedContour {
  std::shared_ptr<const Contour> given;
  std::shared_ptr<const Contour> rounded;  ///< null where corners stay
  std::vector<BlendSection> sections;      ///< sections of both, if there is a rounded one
  std::shared_ptr<const ContourAxes> axes;
  MethodRow method;
  Machine held, moving;  ///< limits that the method keeps: of every axis, and of those that move
};

/// Throws what rounding throws, and UnreachablePose.
PreparedContour prepare_contour(const std::shared_ptr<const Contour>& given, const ToolMachine& machine,
                                const ContourPlanning& planning, Progress progress);

/// Returns the problem of driving `driven`, a contour within the tolerance of the given one; the caller adds blocks,
/// setpoints and progress.
PathPlanning path_planning(const PreparedContour& prepared, const std::shared_ptr<const Contour>& driven,
                           const ContourPlanning& planning);

}  // namespace bahnwerk
