#pragma once
/// A law along a contour as it is served: slowed to whole cycles.
#include <memory>

#include "core/machine/machine.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/motion/law/path_motion.hpp"
#include "core/motion/setpoints/cycles.hpp"

namespace bahnwerk::test {

/// Of a machine whose axes are the first coordinates; keeps a copy of the contour.
inline std::shared_ptr<const PathMotion> slowed(const Contour& contour, const Machine& machine, const TimeLaw& law,
                                                const Cycles& cycles) {
  return std::make_shared<const PathMotion>(contour_axes(std::make_shared<const Contour>(contour), machine.dimension()),
                                            law.slowed(cycles.factor));
}

}  // namespace bahnwerk::test
