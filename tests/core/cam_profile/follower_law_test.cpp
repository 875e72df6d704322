#include "core/cam_profile/follower_law.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/base/progress.hpp"
#include "tests/core/cam_profile/cam_laws.hpp"
#include "tests/core/cases.hpp"

namespace bahnwerk::cam {
namespace {

TEST(FollowerLaw, DerivativesAreByTheCamsAngle) {
  const FollowerLaw law(test::rise_and_return(ClassicalLaw::modified_sine, 20, 90, 90, 90, 90), 1);
  double steepest = 0;
  for (int k = 0; k <= 1000; ++k) steepest = std::max(steepest, law.at(0, k / 1000.0).derivative(1));
  for (std::size_t i = 1; i < law.pieces(); ++i)
    for (int k = 0; k <= 1000; ++k) steepest = std::max(steepest, law.at(i, k / 1000.0).derivative(1));
  EXPECT_NEAR(steepest, 1.759603 * 20 / (90 * test::deg), 1e-4);
  EXPECT_NEAR(law.stroke(), 20, 1e-12);
}

TEST(FollowerLaw, NoSampleIsAboveTheCertifiedMaximum) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> coefficient(-10, 10);
  Progress silent;
  for (int n = 0; n < bahnwerk::testing::cases(40); ++n) {
    std::vector<LawPiece> pieces;
    for (std::size_t i = 0; i < 3; ++i) {
      std::vector<double> b(7);
      for (double& each : b) each = coefficient(random);
      pieces.push_back({i, b});
    }
    const FollowerLaw law(CamLaw({0, 0.3, 0.7, 1}, pieces, true), 1);
    const auto function = [](const LawSeries<Disc>& y) {
      const LawSeries<Disc> slope = derived(y);
      return slope / sqrt(LawSeries<Disc>(400) + y * y + slope * slope);
    };
    const CertifiedMaximum found = certified_maximum(law, function, 1e-12, silent);
    EXPECT_LE(found.value, found.upper);
    EXPECT_LE(found.upper, found.value + 1.1e-7 * std::abs(found.value) + 1e-12);
    double most = -1e9;
    for (std::size_t i = 0; i < 3; ++i)
      for (int k = 0; k <= 2000; ++k) {
        const LawSeries<double> y = law.at(i, k / 2000.0);
        const double d = y.derivative(1);
        most = std::max(most, d / std::sqrt(400 + y.value() * y.value() + d * d));
      }
    EXPECT_LE(most, found.upper);
    EXPECT_NEAR(most, found.value, 1e-3);
  }
}

}  // namespace
}  // namespace bahnwerk::cam
