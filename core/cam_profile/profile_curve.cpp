#include "core/cam_profile/profile_curve.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"

namespace bahnwerk::cam {
namespace {

using T = LawSeries<double>;
constexpr double degree = std::numbers::pi / 180;
constexpr std::size_t most_spans = 20000;

using Bezier = std::array<Point, 6>;

Bezier hermite(const CamCurvePoint& a, const CamCurvePoint& b, double h) {
  return {a.value,
          a.value + (h / 5) * a.first,
          a.value + (2 * h / 5) * a.first + (h * h / 20) * a.second,
          b.value - (2 * h / 5) * b.first + (h * h / 20) * b.second,
          b.value - (h / 5) * b.first,
          b.value};
}

Point at(Bezier b, double x) {
  for (std::size_t n = b.size(); n-- > 1;)
    for (std::size_t k = 0; k < n; ++k) b[k] = (1 - x) * b[k] + x * b[k + 1];
  return b[0];
}

}  // namespace

CamCurvePoint cam_curve_point(const CamGeometry& g, const FollowerLaw& law, double base_radius, CamCurve curve,
                              std::size_t piece, double x) {
  const double phi = law.begin(piece) + x * law.width(piece), turn = g.turn();
  const PitchSeat<double> seat = pitch_seat<double>(g, pitch_radius(g, base_radius));
  const PitchPoint<double> p = pitch_point(seat, law.at(piece, x));
  const bool barrel = g.type == CamType::barrel;
  Plane<T> q = p.place;
  if (curve != CamCurve::pitch && g.has_roller() && g.roller_radius > 0) {
    // The outward normal is σ J D f/|D f|; that of a barrel's pitch curve J D f/|D f|.
    const double side = (curve == CamCurve::profile ? -1 : 1) * (barrel ? 1 : turn) * g.roller_radius;
    const T length = sqrt(p.first.x * p.first.x + p.first.y * p.first.y);
    q = {q.x - side * (p.first.y / length), q.y + side * (p.first.x / length)};
  }
  if (barrel) {
    const auto point = [&](std::size_t k, double linear) {
      return Point{q.x.derivative(k) + linear, q.y.derivative(k)};
    };
    return {point(0, seat.radius * phi), point(1, seat.radius), point(2, 0)};
  }
  const Plane<T> first = seen_from_cam(q, turn), second = seen_from_cam(first, turn);
  const double c = std::cos(turn * phi), s = std::sin(turn * phi);
  const auto turned = [&](const Plane<T>& v) {
    return Point{c * v.x.value() + s * v.y.value(), c * v.y.value() - s * v.x.value()};
  };
  return {turned(q), turned(first), turned(second)};
}

NurbsPath cam_curve(const CamGeometry& g, const FollowerLaw& law, double base_radius, CamCurve curve,
                    Progress progress) {
  NurbsPath out;
  out.degree = 5;
  std::size_t spans = 0;
  const auto add_point = [&](Point p) { out.points.push_back({p.x, p.y, 0, 0, 0, 1}); };
  const auto add_knot = [&](double phi, int times) {
    for (int k = 0; k < times; ++k) out.knots.push_back(phi / degree);
  };
  for (std::size_t piece = 0; piece < law.pieces(); ++piece) {
    const auto exact = [&](double x) { return cam_curve_point(g, law, base_radius, curve, piece, x); };
    const auto parts = static_cast<std::size_t>(std::ceil(law.width(piece) / (5 * degree)));
    double from = 0, width = 1 / static_cast<double>(parts);
    CamCurvePoint a = exact(0);
    if (piece == 0) add_point(a.value), add_knot(law.begin(0), 6);
    while (from < 1) {
      if (++spans > most_spans)
        throw ToleranceUnreachable("the cam's profile takes more than 20000 spans within its tolerance", g.tolerance);
      if (spans % 64 == 0) progress.report("cam", 0.9);
      double to = from + width > 1 - 1e-9 ? 1 : from + width;
      CamCurvePoint b = exact(to);
      Bezier span{};
      for (;;) {
        const double h = (to - from) * law.width(piece);
        span = hermite(a, b, h);
        double off = 0;
        for (int k = 1; k < 8; ++k) {
          const double x = k / 8.0;
          off = std::max(off, distance(at(span, x), exact(from + x * (to - from)).value));
        }
        if (off <= g.tolerance / 4 || h < 1e-9) break;
        width = (to - from) / 2, to = from + width, b = exact(to);
      }
      for (std::size_t k = 1; k < span.size(); ++k) add_point(span[k]);
      add_knot(law.begin(piece) + to * law.width(piece), 5);
      from = to, a = b;
      width = std::min(2 * width, 1 / static_cast<double>(parts));
    }
  }
  out.knots.push_back(out.knots.back());
  if (g.type == CamType::radial) out.points.back() = out.points.front();  // a turn closes but for rounding
  return out;
}

}  // namespace bahnwerk::cam
