#include "core/verify/law/axis_peaks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/numeric/peak.hpp"
#include "core/verify/law/arc_length_check.hpp"
#include "core/verify/law/channel_bounds.hpp"
#include "core/verify/law/curve_disc.hpp"
#include "core/verify/law/local_places.hpp"
#include "core/verify/law/repeated_run.hpp"
#include "core/verify/rounding.hpp"

namespace bahnwerk::verify {
namespace {

struct Channel {
  ChannelQuantity quantity;
  std::size_t axis;
  double limit;
  bool squared() const { return quantity != ChannelQuantity::acceleration; }
};

std::vector<Channel> make_channels(const VerifierInput& in) {
  std::vector<Channel> list;
  for (const ChannelQuantity quantity :
       {ChannelQuantity::velocity, ChannelQuantity::acceleration, ChannelQuantity::jerk}) {
    const int order = static_cast<int>(quantity) + 1;
    if (order > in.order) continue;
    for (std::size_t k = 0; k < in.path.axes(); ++k)
      if (const double value = in.machine.axes[k].of(order); value < unlimited) list.push_back({quantity, k, value});
  }
  return list;
}

std::vector<double> scales(const std::vector<Channel>& channels) {
  std::vector<double> list;
  for (const Channel& c : channels) list.push_back(c.squared() ? c.limit * c.limit : c.limit);
  return list;
}

/// An interpolation error beyond this part of a limit helps nobody: halve without looking.
constexpr double useful = 0.1, resolution = 1e-11;
/// Relative rounding of a sample.
constexpr double rounded_samples = 2e-12;

class Sweeper {
 public:
  Sweeper(const VerifierInput& in, ProgressScope& progress)
      : in_(in),
        progress_(progress),
        channels_(make_channels(in)),
        peaks_(scales(channels_), resolution, rounded_samples),
        worst_(channels_.size()),
        repeated_(in),
        places_(in),
        arc_length_(progress) {
    if (const auto* path = dynamic_cast<const KinematicAxisPath*>(&in.path)) through_.emplace(*path);
  }

  AxisPeaks run() {
    const auto& pieces = in_.law.pieces();
    for (index_ = 0; index_ < pieces.size(); ++index_) {
      progress_.work(1);
      if (!(pieces[index_].v > 0)) end_motion();
      if (index_ == 0 || pieces[index_].segment != pieces[index_ - 1].segment) {
        const std::size_t next = repeated_.skip(index_);
        progress_.work((next - index_) / 16);
        if (next > index_) {
          index_ = next - 1;
          continue;
        }
      }
      if (index_ % 256 == 0) progress_.done(static_cast<double>(index_) / static_cast<double>(pieces.size()));
      const LawPiece& piece = pieces[index_];
      if (piece.segment < in_.path.size()) check_piece(piece, in_.path[piece.segment]);
    }
    end_motion();
    AxisPeaks result;
    for (std::size_t c = 0; c < channels_.size(); ++c) {
      const bool before = !worst_[c].finite || (peaks_[c].finite && worst_[c].value > peaks_[c].value);
      result.checks.push_back(check(c, before ? worst_[c] : peaks_[c]));
    }
    result.too_fast = std::move(too_fast_);
    result.arc_length = arc_length_.worst();
    result.estimated = peaks_.estimated();
    return result;
  }

 private:
  // Channel c where the axes have the derivatives d1, d2, d3, in what is searched (squares for velocity and jerk).
  static double value(const Channel& c, double d1, double d2, double d3, double b, double a) {
    if (c.quantity == ChannelQuantity::velocity) return d1 * d1 * b;
    if (c.quantity == ChannelQuantity::acceleration) return d2 * b + d1 * a;
    const double r = d3 * b + 3 * d2 * a;
    return b * r * r;
  }
  static double value(const Channel& c, double d1, double d2, double d3, const LawState& x) {
    if (c.quantity != ChannelQuantity::jerk) return value(c, d1, d2, d3, x.v * x.v, x.a);
    const double r = d3 * x.v * x.v * x.v + 3 * d2 * x.v * x.a + d1 * x.j;
    return r * r;
  }

