#include "core/verify/limb.hpp"

namespace bahnwerk::verify {

namespace {

constexpr double most_turn = 0.5;  // rad
constexpr int most_depth = 24;

void add(const Segment& s, std::size_t index, double u0, double u1, int depth, std::vector<Limb>& out) {
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
    if (!(turn <= most_turn)) {
      add(s, index, u0, middle, depth - 1, out);
      add(s, index, middle, u1, depth - 1, out);
      return;
    }
  }
  out.push_back({index, u0, u1, a.value, b.value, s.arc_length(u1) - s.arc_length(u0)});
}

}  // namespace

void add_limbs(const Segment& segment, std::size_t index, std::vector<Limb>& limbs) {
  add(segment, index, segment.curve().begin(), segment.curve().end(), most_depth, limbs);
}

}  // namespace bahnwerk::verify
