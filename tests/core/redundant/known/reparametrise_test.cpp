#include "core/redundant/known/reparametrise.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/motion/law/dwell.hpp"
#include "core/numeric/random.hpp"
#include "tests/core/redundant/chosen_plan.hpp"
#include "tests/core/redundant/frames.hpp"
#include "tests/core/redundant/known/known_plans.hpp"

namespace bahnwerk {
namespace {

using test::expect_valid, test::known_methods, test::plan;

/// [Bock chapter 5]: never longer, and what the source's methods leave is found.
TEST(KnownMethods, RetimedTheyAreValidAndShorter) {
  for (const CoarseFineMachine& machine : {test::md1(), test::md2()}) {
    const RedundancyTask task = test::redundancy_task(test::holes(4, 3, 12, 2), machine);
    RedundancyOptions options;
    options.reparametrise = true;
    for (const RedundancyMethod method : known_methods) {
      SCOPED_TRACE(name_of<RedundancyMethod>(method, redundancy_methods));
      const RedundancyResult before = plan(task, method);
      options.method = method;
      const RedundancyResult after = test::chosen(task, options);
      expect_valid(task, after);
      EXPECT_LE(after.head->duration(), before.head->duration());
      // The filters' reference limits were lowered for the worst place, and hold elsewhere, too.
      if (method == RedundancyMethod::filter || method == RedundancyMethod::lag_compensation) {
        EXPECT_LT(after.head->duration(), 0.9 * before.head->duration());
      }
    }
  }
}

/// Dwells stay pieces of their own, and the head comes to rest exactly, however short the last way is.
TEST(KnownMethods, RetimedMotionsRestWhereTheyDid) {
  Random random(16);
  for (int n = 0; n < 4; ++n) {
    SCOPED_TRACE(n);
    const Contour contour = test::random_contour(random, 60, 4, 4);
    const RedundancyTask task = test::redundancy_task(contour, n % 2 ? test::md1() : test::md2());
    RedundancyOptions options;
    options.method = RedundancyMethod::filter;  // the head also waits at both ends
    options.reparametrise = true;
    const RedundancyResult r = test::chosen(task, options);
    std::size_t dwelt = 0, lasting = 0;
    for (const Rest& rest : contour.rests) lasting += rest.seconds > 0;
    const auto& pieces = r.head->law().pieces();
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      dwelt += dwells(pieces[i]);
      const bool stops = i + 1 == pieces.size() || pieces[i + 1].v == 0;
      const LawPiece& p = pieces[i];
      const LawState end = p.at(p.duration);
      if (stops) {
        EXPECT_LE(std::abs(end.v), 1e-14 * (p.v + (std::abs(p.a) + std::abs(end.a)) * p.duration)) << i;
      }
    }
    EXPECT_EQ(dwelt, lasting + 2);
  }
}

/// What no axis drives near a limit is found, wherever the motion begins and ends: 5.2.3.
TEST(KnownMethods, RetimedIterativePlansAreShorter) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    const RedundancyTask task = test::redundancy_task(test::framed(seed, {}), test::md2());
    RedundancyOptions options;
    options.method = RedundancyMethod::iterative;
    const RedundancyResult before = plan(task, RedundancyMethod::iterative);
    options.reparametrise = true;
    const RedundancyResult after = test::chosen(task, options);
    expect_valid(task, after);
    EXPECT_LT(after.head->duration(), (seed == 2 ? 0.98 : 0.9998) * before.head->duration());
  }
}

}  // namespace
}  // namespace bahnwerk
