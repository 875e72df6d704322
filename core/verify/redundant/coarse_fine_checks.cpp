#include "core/verify/redundant/coarse_fine_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include "core/base/progress_scope.hpp"
#include "core/numeric/peak.hpp"
#include "core/verify/law/channel_bounds.hpp"
#include "core/verify/law/curve_disc.hpp"
#include "core/verify/motion/bernstein.hpp"
#include "core/verify/motion/motion_checks.hpp"
#include "core/verify/redundant/least_stroke.hpp"
#include "core/verify/rounding.hpp"
#include "core/verify/worst.hpp"

namespace bahnwerk {
namespace verify {
namespace {

constexpr double position_scale = 0.1;  // mm: resolved to 2e-11 of it at least

struct Channel {
  std::size_t axis, derivative;  // the fine axis, and which of its derivatives
  double limit;
};

std::vector<Channel> make_channels(const CoarseFineToVerify& in) {
  std::vector<Channel> list;
  for (std::size_t k = 0; k < in.fine_axes.size(); ++k) {
    const AxisLimits& axis = in.fine_axes[k];
    for (int d = 0; d <= in.order; ++d)
      if (const double limit = d == 0 ? axis.highest : axis.of(d); limit < unlimited)
        list.push_back({k, static_cast<std::size_t>(d), limit});
  }
  return list;
}

/// Positions are compared up to their rounding, also if the stroke is 0.
std::vector<double> scales(const std::vector<Channel>& channels) {
  std::vector<double> list;
  for (const Channel& c : channels) list.push_back(c.derivative == 0 ? std::max(c.limit, position_scale) : c.limit);
  return list;
}

/// Returns the head's derivative of order `d` for axis k.
double head(const AxisJet& q, const LawState& x, std::size_t k, std::size_t d) {
  const double v = x.v;
  if (d == 0) return q.value[k];
  if (d == 1) return q.d1[k] * v;
  if (d == 2) return q.d2[k] * v * v + q.d1[k] * x.a;
  return q.d3[k] * v * v * v + 3 * q.d2[k] * v * x.a + q.d1[k] * x.j;
}

class FineSweep {
 public:
  FineSweep(const CoarseFineToVerify& in, ProgressScope& scope)
      : in_(in), scope_(scope), channels_(make_channels(in)), peaks_(scales(channels_)) {}

  std::vector<Check> run() {
    const auto& pieces = in_.law.pieces();
    const std::size_t last = in_.coarse.pieces() - 1;
    std::size_t c = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      scope_.now(i, pieces.size());
      const double end = i + 1 < pieces.size() ? pieces[i + 1].t0 : in_.law.duration();
      // Borders of both motions are known up to the rounding of t, so shorter intervals are left out.
      const double blur = rounding * end;
      for (double from = pieces[i].t0; end - from > blur;) {
        while (c < last && in_.coarse.begin(c + 1) <= from + blur) ++c;
        double to = c < last ? std::min(in_.coarse.begin(c + 1), end) : end;
        if (end - to <= blur) to = end;
        check(pieces[i], c, from, to);
        from = to;
      }
    }
    std::vector<Check> list;
    for (std::size_t c_ = 0; c_ < channels_.size(); ++c_) {
      const Channel& channel = channels_[c_];
      const AxisLimits& axis = in_.fine_axes[channel.axis];
      const Peak& peak = peaks_[c_];
      const Quantity& what = channel.derivative == 0 ? quantity::stroke : quantity::axis;
      list.push_back(make_check({what, static_cast<int>(channel.derivative), axis.unit, axis.name}, channel.limit,
                                Worst{peak.finite ? peak.value : std::numeric_limits<double>::quiet_NaN(), peak.at}));
    }
    return list;
  }

 private:
  /// A time in which neither the piece of the head's law changes nor that of the coarse motion.
  struct Interval {
    LawPiece law;  // s counts from the begin of the segment: far along a path its rounding would show
    const Segment& segment;
    std::size_t coarse;  // piece of the coarse motion
    double from, to;     // s
  };

  void check(const LawPiece& piece, std::size_t c, double from, double to) {
    if (piece.segment >= in_.path.size()) return;  // another check's fault
    Interval at{piece, in_.path[piece.segment], c, from, to};
    at.law.s = piece.s - at.segment.s0();
    degree_ = 0;
    for (std::size_t k = 0; k < in_.fine_axes.size(); ++k) {
      if (!in_.coarse.polynomial(c, k, coarse_[k])) return sample(at, false);
      degree_ = std::max(degree_, coarse_[k].size() - std::min<std::size_t>(coarse_[k].size(), 1));
    }
    if (in_.path.linear(piece.segment))
      exact(at);
    else
      sample(at, true);
  }

