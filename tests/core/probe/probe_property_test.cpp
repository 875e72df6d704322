// Random sets of points: every method ends with a motion that keeps everything.
#include "core/base/progress.hpp"
#include "core/probe/arcs/arcs.hpp"
#include "core/probe/spline/spline.hpp"
#include "core/probe/straight/stops.hpp"
#include "tests/core/cases.hpp"
#include "tests/core/probe/probe_cases.hpp"

namespace bahnwerk {
namespace {

using namespace probe_cases;

/// Plans and checks one random problem; a line that says what it was.
TEST(ProbeProperty, EveryMethodEndsVerifiedAndArcsAreNeverSlowerThanRests) {
  double arcs_to_stops = 0, spline_to_stops = 0;
  const int n = testing::cases(16);
  for (int i = 0; i < n; ++i) {
    const RandomSet set(static_cast<std::uint64_t>(i));
    SCOPED_TRACE(set.words);
    Progress silent;
    const double stops = stops_duration(set.problem);
    const ProbeMotion arcs = plan_arcs(set.problem, silent), spline = plan_spline(set.problem, silent);
    expect_right(set.problem, arcs, "arcs");
    expect_right(set.problem, spline, "spline");
    EXPECT_LE(arcs.duration(), stops * (1 + 1e-12));
    EXPECT_LE(spline.duration(), stops * (1 + 1e-12));
    arcs_to_stops += arcs.duration() / stops / n, spline_to_stops += spline.duration() / stops / n;
    if (std::getenv("PROBE_VERBOSE"))
      std::printf("%d %s: stops %.6g arcs %.4f spline %.4f\n", i, set.words.c_str(), stops, arcs.duration() / stops,
                  spline.duration() / stops);
  }
  EXPECT_LT(arcs_to_stops, 0.95);
  if (std::getenv("PROBE_VERBOSE")) std::printf("means %.4f %.4f\n", arcs_to_stops, spline_to_stops);
}

}  // namespace
}  // namespace bahnwerk
