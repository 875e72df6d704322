#include "core/verify/law/local_places.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/contour/builder.hpp"

namespace bahnwerk::verify {
namespace {

constexpr double acceleration = 100, far_away = 1e4;

/// A line of 10 m, then a curve of micrometres whose tangent vanishes at its begin or at its end.
Contour micrometres(bool at_end) {
  ContourBuilder b(2, {0, 0, 0});
  const Vec p{far_away, 0, 0}, q{far_away + 0.001, 0.0007, 0}, r{far_away + 0.002, 0.0001, 0};
  b.line(p);
  b.nurbs(3, at_end ? std::vector<Vec>{p, q, r, r} : std::vector<Vec>{p, p, q, r}, {}, {0, 0, 0, 0, 1, 1, 1, 1});
  return b.finish();
}

/// From rest at the begin, or to rest at the end, with constant acceleration, in pieces that halve towards the rest.
/// `way[i]`: from the rest to the far end of piece i as it is counted from there.
TimeLaw law_of(const Contour& contour, bool at_end, std::vector<double>& way) {
  const Segment& curve = contour.path[1];
  const double length = curve.travelled(curve.curve().end());
  constexpr int pieces = 30;
  std::vector<double> time{0};
  way.assign(1, 0);
  for (int i = 0; i < pieces; ++i) {
    way.push_back(i + 1 == pieces ? length : length * std::ldexp(1.0, i + 1 - pieces));
    time.push_back(std::sqrt(2 * way.back() / acceleration));
  }
  TimeLaw law;
  const auto add = [&](int from, int to) {
    LawPiece p;
    p.segment = 1;
    p.duration = std::abs(time[to] - time[from]);
    const auto place = [&](int i) { return at_end ? curve.s1() - way[i] : curve.s0() + way[i]; };
    p.s = place(from), p.s_end = place(to);
    p.v = acceleration * time[from];
    p.a = at_end ? -acceleration : acceleration;
    law.append(p);
  };
  for (int i = 0; i < pieces; ++i) at_end ? add(pieces - i, pieces - i - 1) : add(i, i + 1);
  return law;
}

TEST(LocalPlaces, NextToAVanishingTangentAreAddedUpFromThere) {
  for (const bool at_end : {false, true}) {
    SCOPED_TRACE(at_end);
    const Contour contour = micrometres(at_end);
    const CartesianAxisPath axes(contour.path, 2);
    const Machine machine{{{"x", 100, 1000}, {"y", 100, 1000}}, 0.001};
    std::vector<double> way;
    const TimeLaw law = law_of(contour, at_end, way);
    const VerifierInput input{axes, machine, law, contour.feeds(), contour.rest_places()};
    LocalPlaces places(input);
    const Segment& curve = contour.path[1];
    const double length = curve.travelled(curve.curve().end());
    const std::size_t n = law.pieces().size();
    double most_rounded = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double end = at_end ? way[n - 1 - i] : way[i + 1];
      const double from_rest = at_end ? length - places.end(i) : places.end(i);
      EXPECT_NEAR(from_rest, end, 1e-12 * end + (at_end ? 1e-15 * length : 0)) << i;
      const double rounded = law.pieces()[i].s_end - curve.s0();
      if (!at_end) most_rounded = std::max(most_rounded, std::abs(rounded - end) / end);
    }
    if (!at_end) {
      EXPECT_GT(most_rounded, 1e-2);  // what s alone would have told
    }
    EXPECT_EQ(places.at_end(n - 1), true);
    EXPECT_EQ(places.at_end(0), false);
  }
}

TEST(LocalPlaces, ElsewhereAreCountedByTheLaw) {
  ContourBuilder b(2, {0, 0, 0});
  b.arc({0, 2, 0}, {0, 1, 0}, true);
  const Contour contour = b.finish();
  const CartesianAxisPath axes(contour.path, 2);
  const Machine machine{{{"x", 100, 1000}, {"y", 100, 1000}}, 0.001};
  TimeLaw law;
  LawPiece p;
  p.s = 0.25, p.s_end = 1.5, p.v = 1, p.duration = 1;  // which do not agree
  law.append(p);
  const VerifierInput input{axes, machine, law, contour.feeds(), contour.rest_places()};
  LocalPlaces places(input);
  EXPECT_EQ(places.begin(0), 0.25);
  EXPECT_EQ(places.end(0), 1.5);
  EXPECT_FALSE(places.at_end(0));
  EXPECT_EQ(places.looked_at(0, 1e-300), 1e-300);
}

TEST(LocalPlaces, CuspsAreLookedAtWherePathLengthResolvesThem) {
  const Contour contour = micrometres(true);
  const CartesianAxisPath axes(contour.path, 2);
  const Machine machine{{{"x", 100, 1000}, {"y", 100, 1000}}, 0.001};
  std::vector<double> way;
  const TimeLaw law = law_of(contour, true, way);
  const VerifierInput input{axes, machine, law, contour.feeds(), contour.rest_places()};
  LocalPlaces places(input);
  const Segment& curve = contour.path[1];
  ASSERT_TRUE(curve.cusp_end());
  const double length = curve.travelled(curve.curve().end());
  EXPECT_LT(places.looked_at(0, length), length);
  EXPECT_GT(places.looked_at(0, length), length * (1 - 1e-13));
  EXPECT_EQ(places.looked_at(0, 0.5 * length), 0.5 * length);
}

}  // namespace
}  // namespace bahnwerk::verify