  void exact(const Interval& at) {
    const double from = at.from, to = at.to;
    const LawPiece law = moved(at.law, from - at.law.t0);
    const AxisJet q = in_.path.at_parameter(law.segment, at.segment.parameter_at(law.s));
    Polynomial fine;
    std::size_t axis = in_.fine_axes.size(), derived = 0;
    for (std::size_t n = 0; n < channels_.size(); ++n) {
      const Channel& channel = channels_[n];
      const std::size_t k = channel.axis;
      if (k != axis) {
        const double d = q.d1[k];
        fine = Polynomial{q.value[k], d * law.v, d * law.a / 2, d * law.j / 6, d * law.snap / 24} -
               shifted(coarse_[k], from - in_.coarse.begin(at.coarse), 1);
        axis = k, derived = 0;
      }
      for (; derived < channel.derivative; ++derived) fine = derivative(fine);
      Bernstein b{};
      const std::size_t size = bernstein(fine, to - from, 0, b);
      const bool finite = std::all_of(b.begin(), b.begin() + static_cast<std::ptrdiff_t>(size),
                                      [](double x) { return std::isfinite(x); });
      if (!finite) {
        peaks_.raise(n, std::numeric_limits<double>::quiet_NaN(), from, 0);
        continue;
      }
      const PolynomialPeak found = polynomial_peak(b.data(), static_cast<int>(size), peaks_[n].value);
      if (found.at >= 0) peaks_.raise(n, found.value, from + found.at * (to - from), 0);
    }
  }

  /// Next to a vanishing tangent no bound of the curve over time is known.
  bool at_vanishing_tangent(const Interval& at, double begin, double end) {
    CurveDiscs& all = discs(at.law.segment);
    if (all.vanishing() == 0) return false;
    const double u0 = at.segment.parameter_at(at.law.at(begin - at.law.t0).s);
    const double u1 = at.segment.parameter_at(at.law.at(end - at.law.t0).s);
    return u0 <= all.vanishing_at() && all.vanishing_at() <= u1;
  }

  /// `polynomial`: whether the coarse motion is a polynomial there.
  void sample(const Interval& at, bool polynomial) {
    const LawPiece& law = at.law;
    const Segment& segment = at.segment;
    const bool open = segment.cusp_begin() || segment.cusp_end();
    peaks_.sweep(at.from, at.to, open, 0, [&](PeakSamples& samples) {
      const auto points = static_cast<std::size_t>(samples.rule.points);
      scope_.work(points);
      const double half = 0.5 * (samples.end - samples.begin);
      if (polynomial && !at_vanishing_tangent(at, samples.begin, samples.end)) {
        if (degree_ >= points && !samples.last) {
          samples.empty = true;
          return false;
        }
        const LawPiece here = moved(law, samples.begin + half - law.t0);
        const CurveDisc disc = discs(law.segment).about(segment.parameter_at(here.s));
        const StateBounds bounds = state_bounds_over_time(here, half, disc, samples.rule.points);
        for (std::size_t n = 0; n < channels_.size(); ++n) samples.missing[n] = bounds[channels_[n].derivative];
      }
      for (std::size_t i = 0; i < points; ++i) {
        const double t = samples.at(static_cast<int>(i));
        const LawState x = law.at(std::clamp(t - law.t0, 0.0, law.duration));
        const AxisJet q = in_.path.at_parameter(law.segment, segment.parameter_at(x.s));
        const MotionState coarse = in_.coarse.in_piece(at.coarse, t);
        for (std::size_t n = 0; n < channels_.size(); ++n) {
          const Channel& channel = channels_[n];
          samples.values[n * points + i] =
              head(q, x, channel.axis, channel.derivative) - coarse[channel.derivative][channel.axis];
        }
      }
      return true;
    });
  }

  CurveDiscs& discs(std::size_t segment) {
    if (!discs_ || discs_of_ != segment) discs_.emplace(in_.path[segment].curve()), discs_of_ = segment;
    return *discs_;
  }

