#include "core/verify/law/axis_peaks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/numeric/peak.hpp"
#include "core/verify/rounding.hpp"

namespace bahnwerk::verify {
namespace {

enum class Quantity { velocity, acceleration, jerk };

struct Channel {
  Quantity quantity;
  std::size_t axis;
  double limit;
  bool squared() const { return quantity != Quantity::acceleration; }
};

std::vector<Channel> make_channels(const VerifierInput& in) {
  std::vector<Channel> list;
  auto add = [&](Quantity quantity, double AxisLimits::*limit) {
    for (std::size_t k = 0; k < in.machine.axes.size() && k < 3; ++k)
      if (const double value = in.machine.axes[k].*limit; value < unlimited) list.push_back({quantity, k, value});
  };
  add(Quantity::velocity, &AxisLimits::velocity);
  add(Quantity::acceleration, &AxisLimits::acceleration);
  if (in.check_jerk) add(Quantity::jerk, &AxisLimits::jerk);
  return list;
}

std::vector<double> scales(const std::vector<Channel>& channels) {
  std::vector<double> list;
  for (const Channel& c : channels) list.push_back(c.squared() ? c.limit * c.limit : c.limit);
  return list;
}

class Sweeper {
 public:
  Sweeper(const VerifierInput& in, ProgressScope& pulse)
      : in_(in), pulse_(pulse), channels_(make_channels(in)), peaks_(scales(channels_)) {}

  AxisPeaks run() {
    const auto& pieces = in_.law.pieces();
    for (index_ = 0; index_ < pieces.size(); ++index_) {
      pulse_.work(1);
      if (index_ % 256 == 0) pulse_.done(static_cast<double>(index_) / static_cast<double>(pieces.size()));
      const LawPiece& piece = pieces[index_];
      if (piece.segment < in_.contour.path.size()) check_piece(piece, in_.contour.path[piece.segment]);
    }
    AxisPeaks result;
    for (std::size_t c = 0; c < channels_.size(); ++c) result.checks.push_back(check(c));
    result.arc_length = arc_length_;
    return result;
  }

 private:
  // Channel c at a point, in what is searched (squares for velocity and jerk).
  double value(const Channel& c, const PathPoint& h, double b, double a) const {
    switch (c.quantity) {
      case Quantity::velocity:
        return h.d1[c.axis] * h.d1[c.axis] * b;
      case Quantity::acceleration:
        return h.d2[c.axis] * b + h.d1[c.axis] * a;
      case Quantity::jerk:
        break;
    }
    const double r = h.d3[c.axis] * b + 3 * h.d2[c.axis] * a;
    return b * r * r;
  }
  double value(const Channel& c, const PathPoint& h, const LawState& x) const {
    if (c.quantity != Quantity::jerk) return value(c, h, x.v * x.v, x.a);
    const double r = h.d3[c.axis] * x.v * x.v * x.v + 3 * h.d2[c.axis] * x.v * x.a + h.d1[c.axis] * x.j;
    return r * r;
  }

  void check_piece(const LawPiece& piece, const Segment& segment) {
    const double finite = piece.s + piece.s_end + piece.v + piece.a + piece.j + piece.q + piece.duration;
    if (!std::isfinite(finite)) {
      for (std::size_t c = 0; c < channels_.size(); ++c) peaks_.raise(c, finite, 0, index_);
      return;
    }
    if (segment.straight()) return straight(piece, segment);
    if (!piece.constant_acceleration()) return over_time(piece, segment);
    over_parameter(piece, segment);
  }

  void straight(const LawPiece& piece, const Segment& segment) {
    if (&segment != tangent_of_) {
      tangent_of_ = &segment;
      tangent_ = {};
      tangent_.d1 = segment.at_parameter(segment.curve().begin()).d1;
    }
    auto offer = [&](double tau) {
      const LawState x = piece.at(tau);
      for (std::size_t c = 0; c < channels_.size(); ++c) peaks_.raise(c, value(channels_[c], tangent_, x), tau, index_);
    };
    offer(0);
    offer(piece.duration);
    for (const double tau : turning_points(piece))
      if (tau > 0 && tau < piece.duration) offer(tau);
  }

