// Rounding is never slower than stopping: section by section the quicker of both is driven.
#include "core/plan/contour/rounding_choice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/contour/builder.hpp"
#include "core/plan/contour/contour_plan.hpp"
#include "tests/core/plan/contour/verified_plans.hpp"
#include "tests/core/plan/random_contour.hpp"

namespace bahnwerk {
namespace {

constexpr double pi = 3.14159265358979323846;

using test::axes_alike, test::verified_plan;

bool kept(const ContourPlan& p) {
  return std::any_of(p.notes.begin(), p.notes.end(),
                     [](const std::string& note) { return note.find("driven as given") != std::string::npos; });
}

/// Arcs of a quarter of a turn at most, each tangent to the next and a little wider.
void spiral(ContourBuilder& b, Vec at, Random& random, int arcs) {
  double radius = 5, angle = 0;
  Vec centre = at - Vec{radius, 0, 0};
  for (int i = 0; i < arcs; ++i) {
    const double turn = random.uniform(0.3, 1.0) * pi / 2;
    angle += turn;
    const Vec out{std::cos(angle), std::sin(angle), 0};
    b.arc(centre + radius * out, centre, true);
    const double grown = 0.15 * turn / (pi / 2);
    radius += grown;
    centre = centre - grown * out;
  }
}

// Where little jerk is allowed, smoothing the steps of curvature between tangent arcs may cost more than it brings.
TEST(RoundingChoice, ASpiralOfTangentArcsIsNotSlower) {
  int stayed = 0;
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    Random random(seed);
    ContourBuilder b(2, {5, 0, 0});
    b.block(Mode::cut, 1000);
    spiral(b, {5, 0, 0}, random, 300);
    const Contour contour = b.finish();
    const double stops = verified_plan(contour, axes_alike(1e5), PlanningMethod::jerk_limited, 0).duration;
    const ContourPlan rounded = verified_plan(contour, axes_alike(1e5), PlanningMethod::jerk_limited, 0.02);
    EXPECT_LE(rounded.duration, stops * (1 + 1e-9)) << "seed " << seed;
    stayed += kept(rounded) ? 1 : 0;
  }
  EXPECT_GT(stayed, 0);
}

// Sections that stay and sections that are rounded, with a dwell, blocks and modes between them.
TEST(RoundingChoice, SectionsOfBothKindsMakeOneMotion) {
  Random random(3);
  ContourBuilder b(2, {0, 0, 0});
  b.block(Mode::position, unlimited);
  b.line({5, 0, 0});
  b.block(Mode::cut, 1000);
  spiral(b, {5, 0, 0}, random, 300);
  b.dwell(0.25);
  b.block(Mode::cut, 200);
  b.line({100, 0, 0});
  b.line({100, 40, 0});
  b.line({60, 40, 0});
  b.block(Mode::cut, 300);
  b.line({60, 70, 0});
  const Contour contour = b.finish();
  const Machine m = axes_alike(1e5);
  const ContourPlan stops = verified_plan(contour, m, PlanningMethod::jerk_limited, 0),
                    rounded = verified_plan(contour, m, PlanningMethod::jerk_limited, 0.02);
  EXPECT_TRUE(kept(rounded));
  const auto time = [](const ContourPlan& p, std::size_t block) {
    return p.blocks[block].end_time - p.blocks[block].start_time;
  };
  ASSERT_EQ(rounded.blocks.size(), 4u);
  // As setpoints both are slowed to whole cycles, by less than one in all.
  EXPECT_NEAR(time(rounded, 1), time(stops, 1), 2e-3);
  EXPECT_EQ(rounded.blocks[1].length, stops.blocks[1].length);
  EXPECT_LT(time(rounded, 2) + time(rounded, 3), time(stops, 2) + time(stops, 3) - 3e-3);  // this is rounded
  EXPECT_LT(rounded.blocks[2].length, stops.blocks[2].length);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_GT(rounded.blocks[k].length, 0) << k;
}

// Both handles retracted, one of them but for 2.5e-12: what is kept, or driven with stops, is the same segment.
TEST(RoundingChoice, ACurveThatIsKeptIsNotCutAgain) {
  ContourBuilder b(2, {2, 1, 0});
  b.polynomial({{2, 0, 3, -2, -2.5e-12, 2.5e-12}, {1, 0, 0.4, -0.8, 0.4}});
  b.line({9, 1, 0});
  const Contour contour = b.finish();
  ASSERT_EQ(contour.path.size(), 2U);
  for (const PlanningMethod method : {PlanningMethod::time_optimal, PlanningMethod::jerk_limited}) {
    const Machine m = axes_alike(method == PlanningMethod::jerk_limited ? 1e6 : HUGE_VAL);
    const double stops = verified_plan(contour, m, method, 0).duration;
    EXPECT_LE(verified_plan(contour, m, method, 0.01).duration, stops * (1 + 1e-9));
  }
}

TEST(RoundingChoice, RoundedSectionsStayWhereRoundingIsFaster) {
  ContourBuilder b(2, {});
  b.block(Mode::cut, 500);
  for (int i = 1; i < 20; ++i) b.line({5.0 * i, i % 2 * 3.0, 0});
  const Contour contour = b.finish();
  for (const PlanningMethod method : {PlanningMethod::time_optimal, PlanningMethod::jerk_limited})
    EXPECT_FALSE(kept(verified_plan(contour, axes_alike(1e6), method, 0.02)));
}

/// 1 to 12 lines and arcs, tangent, nearly tangent or not, of every size, jerk from 1e4 to 1e8.
class RoundingChoiceRandom : public ::testing::TestWithParam<int> {};

TEST_P(RoundingChoiceRandom, RoundedIsNeverSlowerThanWithStops) {
  for (int n = 0; n < 40; ++n) {
    const int seed = 7'000'000 + 1000 * GetParam() + n;
    SCOPED_TRACE(seed);
    Random random(static_cast<std::uint64_t>(seed));
    auto outline = testing::random_outline(random, 1 + random.below(12), 2);
    for (testing::Shape& shape : outline.shapes)  // lines for free-form pieces: those are tested elsewhere, slowly
      if (shape.kind == testing::Shape::polynomial || shape.kind == testing::Shape::nurbs)
        shape.kind = testing::Shape::line;
    const Contour contour = testing::build(outline);
    const Machine m = axes_alike(std::pow(10, random.uniform(4, 8)));
    const double tolerance = std::pow(10, random.uniform(-2.5, -0.5));
    for (const PlanningMethod method : {PlanningMethod::time_optimal, PlanningMethod::jerk_limited}) {
      const double stops = verified_plan(contour, m, method, 0).duration,
                   rounded = verified_plan(contour, m, method, tolerance).duration;
      // time_optimal refines its grid until it is within 5e-6 of its bound, each path for itself.
      EXPECT_LE(rounded, stops * (1 + (method == PlanningMethod::jerk_limited ? 1e-9 : 5e-6)));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shard, RoundingChoiceRandom, ::testing::Range(0, 4));

}  // namespace
}  // namespace bahnwerk