  const CoarseFineToVerify& in_;
  ProgressScope& scope_;
  std::vector<Channel> channels_;
  PeakSweep peaks_;
  std::array<Polynomial, max_axes> coarse_;  // coarse motion in the piece at hand
  std::size_t degree_ = 0;                   // the largest of them
  std::optional<CurveDiscs> discs_;
  std::size_t discs_of_ = 0;
};

/// Returns the size, mm, from which the rounding of a segment's points follows: its length, its distance from zero, the
/// radius of an arc, whose points are computed from its centre. Where any other curve is hardly bent, its radius of
/// curvature says nothing about its points.
double size_of(const AxisPath& path, std::size_t segment, const AxisJet& q) {
  double far = 0, bent = 0;
  for (std::size_t k = 0; k < path.axes(); ++k) far += std::abs(q.value[k]), bent += q.d2[k] * q.d2[k];
  const bool arc = path[segment].curve().kind() == CurveKind::arc;
  return far + path[segment].length() + (arc && bent > 0 ? 2 / std::sqrt(bent) : 0);
}

/// Tells of each axis whether its fine axis is where the coarse one carries it at all times, whatever its stroke is.
std::vector<bool> still_axes(const CoarseFineToVerify& in, const std::vector<Check>& fine) {
  std::vector<bool> still(in.fine_axes.size());
  for (std::size_t k = 0; k < still.size(); ++k)
    still[k] = std::any_of(fine.begin(), fine.end(), [&](const Check& c) {
      return is(c, quantity::stroke, 0, in.fine_axes[k].name) && c.value <= least_stroke;
    });
  return still;
}

/// Returns the factor, 1/mm, by which a shift of an end of the segment turns its tangent there.
double turned_by(const AxisPath& path, std::size_t segment, const AxisJet& q) {
  double bent = 0;
  for (std::size_t k = 0; k < path.axes(); ++k) bent += q.d2[k] * q.d2[k];
  return 1 / path[segment].length() + std::sqrt(bent);
}

/// Returns by how much derivative 1 or 2 of axis k changes with the place along the path, per mm.
double change_along(const AxisJet& q, const LawState& x, std::size_t k, std::size_t derivative) {
  return derivative == 1 ? std::abs(q.d2[k]) * x.v : std::abs(q.d3[k]) * x.v * x.v + std::abs(q.d2[k] * x.a);
}

/// Returns the jump of a coarse axis' velocity, for an axis that follows the path, caused by rounding of path lengths
/// where two pieces of the law meet.
double bent_by_rounding(const CoarseFineToVerify& in, const LawPiece& before, const LawPiece& after, std::size_t k,
                        std::size_t derivative) {
  if (derivative == 0) return 0;
  const double off = rounding_of(before).position + rounding_of(after).position;
  double most = 0;
  for (const bool behind : {false, true}) {
    const LawPiece& p = behind ? after : before;
    const LawState x = behind ? p.at(0) : p.at(p.duration);
    const AxisJet q = in.path.at(p.segment, behind ? p.s : p.s_end);
    most = std::max(most, change_along(q, x, k, derivative));
  }
  return off * most;
}

/// Returns how far rounding leaves a derivative of the head's axis k open at time t, on either side of it, inside a
/// piece of its law: an axis that follows the head in parts of a piece has the rounding of the whole piece.
double rounding_of_head(const CoarseFineToVerify& in, const LawPiece& p, std::size_t k, std::size_t derivative,
                        double t) {
  if (p.segment >= in.path.size()) return 0;
  const PieceRounding r = rounding_of(p);
  const LawState x = p.at(std::clamp(t - p.t0, 0.0, p.duration));
  const AxisJet q = in.path.at(p.segment, x.s);
  const double d1 = std::abs(q.d1[k]);
  if (derivative == 0) return 2 * d1 * r.position;
  const double own = derivative == 1 ? d1 * r.speed : d1 * r.acceleration + 2 * std::abs(q.d2[k]) * x.v * r.speed;
  return 2 * (own + change_along(q, x, k, derivative) * r.position);
}

/// Returns the jumps that a coarse axis may have at time t: of its position by the head's rounding, of its derivatives
/// by the head's own jumps at joints as far as rounding of points causes them, and by the rounding of its law; an axis
/// that is `alone`, because its fine axis does not exist or stands still, may also jump at a tangent jump like any axis
/// of a machine.
double step_of_the_head(const CoarseFineToVerify& in, bool alone, std::size_t k, std::size_t derivative, double t) {
  if (derivative > 2) return 0;
  const bool rounded = derivative > 0 && !alone;
  const Limits& axis = in.coarse_axes[k];
  const double most =
      derivative == 0 || rounded ? unlimited : in.cycle_time * (derivative == 1 ? axis.acceleration : axis.jerk);
  if (derivative > 0 && !rounded && !std::isfinite(most)) return 0;
  const auto& pieces = in.law.pieces();
  const double blur = 2 * rounding * t;
  auto piece = std::lower_bound(pieces.begin(), pieces.end(), t - blur,
                                [](const LawPiece& p, double time) { return p.t0 < time; });
  double jump = 0, bends = 0;
  const bool border = piece != pieces.end() && piece->t0 <= t + blur;  // whether t is where two pieces of the law meet
  const double inside = border || piece == pieces.begin() ? 0 : rounding_of_head(in, *(piece - 1), k, derivative, t);
  for (; piece != pieces.end() && piece->t0 <= t + blur; ++piece) {
    if (piece == pieces.begin() || piece->segment >= in.path.size()) continue;
    bends = std::max(bends, bent_by_rounding(in, *(piece - 1), *piece, k, derivative));
    if (derivative == 0) {  // the head's own places there have the rounding of their segments
      for (const LawPiece& p : {*(piece - 1), *piece})
        jump = std::max(jump, 2 * rounding * size_of(in.path, p.segment, in.path.at(p.segment, p.s)));
      continue;
    }
    if (piece->segment == (piece - 1)->segment) continue;
    const std::size_t before = (piece - 1)->segment;
    const AxisJet left = in.path.at_parameter(before, in.path[before].curve().end()),
                  right = in.path.at_parameter(piece->segment, in.path[piece->segment].curve().begin());
    double tangent = std::abs(right.d1[k] - left.d1[k]), curvature = std::abs(right.d2[k] - left.d2[k]);
    const double before_size = rounding * size_of(in.path, before, left),
                 after_size = rounding * size_of(in.path, before + 1, right),
                 before_turn = turned_by(in.path, before, left), after_turn = turned_by(in.path, before + 1, right),
                 turned = before_size * before_turn + after_size * after_turn,
                 bent = before_size * before_turn * before_turn + after_size * after_turn * after_turn;
    tangent = rounded ? std::min(tangent, turned) : tangent + turned;
    curvature = rounded ? std::min(curvature, bent) : curvature + bent;
    const LawState end = (piece - 1)->at((piece - 1)->duration);
    const double v = std::max(end.v, piece->v), a = std::max(std::abs(end.a), std::abs(piece->a));
    jump = std::max(jump, derivative == 1 ? tangent * v : curvature * v * v + tangent * a);
  }
  return std::min(jump, most) * (1 + 1e-9) + bends + inside;
}

}  // namespace
}  // namespace verify