  void over_time(const LawPiece& piece, const Segment& segment) {
    if (segment.curve().kind() == CurveKind::rational) {
      const double u0 = segment.parameter(piece.s), u1 = segment.parameter(piece.s_end);
      measure(piece, segment, u0, u1, segment.arc_length(u0), segment.arc_length(u1), 0);
    }
    // Counted from the begin of the segment: far along a path the rounding of s would show as noise.
    LawPiece local = piece;
    local.s = piece.s - segment.s0();
    const bool open = segment.cusp_begin() || segment.cusp_end();
    peaks_.sweep(0, piece.duration, open, index_,
                 [&](const ChebyshevRule& rule, double begin, double end, double* values) {
                   pulse_.work(static_cast<std::size_t>(rule.points));
                   for (int i = 0; i < rule.points; ++i) {
                     const LawState x = local.at(begin + rule.node[i] * (end - begin));
                     const PathPoint h = segment.at_parameter(segment.parameter_at(x.s));
                     for (std::size_t c = 0; c < channels_.size(); ++c)
                       values[c * rule.points + i] = value(channels_[c], h, x);
                   }
                   return true;
                 });
  }

  // To what the quadrature of a stretch resolves its length, mm.
  static double resolution(const Segment& segment, double way) { return 1e-11 * way + 2e-12 * segment.length(); }

  void raise_arc_length(double miss, const Segment& segment, double way, double when) {
    arc_length_.raise(miss, 5 * resolution(segment, way) + rounding * segment.s1(), when);
  }

  // ∫|dh/du|du over [u0, u1] against the way from s0 to s1, halved until the rule resolves it.
  void measure(const LawPiece& piece, const Segment& segment, double u0, double u1, double s0, double s1, int depth) {
    if (!(u1 > u0)) return;
    const ChebyshevRule& rule = lobatto_rule(true);
    pulse_.work(static_cast<std::size_t>(rule.points));
    double whole = 0;
    for (int i = 0; i < rule.points; ++i)
      whole += rule.whole[static_cast<std::size_t>(i)] *
               segment.curve().speed(u0 + rule.node[static_cast<std::size_t>(i)] * (u1 - u0));
    const double miss = std::abs(whole * (u1 - u0) - (s1 - s0)), middle = u0 + 0.5 * (u1 - u0);
    if (miss <= resolution(segment, s1 - s0) || depth == 12 || !(middle > u0 && middle < u1))
      return raise_arc_length(miss, segment, s1 - s0, piece.t0);
    const double s = segment.arc_length(middle);
    measure(piece, segment, u0, middle, s0, s, depth + 1);
    measure(piece, segment, middle, u1, s, s1, depth + 1);
  }

