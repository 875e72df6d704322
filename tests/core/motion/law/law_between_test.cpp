// Pieces of a law from state to state.
#include "core/motion/law/law_between.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

TEST(LawBetween, MeetsBothStatesWhateverTheDurationGiven) {
  Random random(1);
  for (int n = 0; n < 1000; ++n) {
    LawPiece piece;  // a quartic that goes forwards
    piece.s = random.uniform(0, 100), piece.v = random.uniform(10, 20), piece.a = random.uniform(-10, 10);
    piece.j = random.uniform(-20, 20), piece.snap = random.uniform(-20, 20);
    const double duration = random.uniform(0.1, 0.5);
    const LawState from = piece.at(0), to = piece.at(duration);
    TimeLaw law;
    law.append({0, 1, 0, piece.s, 0, 0, 0, 2, 0});
    append_between(law, 3, from, to, duration * random.uniform(0.9, 1.1));
    const LawPiece& made = law.pieces().back();
    EXPECT_EQ(made.t0, 1);
    EXPECT_EQ(made.segment, 3U);
    EXPECT_EQ(made.s_end, to.s);
    EXPECT_NEAR(made.duration, duration, 1e-12);
    EXPECT_NEAR(made.j, piece.j, 1e-8);
    EXPECT_NEAR(made.snap, piece.snap, 1e-6);
    const LawState end = made.at(made.duration);
    EXPECT_NEAR(end.s, to.s, 1e-12 * to.s);
    EXPECT_NEAR(end.v, to.v, 1e-11);
    EXPECT_NEAR(end.a, to.a, 1e-9);
  }
}

TEST(LawBetween, HasConstantJerkFromRest) {
  TimeLaw law;
  append_between(law, 0, {0, 0, 0, 0}, {6.0 * 8 / 6, 6.0 * 4 / 2, 12, 0}, 1.9);
  EXPECT_NEAR(law.duration(), 2, 1e-12);
  EXPECT_NEAR(law.pieces().front().j, 6, 1e-10);
  EXPECT_NEAR(law.pieces().front().snap, 0, 1e-9);
}

}  // namespace
}  // namespace bahnwerk
