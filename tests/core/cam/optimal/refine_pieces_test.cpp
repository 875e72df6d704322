#include "core/cam/optimal/refine_pieces.hpp"

#include <gtest/gtest.h>

#include "tests/core/cam/optimal/laws.hpp"

namespace bahnwerk::cam {
namespace {

const std::vector<double> halves{0, 0.5, 1};

/// A cubic with the same jerk all over is left as it is; a jump of the jerk halves the pieces on both sides of it.
TEST(RefinePieces, OnlyPiecesAtWhichTheJerkChangesAreHalved) {
  const LawTask task = make_law_task(testing::rest_to_rest(10, 1));
  const LawBasis basis(3, {{0, 0.25, 0.5, 0.75, 1}});
  SplineResult spline;
  spline.breaks = {0, 1};
  spline.peaks[2] = 6;
  spline.coefficients = {0, 0, 0, 6, 6, 6, 6};
  EXPECT_EQ(halve_at_changes(task, basis, spline).size(), basis.size());
  spline.coefficients[6] = -6;
  EXPECT_EQ(halve_at_changes(task, basis, spline).section(0).breaks(),
            (std::vector<double>{0, 0.25, 0.5, 0.625, 0.75, 0.875, 1}));
}

TEST(RefinePieces, PiecesAreNotHalvedBelowWhatCoefficientsCanTell) {
  const LawTask task = make_law_task(testing::rest_to_rest(10, 1));
  LawBasis basis(3, {halves});
  SplineResult spline;
  spline.breaks = {0, 1};
  spline.peaks[2] = 6;
  for (int round = 0; round < 60; ++round) {
    spline.coefficients.assign(basis.size(), 0);
    spline.coefficients.back() = 6;
    basis = halve_at_changes(task, basis, spline);
  }
  const SectionBasis& own = basis.section(0);
  EXPECT_LT(own.pieces(), 40u);
  EXPECT_LE(published_rounding(task, 3, own.length(own.pieces() - 1), 2), 1e-10 * spline.peaks[2]);
}

}  // namespace
}  // namespace bahnwerk::cam