  void over_parameter(const LawPiece& piece, const Segment& segment) {
    const double u0 =
        (index_ > 0 && end_segment_ == piece.segment && end_s_ == piece.s) ? end_u_ : segment.parameter(piece.s);
    const double u1 = segment.parameter(piece.s_end);
    end_segment_ = piece.segment, end_s_ = piece.s_end, end_u_ = u1;
    const double v1 = piece.v + piece.a * piece.duration, b0 = piece.v * piece.v, b1 = v1 * v1;
    const double ds = piece.s_end - piece.s;
    if (!(u1 > u0) || !(ds > 0)) {  // standing still, or shorter than the parameter resolves
      PathPoint h = segment.at_parameter(u0);
      if (b0 == 0 && b1 == 0) h.d2 = h.d3 = {};  // infinite at a cusp, where nothing moves
      for (std::size_t c = 0; c < channels_.size(); ++c)
        for (const double b : {b0, b1}) peaks_.raise(c, value(channels_[c], h, b, piece.a), u0, index_);
      return;
    }
    const Curve& curve = segment.curve();
    const bool open = (segment.cusp_begin() && u0 <= curve.begin()) || (segment.cusp_end() && u1 >= curve.end());
    const bool even = curve.kind() != CurveKind::rational;  // s is linear in u
    std::array<double, ChebyshevRule::max_points> speed, s;
    peaks_.sweep(u0, u1, open, index_, [&](const ChebyshevRule& rule, double begin, double end, double* values) {
      pulse_.work(static_cast<std::size_t>(rule.points));
      const int n = rule.points;
      bool resolved = true;
      if (even) {
        const double from = (begin - u0) / (u1 - u0), width = (end - begin) / (u1 - u0);
        for (int i = 0; i < n; ++i) s[i] = (from + rule.node[i] * width) * ds;
      } else {
        const double from = begin == u0 ? 0 : segment.arc_length(begin) - piece.s;
        const double to = end == u1 ? ds : segment.arc_length(end) - piece.s;
        double whole = 0;
        for (int i = 0; i < n; ++i) {
          speed[i] = curve.speed(begin + rule.node[i] * (end - begin));
          whole += rule.whole[i] * speed[i];
        }
        const double miss = std::abs(whole * (end - begin) - (to - from));
        resolved = miss <= resolution(segment, to - from);
        if (resolved) raise_arc_length(miss, segment, to - from, piece.t0);
        for (int i = 0; i < n; ++i) {
          double part = 0;
          for (int j = 0; j < n; ++j) part += rule.integral[i][j] * speed[j];
          s[i] = from + part / whole * (to - from);
        }
        if (!open) s[0] = from, s[n - 1] = to;
      }
      for (int i = 0; i < n; ++i) {
        const PathPoint h = segment.at_parameter(begin + rule.node[i] * (end - begin));
        const double b = b0 + (b1 - b0) * (s[i] / ds);
        for (std::size_t c = 0; c < channels_.size(); ++c) values[c * n + i] = value(channels_[c], h, b, piece.a);
      }
      return resolved;
    });
  }

  Check check(std::size_t c) const {
    static constexpr std::array names{"velocity ", "acceleration ", "jerk "};
    static constexpr std::array units{"mm/s", "mm/s²", "mm/s³"};
    const Channel& channel = channels_[c];
    const Peak& peak = peaks_[c];
    Worst worst{channel.squared() ? std::sqrt(peak.value) : peak.value, 0};
    if (!peak.finite) worst.value = std::numeric_limits<double>::quiet_NaN();
    if (peak.tag < in_.law.pieces().size()) worst.at = moment(in_.law.pieces()[peak.tag], peak.at);
    const auto kind = static_cast<std::size_t>(channel.quantity);
    return make_check(names[kind] + in_.machine.axes[channel.axis].name, units[kind], channel.limit, worst);
  }

  // When a piece passes the place where its peak was found.
  double moment(const LawPiece& piece, double at) const {
    if (piece.segment >= in_.contour.path.size()) return piece.t0;
    const Segment& segment = in_.contour.path[piece.segment];
    if (segment.straight() || !piece.constant_acceleration()) return piece.t0 + at;
    const double ds = piece.s_end - piece.s, s = std::clamp(segment.arc_length(at) - piece.s, 0.0, std::max(ds, 0.0));
    const double v1 = piece.v + piece.a * piece.duration;
    const double b = ds > 0 ? piece.v * piece.v + (v1 * v1 - piece.v * piece.v) * (s / ds) : 0;
    const double sum = piece.v + std::sqrt(std::max(b, 0.0));
    return piece.t0 + (sum > 0 ? std::clamp(2 * s / sum, 0.0, piece.duration) : 0.0);
  }

  const VerifierInput& in_;
  ProgressScope& pulse_;
  std::vector<Channel> channels_;
  PeakSweep peaks_;
  Strained arc_length_;
  std::size_t index_ = 0;
  std::size_t end_segment_ = static_cast<std::size_t>(-1);  // where the last piece ended, to invert u(s) once per piece
  double end_s_ = 0, end_u_ = 0;
  const Segment* tangent_of_ = nullptr;
  PathPoint tangent_;
};

}  // namespace

AxisPeaks axis_peaks(const VerifierInput& input, ProgressScope& pulse) { return Sweeper(input, pulse).run(); }

}  // namespace bahnwerk::verify
