#include "core/plan/coarse_fine/rms.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "core/motion/axes/spline_motion.hpp"

namespace bahnwerk {
namespace {

/// The head accelerates at 100 for 1 s and stands for 3 s; its coarse axis takes 40 of that for half a second.
TEST(Rms, IsOfCoarseAxesAndOfWhatTheyLeave) {
  std::vector<SplineMotion::Piece> head(2), coarse(2);
  head[0].end = 1, head[0].axes = {Polynomial{0, 0, 50}};
  head[1].end = 4, head[1].axes = {Polynomial{50}};
  coarse[0].end = 0.5, coarse[0].axes = {Polynomial{0, 0, 20}};
  coarse[1].end = 4, coarse[1].axes = {Polynomial{5, 20}};
  Progress progress;
  ProgressScope scope(progress, "report");
  const RmsAccelerations rms = rms_accelerations(SplineMotion(std::move(head)), SplineMotion(std::move(coarse)), scope);
  EXPECT_NEAR(rms.coarse[0], std::sqrt(40 * 40 * 0.5 / 4), 1e-12);
  EXPECT_NEAR(rms.fine[0], std::sqrt((60 * 60 * 0.5 + 100 * 100 * 0.5) / 4), 1e-12);
}

}  // namespace
}  // namespace bahnwerk
