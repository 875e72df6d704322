#include "core/verify/rounding.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::verify {
namespace {

TEST(Rounding, IsThatOfTheTermsOfThePiecesPolynomials) {
  LawPiece p;
  p.duration = 2, p.s = 1, p.s_end = 5, p.v = -3, p.a = 0.5, p.j = -6, p.snap = 12;
  const PieceRounding r = rounding_of(p);
  // Terms at T = 2: 5; 3·2, 0.5·4/2, 6·8/6, 12·16/24.
  EXPECT_DOUBLE_EQ(r.position, 32 * epsilon * (5 + 6 + 1 + 8 + 8));
  EXPECT_DOUBLE_EQ(r.speed, 32 * epsilon * (3 + 1 + 12 + 16));
  EXPECT_DOUBLE_EQ(r.acceleration, 32 * epsilon * (0.5 + 12 + 24));
}

TEST(Rounding, NothingIsGrantedToAPieceThatStandsAtZero) {
  const PieceRounding r = rounding_of(LawPiece{});
  EXPECT_EQ(r.position, 0);
  EXPECT_EQ(r.speed, 0);
  EXPECT_EQ(r.acceleration, 0);
}

TEST(Rounding, PlacesAreAsExactForwardsAsBackwards) {
  LawPiece p;
  p.duration = 1, p.s = 2, p.s_end = 900, p.v = 898;
  LawPiece back = p;
  back.s = 900, back.s_end = 2, back.v = -898;
  EXPECT_EQ(rounding_of(p).position, rounding_of(back).position);
}

}  // namespace
}  // namespace bahnwerk::verify
