// Links by a time that is known in closed form: the search has to find it, and keep away from what is no link.
#include "core/winding/path/quick_links.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/base/progress.hpp"
#include "tests/core/winding/path/needle_pieces.hpp"

namespace bahnwerk::winding {
namespace {

double length(std::span<const BezierPiece> pieces) {
  double sum = 0;
  for (const BezierPiece& piece : pieces)
    for (int i = 0; i < 200; ++i) sum += norm(place(piece.at((i + 0.5) / 200)[1])) / 200;
  return sum;
}

struct Paths {
  std::vector<FixedPiece> pieces;
  LinkOptions options;
  NeedlePath smooth;
  explicit Paths(bool stator, std::size_t turns) : pieces(stator ? stator_pieces(turns) : rotor_pieces(turns)) {
    Progress progress;
    smooth = *needle_path(pieces, stator, options, progress);
  }
  QuickLinks quick(const PieceTimer& time) const {
    Progress progress;
    return quick_links(pieces, smooth, smooth, options, time, progress);
  }
};

// A needle of constant speed: the shortest links are the quickest.
TEST(QuickLinks, AreShorterForAConstantSpeed) {
  for (const bool stator : {true, false}) {
    const Paths paths(stator, 3);
    const QuickLinks quick = paths.quick(length);
    EXPECT_GT(quick.changed, paths.smooth.links.size() / 2);
    EXPECT_LT(length(quick.path.curves()), length(paths.smooth.curves()) - 1e-3);
    // Later turns start from the first: far fewer calls than 85 per link.
    EXPECT_LT(quick.evaluations, 60 * paths.smooth.links.size());
  }
}

TEST(QuickLinks, JoinAsTheSmoothOnesDo) {
  const Paths paths(true, 2);
  const auto all = paths.quick(length).path.curves();
  for (std::size_t order = 0; order <= 3; ++order) EXPECT_LE(worst_jump(all, order), 1e-8) << order;
}

TEST(QuickLinks, StayWhereNothingIsGainedOrKnown) {
  const Paths paths(false, 1);
  for (const double time : {1.0, std::numeric_limits<double>::infinity()}) {
    const QuickLinks same = paths.quick([&](std::span<const BezierPiece>) { return time; });
    EXPECT_EQ(same.changed, 0u);
    EXPECT_EQ(length(same.path.curves()), length(paths.smooth.curves()));
  }
}

// However much a timer likes loops and bends, links stay near the smooth ones.
TEST(QuickLinks, NeitherLoopNorRoughen) {
  const Paths paths(true, 1);
  const QuickLinks quick = paths.quick([](std::span<const BezierPiece> pieces) { return 1e6 - length(pieces); });
  for (std::size_t i = 0; i < quick.path.links.size(); ++i) {
    const NeedleLink &now = quick.path.links[i], &before = paths.smooth.links[i];
    EXPECT_LE(now.best.smoothness, 5 * before.best.smoothness * (1 + 1e-9));
    EXPECT_LE(now.curvature, before.curvature + 0.5 + 1e-9);
  }
}

}  // namespace
}  // namespace bahnwerk::winding