  // Evaluates all channels at the parameters in batch_, where the law's state is state(i).
  template <class State>
  void fill(std::size_t segment, int points, double* values, State&& state) {
    batch_.count = static_cast<std::size_t>(points);
    in_.path.at_parameters(segment, batch_);
    for (std::size_t c = 0; c < channels_.size(); ++c) {
      const Channel& channel = channels_[c];
      const std::size_t k = channel.axis;
      double* out = values + c * static_cast<std::size_t>(points);
      const bool still = batch_.planar && k >= 2;
      for (int i = 0; i < points; ++i) {
        const auto at = static_cast<std::size_t>(i);
        out[i] = still ? 0 : state(channel, batch_.d1[k][at], batch_.d2[k][at], batch_.d3[k][at], at);
      }
    }
  }

  // Sets the interpolation error per channel, by bounds(disc) about u, for an interval of half width `half`; without
  // bounds of the axes it remains unknown.
  template <class Bounds>
  void tell_missing(PeakSamples& samples, std::size_t segment, double u, double half, Bounds&& bounds) {
    const CurveDisc disc = discs(segment).about(u);
    std::array<ChannelBounds, max_axes> all;
    if (in_.path.cartesian()) {
      all.fill(bounds(disc));
    } else {
      const std::array<CurveDisc, max_axes>* axes = through_ ? through_->about(segment, disc, half) : nullptr;
      if (axes == nullptr) return;
      for (std::size_t k = 0; k < in_.path.axes(); ++k) all[k] = bounds((*axes)[k]);
    }
    samples.empty = !samples.last;
    for (std::size_t c = 0; c < channels_.size(); ++c) {
      const double m = all[channels_[c].axis][static_cast<std::size_t>(channels_[c].quantity)];
      samples.missing[c] = m;
      if (m <= useful * peaks_.scale(c)) samples.empty = false;
    }
    if (samples.more && !peaks_.promising(samples.missing)) samples.empty = true;
  }

  bool at_vanishing_tangent(std::size_t segment, double begin, double end) {
    const CurveDiscs& all = discs(segment);
    return all.vanishing() > 0 && (begin <= all.vanishing_at() && end >= all.vanishing_at());
  }

  // Sets the interpolation error next to a vanishing tangent, where the law has to be at rest. A motion there is
  // rounding, or another check reports it; it leaves an estimate.
  void tell_from_rest(PeakSamples& samples, const LawPiece& piece, double begin, double half, double b0, double b1) {
    CurveDiscs& all = discs(piece.segment);
    const double resting = begin <= all.vanishing_at() && all.vanishing_at() < begin + half ? b0 : b1;
    const CurveDisc& disc = all.at_vanishing_tangent();
    if (!in_.path.cartesian() || !(disc.radius > 0) || !(resting <= 1e-24 * std::max(b0, b1)) ||
        samples.rule.node[0] == 0)
      return;
    const ChannelBounds bounds = bounds_from_rest(piece.a, half, disc, all.vanishing());
    for (std::size_t c = 0; c < channels_.size(); ++c) {
      const double m = bounds[static_cast<std::size_t>(channels_[c].quantity)];
      if (m < std::numeric_limits<double>::infinity() || half > disc.radius / 8) samples.missing[c] = m;
    }
  }

  CurveDiscs& discs(std::size_t segment) {
    if (!discs_ || discs_of_ != segment)
      discs_.emplace(in_.path[segment].curve(), discs_ ? discs_->start() : CurveDiscs::largest), discs_of_ = segment;
    return *discs_;
  }

  void check_piece(const LawPiece& piece, const Segment& segment) {
    const double finite = piece.s + piece.s_end + piece.v + piece.a + piece.j + piece.snap + piece.duration;
    if (!std::isfinite(finite)) {
      for (std::size_t c = 0; c < channels_.size(); ++c) peaks_.raise(c, finite, 0, index_);
      return;
    }
    if (in_.path.linear(piece.segment)) return straight(piece);
    if (!piece.constant_acceleration()) return over_time(piece, segment);
    over_parameter(piece, segment);
  }

