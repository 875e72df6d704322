#include "core/verify/limb.hpp"

#include <algorithm>
#include <cmath>

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

Nearest nearest(const Curve& curve, double u0, double u1, Vec p) {
  const auto slope = [&](const Jet& h) { return dot(h.value - p, h.d1); };
  Jet low = curve.at(u0), high = curve.at(u1);
  if (curve.kind() == CurveKind::line) {
    const double square = dot(low.d1, low.d1);
    const double u = square > 0 ? std::clamp(u0 + dot(p - low.value, low.d1) / square, u0, u1) : u0;
    return {u, norm(curve.at(u).value - p)};
  }
  double a = u0, b = u1, fa = slope(low), fb = slope(high);
  if (!(fa < 0)) return {u0, norm(low.value - p)};
  if (!(fb > 0)) return {u1, norm(high.value - p)};
  // Regula falsi (Illinois).
  Nearest best{u0, norm(low.value - p)};
  if (const double d = norm(high.value - p); d < best.distance) best = {u1, d};
  for (int i = 0, side = 0; i < 40 && b - a > 1e-13 * (u1 - u0); ++i) {
    const double u = i % 8 == 7 ? 0.5 * (a + b) : std::clamp((a * fb - b * fa) / (fb - fa), a, b);
    const Jet h = curve.at(u);
    const double f = slope(h);
    const double distance = norm(h.value - p);
    if (!(distance > best.distance)) best = {u, distance};
    if (std::abs(f) <= 1e-12 * norm(h.d1) * (distance + 1e-4)) break;
    if (f < 0) {
      a = u, fa = f;
      if (side == -1) fb *= 0.5;
      side = -1;
    } else {
      b = u, fb = f;
      if (side == 1) fa *= 0.5;
      side = 1;
    }
  }
  return best;
}

}  // namespace bahnwerk::verify
