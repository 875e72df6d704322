// Past the posts of the winding tools: beside them where they stand in the way, the source's path where they do not.
#include "core/winding/path/post_passage.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/numeric/random.hpp"
#include "core/winding/path/needle_path.hpp"
#include "tests/core/winding/path/needle_pieces.hpp"

namespace bahnwerk::winding {
namespace {

const NeedleShape needle_shape{1.6, 60};

StatorPart part_with(double tool_shift, double tool_height = 10) {
  StatorPart part;
  part.heads.tool_shift = tool_shift, part.heads.tool_height = tool_height;
  return part;
}

struct Passing {
  StatorPart part;
  std::vector<Coil> coils;
  std::vector<FixedPiece> pieces;
  PostPassage posts;
  LinkOptions options;
  Passing(double tool_shift, int span, std::size_t turns, std::size_t count = 1, double clearance = 0,
          double tool_height = 10)
      : part(part_with(tool_shift, tool_height)),
        coils(stator_coils(part, count, span)),
        pieces(stator_pieces(part, coils, turns, needle_shape)),
        posts(part, coils, {}, needle_shape, clearance) {}

  NeedlePath path(bool beside) const {
    Progress progress;
    return *needle_path(pieces, true, options, progress, beside ? &posts : nullptr);
  }
  /// The least over the links.
  double room(const NeedlePath& path) const {
    Progress progress;
    double least = 1e9;
    for (const NeedlePiece& piece : path.pieces)
      if (piece.link) least = std::min(least, posts.from_all(coil_of(piece, pieces), {&piece.curve, 1}, progress));
    return least;
  }
};

// A post of 4 mm before the middle of the slot: on the slot's radius the needle goes right through it.
TEST(PostPassage, LinksGoRoundPostsThatStandInTheWay) {
  for (const int span : {5, 43})  // counterclockwise, clockwise
    for (const double shift : {0.0, 1.2}) {
      const Passing p(shift, span, 6, 2);
      EXPECT_LT(p.room(p.path(false)), -1) << span << " " << shift;
      EXPECT_GE(p.room(p.path(true)), 0) << span << " " << shift;
    }
}

TEST(PostPassage, KeepsTheClearanceThatIsAskedFor) {
  const Passing p(0, 5, 3, 1, 0.3);
  EXPECT_GE(p.room(p.path(true)), 0.3);
}

// The tip passes above posts of 20 mm.
TEST(PostPassage, PathIsTheSourcesWhereNoPostIsInTheWay) {
  const Passing p(0, 5, 6, 1, 0, 25);
  const NeedlePath with = p.path(true), without = p.path(false);
  ASSERT_EQ(with.pieces.size(), without.pieces.size());
  for (std::size_t i = 0; i < with.pieces.size(); ++i)
    EXPECT_TRUE(with.pieces[i].curve.points() == without.pieces[i].curve.points()) << i;
}

TEST(PostPassage, JoinsAndSwivelsAsWithoutPosts) {
  const Passing p(0, 5, 3);
  const NeedlePath path = p.path(true);
  const auto all = path.curves();
  for (std::size_t order = 0; order <= 3; ++order) EXPECT_LE(worst_jump(all, order), 1e-8) << order;
  for (const BezierPiece& piece : all)
    for (int i = 0; i <= 50; ++i) EXPECT_LE(std::abs(piece.at(i / 50.0)[0][4]), std::numbers::pi / 2 + 1e-9);
}

// A needle that stands along the part's axis, at every place, for any coil.
TEST(PostPassage, AllPlacesKeepTheClearanceOfTheStandingNeedle) {
  Random random(5);
  for (int n = 0; n < 300; ++n) {
    const double shift = random.uniform(0, 3), clearance = random.uniform(-0.5, 1);
    const StatorPart part = part_with(shift);
    const int first = static_cast<int>(random.uniform(0, 47)), span = (n % 2 == 0 ? 1 : -1) * (2 + n % 9);
    const Coil coil{first, span};
    const NeedleShape needle{random.uniform(0.5, 3), 60};
    const ToolPost post{random.uniform(2, 6), random.uniform(1, 5), 20};
    const PostPassage posts(part, {coil}, post, needle, clearance);
    const std::vector<Block> blocks = tool_posts(part, post, coil);
    for (const bool second : {false, true}) {
      Way way{0, second, {}, {}};
      way.slot.tip = turned({85, random.uniform(-1, 1), 215}, (first + (second ? span : 0)) * part.pitch());
      for (std::size_t place = 0; place < PostPassage::places; ++place) {
        const ExtraPoint at = posts.beside(way, place);
        Vec3 tip = at.radius * radial(at.azimuth);
        tip.z = part.heads.stack + 10;
        const double from_post = blocks[second ? 3 : 1].distance(tip) - needle.width / 2;
        EXPECT_GE(from_post, std::max(clearance, -needle.width / 2) + 0.1 - 1e-9) << n << " " << place;
        EXPECT_LE(at.radius, std::hypot(part.heads.tool_radius, from_post + needle.width + 10));
      }
    }
  }
}

// The link down to the next coil passes the posts of that, not those of the coil that is done.
TEST(PostPassage, ALinkFromACoilChangeBelongsToTheNextCoil) {
  const Passing p(2.5, 5, 1, 2);
  const NeedlePath path = p.path(true);
  std::size_t changes = 0;
  for (const NeedlePiece& piece : path.pieces) {
    const bool change = p.pieces[piece.fixed].kind == FixedPiece::Kind::coil_change;
    EXPECT_EQ(coil_of(piece, p.pieces), p.pieces[piece.fixed].coil + (change && piece.link ? 1 : 0));
    changes += change && piece.link;
  }
  EXPECT_EQ(changes, 2u);
}

TEST(PostPassage, RefusesPostsThatAreNone) {
  const StatorPart part;
  EXPECT_THROW(PostPassage(part, stator_coils(part, 1), {0, 3, 20}, needle_shape, 0), InvalidInput);
}

}  // namespace
}  // namespace bahnwerk::winding