  void straight(const LawPiece& piece) {
    if (piece.segment != tangent_of_) {
      tangent_of_ = piece.segment;
      tangent_ = in_.path.at_parameter(piece.segment, in_.path[piece.segment].curve().begin());
    }
    auto offer = [&](double tau) {
      const LawState x = piece.at(tau);
      for (std::size_t c = 0; c < channels_.size(); ++c)
        peaks_.raise(c, value(channels_[c], tangent_.d1[channels_[c].axis], 0, 0, x), tau, index_);
    };
    offer(0);
    offer(piece.duration);
    for (const double tau : turning_points(piece))
      if (tau > 0 && tau < piece.duration) offer(tau);
  }

  void over_time(const LawPiece& piece, const Segment& segment) {
    // Counted from the begin of the segment: far along a path the rounding of s would show as noise.
    LawPiece local = piece;
    local.s = places_.begin(index_);
    const double u0 = begin_of(piece, segment), half_way = local.at(0.5 * piece.duration).s;
    // Two parameters at once take little longer than one.
    const PointPair inner = segment.parameter_at(PointPair{places_.looked_at(index_, half_way), places_.end(index_)});
    const double u1 = end_at(piece, places_.at_end(index_) ? segment.curve().end() : inner[1]);
    if (segment.curve().kind() == CurveKind::rational) {
      const double s0 = segment.travelled(u0), s1 = segment.travelled(u1);
      arc_length_.believe(piece, segment, s1 - s0);
      arc_length_.measure(piece, segment, {u0, s0}, {u1, s1});
    }
    const bool open = segment.cusp_begin() || segment.cusp_end(), vanishing = discs(piece.segment).vanishing() > 0;
    peaks_.sweep(0, piece.duration, open, index_, [&](PeakSamples& samples) {
      const int n = samples.rule.points;
      progress_.work(static_cast<std::size_t>(n));
      const double half = 0.5 * (samples.end - samples.begin);
      const LawPiece here = moved(local, samples.begin + half);
      const double middle = here.s == half_way ? inner[0] : segment.parameter_at(places_.looked_at(index_, here.s));
      if (!vanishing || !at_vanishing_tangent(piece.segment, segment.parameter_at(local.at(samples.begin).s),
                                              segment.parameter_at(local.at(samples.end).s)))
        tell_missing(samples, piece.segment, middle, (u1 - u0) * half / piece.duration,
                     [&](const CurveDisc& disc) { return bounds_over_time(here, half, disc, n); });
      if (samples.empty) return false;
      std::size_t waiting = 0;  // the number of a point whose parameter is not known yet, from 1
      for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
        const double tau = samples.at(static_cast<int>(i));
        const LawState& at = state_[i] = local.at(tau);
        if (tau <= 0 || tau >= piece.duration || at.s == here.s) {
          batch_.u.set(i, tau <= 0 ? u0 : tau >= piece.duration ? u1 : middle);
        } else if (waiting == 0) {
          waiting = i + 1;
        } else {
          const PointPair u = segment.parameter_at(
              PointPair{places_.looked_at(index_, state_[waiting - 1].s), places_.looked_at(index_, at.s)});
          batch_.u.set(waiting - 1, u[0]);
          batch_.u.set(i, u[1]);
          waiting = 0;
        }
      }
      if (waiting > 0)
        batch_.u.set(waiting - 1, segment.parameter_at(places_.looked_at(index_, state_[waiting - 1].s)));
      fill(piece.segment, n, samples.values, [&](const Channel& c, double d1, double d2, double d3, std::size_t i) {
        return value(c, d1, d2, d3, state_[i]);
      });
      return true;
    });
  }

