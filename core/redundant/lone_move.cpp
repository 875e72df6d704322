#include "core/redundant/lone_move.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/motion/profile/profile.hpp"

namespace bahnwerk {
namespace {

constexpr double share = 1 - 1e-10;  // of limits and strokes: so that rounding leaves them held
constexpr double least_way = 1e-9;   // of the move, that is left to the coarse axes where both are in proportion
constexpr int halvings = 60;
constexpr int parts = 16, thirds = 60;  // of a search over σ
constexpr double rounding = 1e-13;      // of a duration: shorter pieces are none

/// What one stage may do along the line.
ProfileLimits stage(const AxisJet& jet, const CoarseFineMachine& machine, Limits CoarseFineAxis::*limits) {
  ProfileLimits along;
  for (std::size_t k = 0; k < machine.axes.size(); ++k) {
    const double rate = std::abs(jet.d1[k]);
    if (rate == 0) continue;
    const Limits& axis = machine.axes[k].*limits;
    along.velocity = std::min(along.velocity, share * axis.velocity / rate);
    along.acceleration = std::min(along.acceleration, share * axis.acceleration / rate);
    along.jerk = std::min(along.jerk, share * axis.jerk / rate);
  }
  return along;
}

/// A profile, slowed.
struct Slowed {
  Profile profile;
  double factor = 1;
  ProfileState at(double t) const {
    ProfileState x = profile.sample(t / factor);
    x.v /= factor, x.a /= factor * factor, x.j /= factor * factor * factor;
    return x;
  }
  double duration() const { return profile.duration * factor; }
  void last(double time) { factor = profile.duration > 0 ? time / profile.duration : 1; }
};

struct Stages {
  Slowed coarse, fine;
  double half = 0;  // σ
  double duration = unlimited;
};

class Search {
 public:
  Search(double length, double half, const ProfileLimits& coarse, const ProfileLimits& fine, double feed)
      : length_(length), most_(std::min(half, 0.5 * length)), coarse_(coarse), fine_(fine), feed_(feed) {}

  Stages best() const {
    Stages best = apart();
    if (peak(best) > feed_) best = together();
    return best;
  }

 private:
  static Profile moved(double way, const ProfileLimits& limits) { return straight_profile(way, 0, 0, limits); }
  double coarse_time(double half) const {
    const double way = length_ - 2 * half;
    return way > 0 ? moved(way, coarse_).duration : 0;
  }
  double fine_time(double half) const { return half > 0 ? moved(2 * half, fine_).duration : 0; }

  /// Each by itself.
  Stages apart() const {
    double low = 0, high = most_;
    if (fine_time(high) > coarse_time(high))
      for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (low + high);
        (fine_time(middle) > coarse_time(middle) ? high : low) = middle;
      }
    else
      low = high;
    Stages s;
    s.half = low;
    if (const double way = length_ - 2 * s.half; way > 0) s.coarse.profile = moved(way, coarse_);
    if (s.half > 0) s.fine.profile = moved(2 * s.half, fine_);
    s.duration = std::max(s.coarse.profile.duration, s.fine.profile.duration);
    s.coarse.last(s.duration), s.fine.last(s.duration);
    return s;
  }

  /// The largest speed of both.
  static double peak(const Stages& s) {
    double most = 0;
    for (const Slowed* one : {&s.coarse, &s.fine})
      for (const ProfilePiece& p : one->profile.pieces()) {
        const double t = p.t0 * one->factor;
        most = std::max(most, s.coarse.at(t).v + s.fine.at(t).v);
      }
    return most * (1 - 1e-12);
  }

