#pragma once
/// The contours and the machine that the documentation shows. Feeds are left open: the axes alone limit the speed.
#include "core/contour/contour.hpp"
#include "core/machine/machine.hpp"

namespace bahnwerk::draw {

Machine machine();         ///< two axes, 1800 mm/s, 16 000 mm/s²
Machine smooth_machine();  ///< two axes, 300 mm/s, 8000 mm/s², 800 000 mm/s³
/// A full circle of `radius` between two lines of `run_in`, mm.
Contour circle(double radius, double run_in, double feed = unlimited);
Contour window();   ///< the free-form window of examples/bracket.json: one run, no corner
Contour bracket();  ///< all of examples/bracket.json

/// A small outline, 20 by 12 mm: corners, a notch, an arc, and a curve that came as 24 chords.
Contour plate();
/// Two lines of 1 mm that turn by `angle`, rad, in the origin, one the mirror image of the other.
Contour corner(double angle);

}  // namespace bahnwerk::draw
