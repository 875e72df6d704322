#pragma once
/// A contour prepared for the pipeline: rounded where that is requested and makes it quicker.
#include <memory>

#include "core/contour/contour.hpp"
#include "core/plan/contour/contour_axes.hpp"
#include "core/plan/contour/contour_plan.hpp"
#include "core/plan/path_plan.hpp"

namespace bahnwerk {

class Progress;

struct PreparedContour {
  std::shared_ptr<const Contour> driven;
  std::shared_ptr<const ContourAxes> axes;
  PathPlanning path;  ///< problem of the pipeline; the caller adds blocks and setpoints; its progress begins at `to`
};

/// Returns the prepared contour. Throws what rounding and planning throw. Progress runs from `from` to `to`; they are
/// equal if corners stay.
PreparedContour prepare_contour(const std::shared_ptr<const Contour>& given, const ToolMachine& machine,
                                const ContourPlanning& planning, Progress& progress, double from, double to);

}  // namespace bahnwerk
