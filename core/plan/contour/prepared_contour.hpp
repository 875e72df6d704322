#pragma once
/// A contour made ready for the pipeline: rounded, if that is asked for, where it pays.
#include <memory>

#include "core/contour/contour.hpp"
#include "core/plan/contour_plan.hpp"
#include "core/plan/path_plan.hpp"

namespace bahnwerk {

class Progress;

struct PreparedContour {
  std::shared_ptr<const Contour> driven;
  PathPlanning path;  ///< blocks and setpoints are left to the caller, and its share of the progress, from `to` on
};

/// Throws what rounding and planning throw. Progress runs from `from` to `to`, which is `from` where corners stay.
PreparedContour prepare_contour(const std::shared_ptr<const Contour>& given, const Machine& machine,
                                const ContourPlanning& planning, Progress& progress, double from, double to);

}  // namespace bahnwerk
