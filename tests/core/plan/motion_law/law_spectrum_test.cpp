#include "core/plan/motion_law/law_spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/cam/cam_law.hpp"

namespace bahnwerk {
namespace {

TEST(LawSpectrum, OfAParabolaUpAndDownTheOddHarmonicsFallAsOneOverK) {
  // The acceleration is +A over one half of the cycle and −A over the other: amplitudes 4 A/(π k) for odd k.
  const double A = 3, T = 0.8, rise = A * T * T / 8;
  const cam::CamLaw law({0, T / 2, T}, {{0, {0, 0, rise}}, {0, {rise, 2 * rise, 2 * rise}}}, false);
  const auto found = acceleration_spectrum(law, 60);
  ASSERT_EQ(found.size(), 60u);
  for (std::size_t k = 1; k <= found.size(); ++k)
    EXPECT_NEAR(found[k - 1], k % 2 == 1 ? 4 * A / (std::numbers::pi * static_cast<double>(k)) : 0, 1e-9 * A) << k;
}

TEST(LawSpectrum, TimeThatBeginsLaterChangesNoAmplitude) {
  const std::vector<cam::LawPiece> pieces{{0, {0, 0, 0, 1, 0.5}}, {0, {0.5, 0, 0, 0}}};
  const auto here = acceleration_spectrum({{0, 1, 3}, pieces, false}, 40),
             later = acceleration_spectrum({{10, 11, 13}, pieces, false}, 40);
  for (std::size_t k = 0; k < here.size(); ++k) EXPECT_NEAR(here[k], later[k], 1e-11);
}

TEST(LawSpectrum, ManySectionsHaveMoreHarmonicsWithinBounds) {
  for (const auto& [points, shown] : std::vector<std::pair<std::size_t, std::size_t>>{{3, 40}, {20, 80}, {90, 200}}) {
    cam::MotionLawProblem problem;
    problem.periodic = true;
    problem.points.resize(points);
    EXPECT_EQ(shown_harmonics(problem), shown) << points;
  }
}

}  // namespace
}  // namespace bahnwerk
