#pragma once
/// The contour of the tests with five axes: a line, a bow and a line, smooth, with curvature that jumps twice.
#include "core/contour/builder.hpp"

namespace bahnwerk::test {

inline Contour bow() {
  ContourBuilder b(2, {});
  b.line({40, 0, 0});
  b.arc({60, 20, 0}, {40, 20, 0}, true);
  b.line({60, 45, 0});
  return b.finish();
}

}  // namespace bahnwerk::test
