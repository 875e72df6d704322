#include "core/geometry/path/matched.hpp"

#include <algorithm>
#include <cmath>

#include "core/numeric/sign_change.hpp"

namespace bahnwerk {

namespace {

constexpr int max_halvings = 48;
constexpr std::size_t units_per_halving = 16;  // units of a progress scope per halving

}  // namespace

Nearest nearest(const Curve& curve, double u0, double u1, Vec p) {
  const auto slope = [&](const Jet& h) { return dot(h.value - p, h.d1); };
  Jet low = curve.at(u0), high = curve.at(u1);
  if (curve.kind() == CurveKind::line) {
    const double square = dot(low.d1, low.d1);
    const double u = square > 0 ? std::clamp(u0 + dot(p - low.value, low.d1) / square, u0, u1) : u0;
    return {u, norm(curve.at(u).value - p)};
  }
  SignChange slopes{u0, slope(low), u1, slope(high)};
  if (!(slopes.f_low < 0)) return {u0, norm(low.value - p)};
  if (!(slopes.f_high > 0)) return {u1, norm(high.value - p)};
  Nearest best{u0, norm(low.value - p)};
  if (const double d = norm(high.value - p); d < best.distance) best = {u1, d};
  for (int i = 0; i < 40 && slopes.high - slopes.low > 1e-13 * (u1 - u0); ++i) {
    const double u = i % 8 == 7 ? slopes.middle() : std::clamp(slopes.next(), slopes.low, slopes.high);
    const Jet h = curve.at(u);
    const double f = slope(h);
    const double distance = norm(h.value - p);
    if (!(distance > best.distance)) best = {u, distance};
    if (std::abs(f) <= 1e-12 * norm(h.d1) * (distance + 1e-4)) break;
    slopes.take(u, f);
  }
  return best;
}

double MatchedDistance::bound(const MatchedPieces& pieces, double tolerance, double slack, double& found) const {
  if (pieces.ends() <= tolerance) found = std::max(found, pieces.ends());
  return halve(pieces, tolerance, slack, found, max_halvings);
}

double MatchedDistance::halve(const MatchedPieces& c, double tolerance, double slack, double& found, int depth) const {
  const double wa = c.a1 - c.a0, wb = c.b1 - c.b0;
  const double bulge_a = wa > 0 ? second_a_.at(c.a0, c.a1) * wa * wa / 8 : 0.0;
  const double bulge_b = wb > 0 ? second_b_.at(c.b0, c.b1) * wb * wb / 8 : 0.0;
  const double bound = c.ends() + bulge_a + bulge_b;
  if (!(bound > found + slack) || !(c.ends() <= tolerance) || depth == 0) return bound;
  if (progress_) progress_->work(units_per_halving);
  MatchedPieces first = c, second = c;
  if (bulge_a >= bulge_b) {
    first.a1 = second.a0 = 0.5 * (c.a0 + c.a1);
    const Nearest n = nearest(b_, c.b0, c.b1, a_.at(first.a1).value);
    first.b1 = second.b0 = n.u;
    first.d1 = second.d0 = n.distance;
  } else {
    first.b1 = second.b0 = 0.5 * (c.b0 + c.b1);
    const Nearest n = nearest(a_, c.a0, c.a1, b_.at(first.b1).value);
    first.a1 = second.a0 = n.u;
    first.d1 = second.d0 = n.distance;
  }
  if (first.d1 <= tolerance) found = std::max(found, first.d1);
  const double left = halve(first, tolerance, slack, found, depth - 1);
  const double right = halve(second, tolerance, slack, found, depth - 1);
  return std::isnan(left) || left > right ? left : right;
}

}  // namespace bahnwerk
