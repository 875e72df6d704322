#include "core/verify/geometry/curve_piece.hpp"

namespace bahnwerk::verify {

namespace {

constexpr double max_turn = 0.5;  // rad
constexpr int max_depth = 24;

void add(const Segment& s, std::size_t index, double u0, double u1, int depth, std::vector<CurvePiece>& out) {
  const Jet a = s.at_parameter(u0), b = s.at_parameter(u1);
  if (!s.straight() && depth > 0) {
    const double middle = 0.5 * (u0 + u1), quarter = 0.25 * (u1 - u0);
    Vec last = a.d1;
    double turn = 0;
    for (const double u : {u0 + quarter, middle, u1 - quarter, u1}) {
      const Vec next = u == u1 ? b.d1 : s.at_parameter(u).d1;
      turn += angle_between(last, next);
      last = next;
    }
    if (!(turn <= max_turn)) {
      add(s, index, u0, middle, depth - 1, out);
      add(s, index, middle, u1, depth - 1, out);
      return;
    }
  }
  out.push_back({index, u0, u1, a.value, b.value, s.arc_length(u1) - s.arc_length(u0)});
}

}  // namespace

void add_curve_pieces(const Segment& segment, std::size_t index, std::vector<CurvePiece>& curve_pieces) {
  add(segment, index, segment.curve().begin(), segment.curve().end(), max_depth, curve_pieces);
}

}  // namespace bahnwerk::verify
