// Enclosures of the tool's pose and of the axes against samples, on lines, arcs, and rational curves.
#include "core/motion/axes/pose_discs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/motion/axes/axis_path.hpp"
#include "needle_loop.hpp"
#include "tests/core/machine/winders.hpp"

namespace bahnwerk {
namespace {

/// A rational curve, and a rational turn of the needle along it.
test::NeedlePath bow() {
  test::NeedleMaker make;
  const std::vector<double> weights{1, 1.6, 0.8, 1.2};
  make.append(
      std::make_shared<Rational>(Rational::bezier({{70, 5, 40}, {90, 30, 60}, {70, 60, 80}, {40, 70, 60}}, weights)),
      std::make_shared<Rational>(
          Rational::bezier({{0.1, 0.2, 0}, {0.3, 0.4, 0}, {0.5, -0.2, 0}, {0.9, 0.1, 0}}, weights)));
  return make.done();
}

void expect_inside(double value, const Disc& disc, double scale, const std::string& what) {
  EXPECT_LE(std::abs(value - disc.centre), disc.radius + 1e-13 * scale) << what;
}

TEST(PoseDiscs, HoldThePoseAndItsDerivatives) {
  for (const test::NeedlePath& path : {test::stator_turn(), test::helix(60, 2.5, 40), bow()}) {
    const PoseDiscs discs(path.tool, path.orientation);
    for (std::size_t i = 0; i < path.tool.size(); ++i)
      for (const double half : {0.05, 0.002}) {
        for (double u = half; u < 1; u += 0.113) {
          ToolDiscs pose;
          ASSERT_TRUE(discs.enclose(path.tool[i], i, u, half, pose)) << i << ' ' << u;
          for (int j = -4; j <= 4; ++j) {
            const double v = std::clamp(u + half * j / 4, 0.0, 1.0);
            const ToolJet at = path.orientation->tool(path.tool[i], i, v);
            for (std::size_t k = 0; k < 5; ++k) {
              const AngleJet& angle = k == 3 ? at.phi : at.psi;
              const bool place = k < 3;
              const double d[] = {place ? at.position.value[k] : angle.value, place ? at.position.d1[k] : angle.d1,
                                  place ? at.position.d2[k] : angle.d2, place ? at.position.d3[k] : angle.d3};
              for (std::size_t n = 0; n <= 3; ++n)
                expect_inside(d[n], pose[k].derivative(n), n == 0 ? 1000 : 1,
                              std::to_string(i) + " coordinate " + std::to_string(k) + " order " + std::to_string(n));
            }
          }
        }
        if (HasFailure()) return;
      }
  }
}

TEST(PoseDiscs, AxesOfEveryMachineAreHeldTightly) {
  const test::NeedlePath path = test::stator_turn();
  for (const test::Winder& winder : test::winders()) {
    const KinematicAxisPath axes(path.tool, *winder.configurations.back(), path.orientation);
    for (std::size_t i = 0; i < path.tool.size(); ++i) {
      std::array<double, 5> most{};
      for (int j = 0; j <= 100; ++j) {
        const AxisJet q = axes.at_parameter(i, j / 100.0);
        for (std::size_t k = 0; k < 5; ++k) most[k] = std::max(most[k], std::abs(q.d2[k]));
      }
      for (double u = 0.011; u < 0.99; u += 0.0567) {
        const double half = 0.002;
        AxisDiscs discs;
        ASSERT_TRUE(axes.enclose(i, u, half, discs)) << winder.name << ' ' << i << ' ' << u;
        for (int j = -4; j <= 4; ++j) {
          const AxisJet q = axes.at_parameter(i, u + half * j / 4);
          for (std::size_t k = 0; k < 5; ++k) {
            expect_inside(q.d1[k], discs.d1[k], 1, winder.name + " q'");
            expect_inside(q.d2[k], discs.d2[k], 1, winder.name + " q''");
            expect_inside(q.d3[k], discs.d3[k], 1, winder.name + " q'''");
          }
        }
        // Over 1/250 of a segment little is left open beside what axes do in it; sums are enclosed term by term.
        const double largest = *std::max_element(most.begin(), most.end());
        for (std::size_t k = 0; k < 5; ++k)
          EXPECT_LE(discs.d2[k].radius, 0.2 * largest + 1e-12) << winder.name << ' ' << k << " at " << u;
        if (HasFailure()) return;
      }
    }
  }
}

TEST(PoseDiscs, NothingIsKnownWhereTheTangentMayVanish) {
  test::NeedleMaker make;
  make.append(std::make_shared<Rational>(Rational::bezier({{0, 0, 0}, {40, 0, 0}, {40, 1, 0}, {0, 1, 0}})),
              std::make_shared<Line>(Vec{}, Vec{}));
  const test::NeedlePath path = make.done();
  const PoseDiscs discs(path.tool, path.orientation);
  ToolDiscs pose;
  EXPECT_FALSE(discs.enclose(path.tool[0], 0, 0.5, 0.3, pose));
  EXPECT_TRUE(discs.enclose(path.tool[0], 0, 0.5, 1e-3, pose));
}

}  // namespace
}  // namespace bahnwerk
