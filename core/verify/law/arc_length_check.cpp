#include "core/verify/law/arc_length_check.hpp"

#include <cmath>

#include "core/numeric/peak.hpp"
#include "core/verify/rounding.hpp"

namespace bahnwerk::verify {

double ArcLengthCheck::resolution(const Segment& segment, double way) { return 1e-11 * way + 2e-12 * segment.length(); }

void ArcLengthCheck::raise(double miss, const Segment& segment, double way, double when) {
  worst_.raise(miss, 5 * resolution(segment, way) + rounding * segment.s1(), when);
}

void ArcLengthCheck::believe(const LawPiece& piece, const Segment& segment, double way) {
  raise(std::abs(way - (piece.s_end - piece.s)), segment, way, piece.t0);
}

void ArcLengthCheck::measure(const LawPiece& piece, const Segment& segment, Place from, Place to, int halvings) {
  const auto [u0, s0] = from;
  const auto [u1, s1] = to;
  if (!(u1 > u0)) return;
  const auto miss_of = [&, u0 = u0, u1 = u1, s0 = s0, s1 = s1](const ChebyshevRule& rule) {
    progress_.work(static_cast<std::size_t>(rule.points));
    double whole = 0;
    for (int i = 0; i < rule.points; ++i)
      whole += rule.whole[static_cast<std::size_t>(i)] *
               segment.curve().speed(u0 + rule.node[static_cast<std::size_t>(i)] * (u1 - u0));
    return std::abs(whole * (u1 - u0) - (s1 - s0));
  };
  const double resolved = resolution(segment, s1 - s0), middle = u0 + 0.5 * (u1 - u0);
  double miss = miss_of(lobatto_rule(5));
  if (!(miss <= resolved)) miss = miss_of(lobatto_rule(9));
  if (miss <= resolved || halvings == 12 || !(middle > u0 && middle < u1))
    return raise(miss, segment, s1 - s0, piece.t0);
  const Place half_way{middle, segment.travelled(middle)};
  measure(piece, segment, from, half_way, halvings + 1);
  measure(piece, segment, half_way, to, halvings + 1);
}

}  // namespace bahnwerk::verify