std::vector<Check> coarse_fine_checks(const CoarseFineToVerify& input, Progress progress) {
  const std::size_t axes = input.path.axes();
  if (!input.path.cartesian() || input.coarse.axes() != axes || input.coarse_axes.size() != axes ||
      input.fine_axes.size() != axes)
    throw std::invalid_argument("coarse and fine axes are verified along a Cartesian path of as many axes");
  constexpr double of_fine = 0.7;  // part of the progress
  ProgressScope scope(progress.part(0, of_fine), "verify");
  const std::vector<Check> fine = verify::FineSweep(input, scope).run();
  const std::vector<bool> alone = verify::still_axes(input, fine);
  MotionToVerify coarse{input.coarse, input.coarse_axes};
  coarse.continuous = input.order - 1;
  // The pieces were fitted to the head's times, so both ends of each may be off by the rounding of t once more.
  coarse.resolution = std::numeric_limits<double>::epsilon() * input.law.duration();
  coarse.step = [&input, &alone](std::size_t axis, std::size_t derivative, double t) {
    return verify::step_of_the_head(input, alone[axis], axis, derivative, t);
  };
  coarse.group = "coarse";
  coarse.unit = "mm";
  std::vector<Check> list = motion_checks(coarse, progress.part(of_fine, 1));
  list.insert(list.end(), fine.begin(), fine.end());
  verify::Strained duration;
  duration.raise(std::abs(input.coarse.duration() - input.law.duration()), verify::rounding * input.law.duration(),
                 input.law.duration());
  list.push_back(verify::make_check({{"duration", CheckGroup::continuity}, 0, "s", "coarse"}, duration));
  return list;
}

}  // namespace bahnwerk
