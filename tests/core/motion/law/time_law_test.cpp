#include "core/motion/law/time_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace bahnwerk {
namespace {

TimeLaw trapezoid() {  // 0 → 10 mm/s in 1 s, hold 2 s, brake 1 s
  TimeLaw law;
  law.append({0, 1, 0, 5, 0, 10, 0, 0});
  law.append({0, 2, 5, 25, 10, 0, 0, 0});
  law.append({0, 1, 25, 30, 10, -10, 0, 0});
  return law;
}

TEST(TimeLaw, PiecesFollowEachOther) {
  const TimeLaw law = trapezoid();
  EXPECT_DOUBLE_EQ(law.duration(), 4);
  EXPECT_DOUBLE_EQ(law.pieces()[2].t0, 3);
  const LawState end = law.pieces()[2].at(1);
  EXPECT_DOUBLE_EQ(end.s, 30);
  EXPECT_DOUBLE_EQ(end.v, 0);
}

TEST(TimeLaw, FindsThePieceWithAndWithoutAHint) {
  const TimeLaw law = trapezoid();
  for (std::size_t hint = 0; hint < 5; ++hint) {
    EXPECT_EQ(law.find(0, hint), 0u);
    EXPECT_EQ(law.find(0.999, hint), 0u);
    EXPECT_EQ(law.find(1, hint), 1u);
    EXPECT_EQ(law.find(3.5, hint), 2u);
    EXPECT_EQ(law.find(4, hint), 2u);
    EXPECT_EQ(law.find(99, hint), 2u);
    EXPECT_EQ(law.find(-1, hint), 0u);
  }
}

TEST(TimeLaw, SlowedRunsTheSameWay) {
  const TimeLaw law = trapezoid(), slow = law.slowed(1.25);
  EXPECT_DOUBLE_EQ(slow.duration(), 5);
  for (std::size_t i = 0; i < 3; ++i) {
    const LawPiece &p = law.pieces()[i], &q = slow.pieces()[i];
    const LawState a = p.at(0.3 * p.duration), b = q.at(0.3 * q.duration);
    EXPECT_DOUBLE_EQ(a.s, b.s);
    EXPECT_NEAR(a.v, 1.25 * b.v, 1e-14 * a.v);
    EXPECT_NEAR(a.a, 1.25 * 1.25 * b.a, 1e-14 * std::abs(a.a));
  }
}

TEST(TimeLaw, SlowsOneSectionAndShiftsTheRest) {
  TimeLaw law = trapezoid();
  const TimeLaw second = trapezoid();
  for (LawPiece q : second.pieces()) {
    q.s += 30;
    q.s_end += 30;
    law.append(q);
  }
  law.slow_sections({{2.5, 1.5}});
  EXPECT_DOUBLE_EQ(law.duration(), 4 * 1.5 + 4);
  EXPECT_DOUBLE_EQ(law.pieces()[1].v, 10 / 1.5);
  EXPECT_DOUBLE_EQ(law.pieces()[3].t0, 6);
  EXPECT_DOUBLE_EQ(law.pieces()[4].v, 10);
  law.slow_sections({{6.5, 2}});
  EXPECT_DOUBLE_EQ(law.duration(), 6 + 8);
  EXPECT_DOUBLE_EQ(law.pieces()[0].t0, 0);
}

TEST(TimeLaw, FindsThePieceFromEveryHint) {
  TimeLaw law;
  for (int i = 0; i < 100; ++i) law.append({0, i % 7 == 3 ? 0.0 : 1.0 + i % 5, 0, 0, 1, 0, 0, 0});
  const auto& pieces = law.pieces();
  for (double t = -1; t < law.duration() + 3; t += 0.5) {
    std::size_t last = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i)
      if (pieces[i].t0 <= t) last = i;
    for (std::size_t hint = 0; hint <= pieces.size(); ++hint) ASSERT_EQ(law.find(t, hint), last) << t << ' ' << hint;
  }
}

TEST(TimeLaw, SlowsManySectionsAtOnce) {
  TimeLaw law;
  const TimeLaw once = trapezoid();
  for (int i = 0; i < 4; ++i)
    for (LawPiece piece : once.pieces()) {
      piece.s += 30 * i, piece.s_end += 30 * i;
      law.append(piece);
    }
  TimeLaw one_by_one = law;
  law.slow_sections({{14, 2}, {5, 1.5}, {6, 1.25}});  // times before any of them is slowed
  one_by_one.slow_sections({{14, 2}});
  one_by_one.slow_sections({{5, 1.5}});
  EXPECT_DOUBLE_EQ(law.duration(), 4 + 6 + 4 + 8);
  ASSERT_EQ(law.pieces().size(), one_by_one.pieces().size());
  for (std::size_t i = 0; i < law.pieces().size(); ++i) {
    EXPECT_DOUBLE_EQ(law.pieces()[i].t0, one_by_one.pieces()[i].t0) << i;
    EXPECT_DOUBLE_EQ(law.pieces()[i].v, one_by_one.pieces()[i].v) << i;
  }
  law.slow_sections({});
  EXPECT_DOUBLE_EQ(law.duration(), 22);
}

TEST(LawPiece, StateIsTheDerivative) {
  const LawPiece p{0, 1, 2, 0, 3, 4, 5, 0};
  const double t = 0.7, d = 1e-5;
  EXPECT_NEAR((p.at(t + d).s - p.at(t - d).s) / (2 * d), p.at(t).v, 1e-8);
  EXPECT_NEAR((p.at(t + d).v - p.at(t - d).v) / (2 * d), p.at(t).a, 1e-8);
  EXPECT_NEAR((p.at(t + d).a - p.at(t - d).a) / (2 * d), p.at(t).j, 1e-8);
}

TEST(LawPiece, SnapRampsTheJerk) {
  LawPiece p;
  p.duration = 2, p.s = 1, p.v = 3, p.a = -2, p.j = 4, p.snap = -6;
  const double t = 1.3, d = 1e-5;
  const LawState x = p.at(t), up = p.at(t + d), down = p.at(t - d);
  EXPECT_NEAR((up.s - down.s) / (2 * d), x.v, 1e-8);
  EXPECT_NEAR((up.v - down.v) / (2 * d), x.a, 1e-8);
  EXPECT_NEAR((up.a - down.a) / (2 * d), x.j, 1e-8);
  EXPECT_NEAR((up.j - down.j) / (2 * d), p.snap, 1e-8);
  LawPiece slow = p;
  slow.slow(1.5);
  EXPECT_NEAR(slow.at(1.5 * t).s, x.s, 1e-13);
  EXPECT_NEAR(slow.at(1.5 * t).j, x.j / (1.5 * 1.5 * 1.5), 1e-13);
}

TEST(LawPiece, TurningPoints) {
  LawPiece p;
  p.a = 1, p.j = -4, p.snap = 4;
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) EXPECT_NEAR(p.at(turning_points(p)[i]).a, 0, 1e-14);
  EXPECT_NE(turning_points(p)[0], turning_points(p)[1]);
  EXPECT_DOUBLE_EQ(turning_points(p)[2], 1);
  p.snap = 0;
  EXPECT_DOUBLE_EQ(turning_points(p)[0], 0.25);
  EXPECT_TRUE(std::isinf(turning_points(p)[1]));
  p.j = 0;
  EXPECT_TRUE(std::isinf(turning_points(p)[0]));
}

}  // namespace
}  // namespace bahnwerk
