#pragma once
// Points that agree.
#include <gtest/gtest.h>

#include "core/geometry/curve/vec.hpp"

namespace bahnwerk {

inline void expect_near(Vec a, Vec b, double tolerance = 1e-12) {
  EXPECT_LE(norm(a - b), tolerance) << a.x << " " << a.y << " " << a.z << " is not " << b.x << " " << b.y << " " << b.z;
}

}  // namespace bahnwerk
