#pragma once
/// A contour prepared for the pipeline: rounded where that is requested and makes it quicker.
#include <memory>

#include "core/base/progress.hpp"
#include "core/contour/contour.hpp"
#include "core/plan/contour/contour_axes.hpp"
#include "core/plan/contour_plan.hpp"
#include "core/plan/path_plan.hpp"

namespace bahnwerk {

struct PreparedContour {
  std::shared_ptr<const Contour> driven;
  std::shared_ptr<const ContourAxes> axes;
  PathPlanning path;  ///< problem of the pipeline; the caller adds blocks and setpoints
};

/// Returns the prepared contour. Throws what rounding and planning throw.
PreparedContour prepare_contour(const std::shared_ptr<const Contour>& given, const ToolMachine& machine,
                                const ContourPlanning& planning, Progress progress);

}  // namespace bahnwerk
