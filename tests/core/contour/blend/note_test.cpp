#include "core/contour/blend/note.hpp"

#include <gtest/gtest.h>

#include "core/contour/builder.hpp"
#include "tests/core/silent_scope.hpp"

namespace bahnwerk::blending {
namespace {

/// Turns by the angle at (10, 0).
Contour bent(double angle) {
  ContourBuilder builder(2, {0, 0, 0});
  builder.block(Mode::cut, 100);
  builder.line({10, 0, 0});
  builder.line({10 + 10 * std::cos(angle), 10 * std::sin(angle), 0});
  return builder.finish();
}

std::vector<std::string> notes(Contour contour, const BlendCount& count) {
  BlendOptions options;
  options.tolerance = 0.05;
  note(contour, count, options, silent_scope());
  return contour.notes;
}

TEST(BlendNote, SaysWhatWasBlended) {
  BlendCount count;
  count.corners = 3, count.runs = 2, count.run_segments = 17;
  EXPECT_EQ(notes(bent(0), count),
            (std::vector<std::string>{"blended within 0.05 mm: 3 joints, 2 runs of 17 short segments"}));
}

TEST(BlendNote, CountsCornersAndSmallJumpsApart) {
  const auto corner = notes(bent(1), {});
  ASSERT_EQ(corner.size(), 2u);
  EXPECT_EQ(corner[1], "1 corners not blended (reversals, borders of cutting), the first at 10 mm");
  const auto jump = notes(bent(1e-5), {});
  ASSERT_EQ(jump.size(), 2u);
  EXPECT_EQ(jump[1], "1 tangent jumps below the corner angle left");
  EXPECT_EQ(notes(bent(1e-8), {}).size(), 1u);
}

TEST(BlendNote, NamesTheFirstPlaceThatCouldNotBeSmoothed) {
  BlendCount count;
  count.failed = 2, count.first_failed = {1.5, -2, 7};
  EXPECT_EQ(notes(bent(0), count).back(), "2 joints could not be blended within the tolerance, the first at 1.5, -2");
  Contour spatial = bent(0);
  spatial.dimension = 3;
  EXPECT_EQ(notes(spatial, count).back(),
            "2 joints could not be blended within the tolerance, the first at 1.5, -2, 7");
}

}  // namespace
}  // namespace bahnwerk::blending
