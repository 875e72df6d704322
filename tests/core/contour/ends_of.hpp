#pragma once
/// Where segments and contours begin and end.
#include "core/contour/contour.hpp"

namespace bahnwerk {

inline Vec begin_of(const Segment& segment) { return segment.curve().at(segment.curve().begin()).value; }
inline Vec end_of(const Segment& segment) { return segment.curve().at(segment.curve().end()).value; }
inline Vec begin_of(const Contour& contour) { return begin_of(contour.path[0]); }
inline Vec end_of(const Contour& contour) { return end_of(contour.path[contour.path.size() - 1]); }

}  // namespace bahnwerk
