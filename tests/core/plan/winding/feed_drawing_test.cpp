// The drawing of the feed and of what limits leave to it.
#include "core/plan/winding/feed_drawing.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/base/progress.hpp"
#include "tests/core/machine/winders.hpp"

namespace bahnwerk {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(FeedDrawing, HasACurvePerAxisAndTheFeedAndItsLimits) {
  WindingRequest r;
  const winding::RotorPart part;
  r.part = part;
  r.wire = *winding::standard_wire(0.9, 2);
  r.coils = {winding::coil_between(part, 0, 1)};
  r.turns = 1;
  r.least_clearance = -100;
  r.configurations = test::winders()[2].configurations;
  r.feed = PlanningMethod::constant;
  for (const bool limited : {false, true}) {
    if (limited) r.chord_tolerance = 0.005;
    Progress progress;
    const WindingPlan plan = plan_winding(r, progress);
    const std::string svg = feed_drawing(r, plan);
    EXPECT_TRUE(svg.starts_with("<svg")) << svg.substr(0, 40);
    EXPECT_TRUE(svg.ends_with("</svg>\n"));
    for (const char* name : {"acceleration along the path", "jerk along the path"})
      EXPECT_NE(svg.find(name), std::string::npos) << name;
    for (const char* name : {"limits of q1", "limits of q5", ">feed<", "arc length in mm", "feed in mm/s"})
      EXPECT_NE(svg.find(name), std::string::npos) << name;
    EXPECT_EQ(count(svg, "feed's limits"), limited ? 1U : 0U);
    EXPECT_EQ(count(svg, "stroke-dasharray"), limited ? 2U : 0U);  // the curve and its sample
    EXPECT_EQ(count(svg, "nan") + count(svg, "inf"), 0U);
    EXPECT_LT(svg.size(), 100'000U);
  }
}

}  // namespace
}  // namespace bahnwerk