  // Parameters of the ends, that of the begin from the piece before where it ended there.
  double begin_of(const LawPiece& piece, const Segment& segment) {
    if (index_ > 0 && end_segment_ == piece.segment && end_s_ == piece.s) return end_u_;
    return piece.s < segment.s1() ? segment.parameter_at(places_.begin(index_)) : segment.curve().end();
  }
  double end_of(const LawPiece& piece, const Segment& segment) {
    return end_at(piece, places_.at_end(index_) ? segment.curve().end() : segment.parameter_at(places_.end(index_)));
  }
  double end_at(const LawPiece& piece, double u) {
    end_segment_ = piece.segment, end_s_ = piece.s_end, end_u_ = u;
    return u;
  }

  void over_parameter(const LawPiece& piece, const Segment& segment) {
    const double u0 = begin_of(piece, segment), u1 = end_of(piece, segment);
    const double v1 = piece.v + piece.a * piece.duration, b0 = piece.v * piece.v, b1 = v1 * v1;
    // Counted from where the piece begins: far along a path the rounding of s would pass for quadrature's error.
    const double before = segment.travelled(u0), ds = segment.travelled(u1) - before;
    if (!(u1 > u0) || !(ds > 0)) {  // standing still, or shorter than the parameter resolves
      AxisJet q = in_.path.at_parameter(piece.segment, u0);
      if (b0 == 0 && b1 == 0) q.d2 = q.d3 = {};  // they are infinite at a cusp, where nothing moves
      for (std::size_t c = 0; c < channels_.size(); ++c) {
        const std::size_t k = channels_[c].axis;
        for (const double b : {b0, b1})
          peaks_.raise(c, value(channels_[c], q.d1[k], q.d2[k], q.d3[k], b, piece.a), u0, index_);
      }
      return;
    }
    const Curve& curve = segment.curve();
    const bool open = (segment.cusp_begin() && u0 <= curve.begin()) || (segment.cusp_end() && u1 >= curve.end());
    const bool even = curve.kind() != CurveKind::rational;  // s is linear in u
    if (!even) arc_length_.believe(piece, segment, ds);
    std::array<double, ChebyshevRule::max_points> speed, s;
    peaks_.sweep(u0, u1, open, index_, [&](PeakSamples& samples) {
      const ChebyshevRule& rule = samples.rule;
      const double begin = samples.begin, end = samples.end;
      const int n = rule.points;
      progress_.work(static_cast<std::size_t>(n));
      bool resolved = true;
      double from = 0, to = ds;
      if (even) {
        from = (begin - u0) / (u1 - u0) * ds, to = from + (end - begin) / (u1 - u0) * ds;
      } else {
        if (begin != u0) from = segment.travelled(begin) - before;
        if (end != u1) to = segment.travelled(end) - before;
      }
      const double half = 0.5 * (end - begin);
      if (at_vanishing_tangent(piece.segment, begin, end)) {
        tell_from_rest(samples, piece, begin, half, b0, b1);
      } else {
        const double fastest = std::max(b0 + (b1 - b0) * (from / ds), b0 + (b1 - b0) * (to / ds));
        tell_missing(samples, piece.segment, begin + half, half, [&](const CurveDisc& disc) {
          return bounds_over_parameter(fastest, piece.a, half, disc, n, even);
        });
      }
      if (samples.empty) return false;
      for (int i = 0; i < n; ++i) batch_.u.set(static_cast<std::size_t>(i), samples.at(i));
      if (even) {
        for (int i = 0; i < n; ++i) s[i] = from + rule.node[i] * (to - from);
      } else {
        double whole = 0;
        for (int i = 0; i < n; ++i) {
          speed[i] = curve.speed(samples.at(i));
          whole += rule.whole[i] * speed[i];
        }
        const double miss = std::abs(whole * (end - begin) - (to - from));
        resolved = miss <= ArcLengthCheck::resolution(segment, to - from);
        if (resolved) arc_length_.raise(miss, segment, to - from, piece.t0);
        for (int i = 0; i < n; ++i) {
          double part = 0;
          for (int j = 0; j < n; ++j) part += rule.integral[i][j] * speed[j];
          s[i] = from + part / whole * (to - from);
        }
        if (!open) s[0] = from, s[n - 1] = to;
      }
      for (int i = 0; i < n; ++i) s[i] = b0 + (b1 - b0) * (s[i] / ds);
      fill(piece.segment, n, samples.values, [&](const Channel& c, double d1, double d2, double d3, std::size_t i) {
        return value(c, d1, d2, d3, s[i], piece.a);
      });
      return resolved;
    });
  }

