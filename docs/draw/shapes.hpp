#pragma once
/// The contours and the machine that the documentation shows. Feeds are left open: the axes alone limit the speed.
#include "core/contour/contour.hpp"
#include "core/machine/machine.hpp"

namespace bahnwerk::draw {

Machine machine();  ///< two axes, 1800 mm/s, 16 000 mm/s²
/// A full circle of `radius` between two lines of `run_in`, mm.
Contour circle(double radius, double run_in, double feed = unlimited);
Contour window();   ///< the free-form window of examples/bracket.json: one run, no corner
Contour bracket();  ///< all of examples/bracket.json

}  // namespace bahnwerk::draw
