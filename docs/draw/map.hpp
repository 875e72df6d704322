#pragma once
/// A planned contour as a map in which colour is speed.
#include "core/contour/contour.hpp"
#include "core/motion/law/time_law.hpp"
#include "docs/draw/chart.hpp"

namespace bahnwerk::draw {

/// Blocks that cut in the colours of 0 … `fastest` mm/s.
void coloured_cuts(Chart& chart, const Contour& contour, const TimeLaw& law, double fastest, double width);

/// All of the path as it is, segment by segment.
void plain(Chart& chart, const Contour& contour, const Style& style, const std::string& label = {});

}  // namespace bahnwerk::draw
