#include "core/motion/law/law_between.hpp"

#include <cmath>

namespace bahnwerk {

void append_between(TimeLaw& law, std::size_t segment, const LawState& from, const LawState& to, double duration) {
  const auto piece_of = [&](double t) {
    const double dv = (to.v - from.v - from.a * t) / (t * t), da = (to.a - from.a) / t;
    LawPiece piece;
    piece.s = from.s, piece.v = from.v, piece.a = from.a;
    piece.j = 6 * dv - 2 * da, piece.snap = (6 * da - 12 * dv) / t;
    return piece;
  };
  double t = duration;
  LawPiece piece = piece_of(t);
  for (int i = 0; i < 50; ++i) {
    // This is ds/dT of the quartic that always meets both speeds: about their mean.
    const double off = piece.at(t).s - to.s, slope = (from.v + to.v) / 2 + t * (from.a - to.a) / 6;
    const double next = t - off / slope;
    if (!(next > 0.5 * duration && next < 2 * duration)) break;
    const bool there = std::abs(next - t) <= 4e-16 * t;
    t = next;
    piece = piece_of(t);
    if (there) break;
  }
  LawPiece& made = law.next();
  const double t0 = made.t0;
  made = piece;
  made.t0 = t0, made.duration = t, made.s_end = to.s, made.segment = segment;
}

}  // namespace bahnwerk
