#include "core/cam/optimal/program/law_basis.hpp"

#include <gtest/gtest.h>

#include "tests/core/cam/optimal/laws.hpp"

namespace bahnwerk::cam {
namespace {

LawTask with_short_section(double length) {
  MotionLawProblem problem = testing::rest_to_rest(10, 1);
  problem.points.insert(problem.points.begin() + 1, testing::point_at(45, {testing::fixed(5)}, 3));
  problem.points.insert(problem.points.begin() + 2,
                        testing::point_at(45 + length, {testing::fixed(5 + length / 9)}, 3));
  return make_law_task(problem);
}

TEST(LawBasis, ShortSectionsHaveFewerPiecesThatDivideTheOthers) {
  const LawBasis basis(with_short_section(0.1), 7, 16);
  EXPECT_EQ(basis.section(0).pieces(), 16u);
  EXPECT_LT(basis.section(1).pieces(), 16u);
  EXPECT_EQ(16 % basis.section(1).pieces(), 0u);
  EXPECT_EQ(basis.size(), basis.first(2) + basis.section(2).size());
}

TEST(LawBasis, SectionsOfEqualPiecesAreTheirOwnMirrors) {
  const LawBasis equal(with_short_section(10), 3, 12);
  EXPECT_EQ(&equal.section(0), &equal.mirrored(0));
  const LawBasis uneven(3, {{0, 0.25, 1}, {0, 0.75, 1}});
  EXPECT_EQ(&uneven.section(0), &uneven.mirrored(1));
  EXPECT_EQ(uneven.size(), 10u);
}

TEST(LawBasis, WhatRoundingHidesIsNotExpressible) {
  EXPECT_TRUE(is_expressible(with_short_section(0.1), 7));
  EXPECT_FALSE(is_expressible(with_short_section(1e-5), 4));
  EXPECT_FALSE(is_expressible(with_short_section(1e-5), 1, 4));
}

}  // namespace
}  // namespace bahnwerk::cam
