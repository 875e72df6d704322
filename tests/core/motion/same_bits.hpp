#pragma once
#include <gtest/gtest.h>

#include <array>

#include "core/motion/law/time_law.hpp"

namespace bahnwerk::testing {

/// Every piece of both laws, to the last bit.
inline void expect_same_bits(const TimeLaw& a, const TimeLaw& b) {
  ASSERT_EQ(a.pieces().size(), b.pieces().size());
  const auto numbers = [](const LawPiece& p) {
    return std::array{p.t0, p.duration, p.s, p.s_end, p.v, p.a, p.j, p.snap, static_cast<double>(p.segment)};
  };
  for (std::size_t i = 0; i < a.pieces().size(); ++i) EXPECT_EQ(numbers(a.pieces()[i]), numbers(b.pieces()[i])) << i;
}

}  // namespace bahnwerk::testing