  // Called at a rest, and at the end. A peak that exceeds its limit counts for the motion before; it is stored
  // separately, so that one in the next motion is found even if it is lower. Peaks within the limit are searched over
  // the whole law.
  void end_motion() {
    TooFast most;
    for (std::size_t c = 0; c < channels_.size(); ++c) {
      if (peaks_[c].finite && peaks_[c].value <= peaks_.scale(c)) continue;
      const Check found = check(c, peaks_[c]);
      if (found.passed || !peaks_[c].finite) continue;
      if (found.value > most.factor * found.limit) most = {found.at, found.value / found.limit};
      const Peak peak = peaks_.restart(c, peaks_.scale(c));
      if (peak.value > worst_[c].value) worst_[c] = peak;
    }
    if (most.factor > 1) too_fast_.push_back(most);
  }

  Check check(std::size_t c, const Peak& peak) const {
    const Channel& channel = channels_[c];
    Worst worst{channel.squared() ? std::sqrt(peak.value) : peak.value, 0};
    if (!peak.finite) worst.value = std::numeric_limits<double>::quiet_NaN();
    if (peak.tag < in_.law.pieces().size()) worst.at = moment(in_.law.pieces()[peak.tag], peak.at);
    const AxisLimits& axis = in_.machine.axes[channel.axis];
    const int order = static_cast<int>(channel.quantity) + 1;
    return make_check({quantity::axis, order, axis.unit, axis.name}, channel.limit, worst);
  }

  // Returns the time at which a piece passes the place where its peak was found.
  double moment(const LawPiece& piece, double at) const {
    if (piece.segment >= in_.path.size()) return piece.t0;
    const Segment& segment = in_.path[piece.segment];
    if (in_.path.linear(piece.segment) || !piece.constant_acceleration()) return piece.t0 + at;
    const double ds = piece.s_end - piece.s, s = std::clamp(segment.arc_length(at) - piece.s, 0.0, std::max(ds, 0.0));
    const double v1 = piece.v + piece.a * piece.duration;
    const double b = ds > 0 ? piece.v * piece.v + (v1 * v1 - piece.v * piece.v) * (s / ds) : 0;
    const double sum = piece.v + std::sqrt(std::max(b, 0.0));
    return piece.t0 + (sum > 0 ? std::clamp(2 * s / sum, 0.0, piece.duration) : 0.0);
  }

  const VerifierInput& in_;
  ProgressScope& progress_;
  std::vector<Channel> channels_;
  PeakSweep peaks_;
  std::vector<Peak> worst_;  // largest peaks of the motions before in which the limit was exceeded
  std::vector<TooFast> too_fast_;
  RepeatedRuns repeated_;
  LocalPlaces places_;
  std::optional<AxisDiscsAlong> through_;  ///< discs of axes that follow the path through kinematics
  ArcLengthCheck arc_length_;
  std::size_t index_ = 0;
  std::size_t end_segment_ = static_cast<std::size_t>(-1);  // end of the last piece, to invert u(s) once per piece
  double end_s_ = 0, end_u_ = 0;
  std::size_t tangent_of_ = static_cast<std::size_t>(-1);
  AxisJet tangent_;
  std::optional<CurveDiscs> discs_;
  std::size_t discs_of_ = 0;
  PathBatch batch_;
  std::array<LawState, ChebyshevRule::max_points> state_;
};

}  // namespace

AxisPeaks axis_peaks(const VerifierInput& input, ProgressScope& progress) { return Sweeper(input, progress).run(); }

}  // namespace bahnwerk::verify