  /// Limits of a profile of the whole way that both follow in proportion.
  ProfileLimits proportional(double half) const {
    const double fine = 2 * half / length_, coarse = 1 - fine;
    const auto least = [&](double a, double b) { return std::min(a / coarse, fine > 0 ? b / fine : unlimited); };
    return {std::min(feed_, least(coarse_.velocity, fine_.velocity)), least(coarse_.acceleration, fine_.acceleration),
            least(coarse_.jerk, fine_.jerk), unlimited};
  }
  Stages together() const {
    const double most = std::min(most_, 0.5 * length_ * (1 - least_way));
    const auto time = [&](double half) { return moved(length_, proportional(half)).duration; };
    double best = 0, least = time(0);
    for (int i = 0; i < parts; ++i) {  // in every part a search as if there were one minimum
      double low = most * i / parts, high = most * (i + 1) / parts;
      for (int k = 0; k < thirds; ++k) {
        const double a = low + (high - low) / 3, b = high - (high - low) / 3;
        (time(a) > time(b) ? low : high) = time(a) > time(b) ? a : b;
      }
      for (const double half : {most * (i + 1) / parts, 0.5 * (low + high)})
        if (const double t = time(half); t < least) least = t, best = half;
    }
    const ProfileLimits limits = proportional(best);
    const auto part = [&](double of) {
      return ProfileLimits{limits.velocity * of, limits.acceleration * of, limits.jerk * of, unlimited};
    };
    const double fine = 2 * best / length_;
    Stages s;
    s.half = best;
    s.coarse.profile = moved(length_ - 2 * best, part(1 - fine));
    if (best > 0) s.fine.profile = moved(2 * best, part(fine));
    s.duration = std::max(s.coarse.profile.duration, s.fine.profile.duration);
    s.coarse.last(s.duration), s.fine.last(s.duration);
    return s;
  }

  double length_, most_;
  ProfileLimits coarse_, fine_;
  double feed_;
};

/// The polynomial from one time to another that fits what the stage does at both: its velocities, with limited jerk its
/// accelerations, too. So pieces fit together whatever rounding does to a border of another stage nearby.
ProfileState between(const Slowed& stage, double begin, double end, bool jerk) {
  ProfileState x = stage.at(begin);
  const ProfileState y = stage.at(end);
  const double h = end - begin, mean = (y.v - x.v) / h;
  if (!jerk) return {x.s, x.v, mean, 0, 0};
  const double da = (y.a - x.a) / h, dv = (mean - x.a) / h;  // j + q h/2, j/2 + q h/6
  x.snap = 6 * (da - 2 * dv) / h;
  x.j = da - 0.5 * h * x.snap;
  return x;
}

std::vector<double> borders(const Stages& s) {
  std::vector<double> times;
  for (const Slowed* one : {&s.coarse, &s.fine})
    for (const ProfilePiece& p : one->profile.pieces()) times.push_back(p.t0 * one->factor);
  std::sort(times.begin(), times.end());
  std::vector<double> apart{0};
  for (const double t : times)
    if (t > apart.back() + rounding * s.duration && t < s.duration * (1 - rounding)) apart.push_back(t);
  apart.push_back(s.duration);
  return apart;
}

}  // namespace

std::optional<LoneMove> lone_move(const AxisPath& path, const CoarseFineMachine& machine, double feed) {
  if (path.size() != 1 || !path.linear(0)) return std::nullopt;
  const double length = path.length();
  const AxisJet jet = path.at(0, 0);
  ProfileLimits coarse = stage(jet, machine, &CoarseFineAxis::coarse),
                fine = stage(jet, machine, &CoarseFineAxis::fine);
  if (!(coarse.acceleration < unlimited)) return std::nullopt;
  double half = unlimited;
  for (std::size_t k = 0; k < machine.axes.size(); ++k)
    if (const double rate = std::abs(jet.d1[k]); rate > 0) half = std::min(half, share * machine.axes[k].stroke / rate);
  const Stages s = Search(length, half, coarse, fine, share * feed).best();
  const bool jerk = coarse.jerk < unlimited;
  LoneMove move;
  const std::vector<double> times = borders(s);
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    const double t = times[i], end = times[i + 1], h = end - t;
    const ProfileState c = between(s.coarse, t, end, jerk), f = between(s.fine, t, end, jerk);
    const ProfileState ce = s.coarse.at(end), fe = s.fine.at(end);
    const bool last = i + 2 == times.size();
    move.head.append(
        {0, h, c.s + f.s, last ? length : ce.s + fe.s, c.v + f.v, c.a + f.a, c.j + f.j, 0, c.snap + f.snap});
    SplineMotion::Piece piece{move.head.duration(), {}};
    for (std::size_t k = 0; k < machine.axes.size(); ++k) {
      const double rate = jet.d1[k];
      piece.axes.push_back(
          {jet.value[k] + rate * (s.half + c.s), rate * c.v, rate * c.a / 2, rate * c.j / 6, rate * c.snap / 24});
    }
    move.coarse.push_back(std::move(piece));
  }
  return move;
}

}  // namespace bahnwerk
