#include "core/redundant/coarse/lone_move.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/motion/profile/profile.hpp"

namespace bahnwerk {
namespace {

constexpr double share = 1 - 1e-10;  // used share of limits and strokes, so that they hold in spite of rounding
// relative rounding that sums of coordinates, speeds and accelerations collect
constexpr double places = 32 * std::numeric_limits<double>::epsilon();
constexpr double least_way = 1e-9;  // least share of the move for the coarse axes if both stages move in proportion
constexpr int halvings = 60;
constexpr int parts = 16, thirds = 60;  // parts of the range of σ, and steps of the search in each
constexpr double rounding = 1e-13;      // relative duration of pieces that are left out

/// Limits of one stage along the line.
Limits stage(const AxisJet& jet, const CoarseFineMachine& machine, Limits CoarseFineAxis::*limits) {
  Limits along;
  for (std::size_t k = 0; k < machine.axes.size(); ++k) {
    Limits axis = machine.axes[k].*limits;
    axis.scale(share);
    if (const double rate = std::abs(jet.d1[k]); rate > 0) along.lower_to(axis, rate);
  }
  return along;
}

/// A profile that begins at time `begin`, lasts `factor` times as long as planned and is multiplied by `weight`.
struct Part {
  Profile profile;
  double factor = 1, begin = 0, weight = 1;
  void add_to(ProfileState& sum, double t) const {
    if (t < begin) return;
    const ProfileState x = profile.sample((t - begin) / factor);
    double w = weight;
    sum.s += w * x.s, w /= factor;
    sum.v += w * x.v, w /= factor;
    sum.a += w * x.a, w /= factor;
    sum.j += w * x.j;
    if (const double gone = t - end(); gone > 0) sum.s += gone * weight * profile.end_speed / factor;
  }
  double end() const { return begin + profile.duration * factor; }
};

/// Motion of one stage: the sum of its parts.
struct Stage {
  std::vector<Part> parts;
  ProfileState at(double t) const {
    ProfileState sum;
    double most = 0;
    for (const Part& part : parts) {
      part.add_to(sum, t);
      most += std::abs(part.weight) * part.profile.peak_acceleration / (part.factor * part.factor);
    }
    if (std::abs(sum.a) <= places * most) sum.a = 0;  // or seconds of it at one speed add up to picometres
    return sum;
  }
  void add(const Profile& profile, double factor = 1, double begin = 0, double weight = 1) {
    parts.push_back({profile, factor, begin, weight});
  }
  /// Slows a stage of one part so that it lasts the given time.
  void last(double time) {
    for (Part& part : parts) part.factor = time / part.profile.duration;
  }
};

struct Stages {
  Stage coarse, fine;
  Stage head() const {
    Stage both = coarse;
    both.parts.insert(both.parts.end(), fine.parts.begin(), fine.parts.end());
    return both;
  }
  double half = 0;  // σ
  double duration = unlimited;
  /// Returns the ascending begins of the pieces of both stages, and the end.
  std::vector<double> borders() const {
    std::vector<double> times;
    for (const Stage* one : {&coarse, &fine})
      for (const Part& part : one->parts) {
        for (const ProfilePiece& p : part.profile.pieces()) times.push_back(part.begin + p.t0 * part.factor);
        times.push_back(part.end());
      }
    std::sort(times.begin(), times.end());
    std::vector<double> apart{0};
    for (const double t : times)
      if (t > apart.back() + rounding * duration && t < duration * (1 - rounding)) apart.push_back(t);
    apart.push_back(duration);
    return apart;
  }
};

class Search {
 public:
  Search(double length, double half, const Limits& coarse, const Limits& fine, double feed)
      : length_(length), most_(std::min(half, 0.5 * length)), coarse_(coarse), fine_(fine), feed_(feed) {}

  Stages best() const {
    Stages best = apart();
    if (!(peak(best) > feed_)) return best;
    best = together();
    if (Stages other = at_feed(); other.duration < best.duration) best = std::move(other);
    return best;
  }

 private:
  static Profile moved(double way, const Limits& limits) { return straight_profile(way, 0, 0, limits); }
  double coarse_time(double half) const {
    const double way = length_ - 2 * half;
    return way > 0 ? moved(way, coarse_).duration : 0;
  }
  double fine_time(double half) const { return half > 0 ? moved(2 * half, fine_).duration : 0; }

  /// Both stages move independently at their own limits.
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
    if (const double way = length_ - 2 * s.half; way > 0) s.coarse.add(moved(way, coarse_));
    if (s.half > 0) s.fine.add(moved(2 * s.half, fine_));
    last_alike(s);
    return s;
  }
  /// Both stages take the time of the slower one.
  static void last_alike(Stages& s) {
    s.duration = 0;
    for (const Stage* one : {&s.coarse, &s.fine})
      for (const Part& part : one->parts) s.duration = std::max(s.duration, part.end());
    s.coarse.last(s.duration), s.fine.last(s.duration);
  }

  /// Returns the largest sum of both speeds.
  static double peak(const Stages& s) {
    double most = 0;
    for (const double t : s.borders()) most = std::max(most, s.coarse.at(t).v + s.fine.at(t).v);
    return most * (1 - 1e-12);
  }

  /// The coarse axes accelerate to the feed and brake from it in their own time; the fine axes add a move of length q
  /// at both ends, so the head reaches the feed q/feed earlier. After the first move the fine axes return as far as the
  /// second one needs, while the head keeps its feed and the coarse axes are ahead of it.
  Stages at_feed() const {
    Limits driven = coarse_;
    driven.velocity = std::min(driven.velocity, feed_);
    if (!(coarse_.velocity >= feed_)) return {};
    const bool jerk = coarse_.jerk < unlimited;
    const double way = direct_distance(0, feed_, driven);
    if (!(length_ > 2 * way)) return {};
    const Profile up = straight_profile(way, 0, feed_, driven);
    // The additional move is the coarse axes' own change of speed scaled by a share of the feed, in a part of their
    // time, and its reverse in the remaining time. Its speed, acceleration and jerk are limited, and together with the
    // coarse axes' speed it stays below the feed: a share of 1 − part does so, with limited jerk a quarter in half of
    // the time.
    const double steepest = fine_.acceleration / up.peak_acceleration;
    double part = 0.5, height = 0.25;
    if (jerk) {
      height = std::min({height, fine_.velocity / feed_, steepest / 2, fine_.jerk / up.peak_jerk / 4});
    } else {
      part = std::clamp(1 / (1 + steepest), 1e-6, 0.5);
      height = std::min({1 - part, fine_.velocity / feed_, steepest * part, steepest * (1 - part)});
    }
    const auto cruise = [&](double push) { return (length_ - 2 * push - 2 * way) / feed_; };
    Limits backwards = coarse_;
    backwards.velocity -= feed_;
    backwards.lower_to(fine_);
    const auto back = [&](double push) { return std::max(0.0, 2 * push - 2 * most_); };
    const auto back_time = [&](double push) {
      return !(back(push) > 0) ? 0 : backwards.velocity > 0 ? moved(back(push), backwards).duration : unlimited;
    };
    double push = std::min(2 * most_, height * feed_ * up.duration / 2);
    if (!(back_time(push) <= cruise(push))) {
      double low = 0, high = push;
      for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (low + high);
        (back_time(middle) <= cruise(middle) ? low : high) = middle;
      }
      push = low;
    }
    if (!(push > 0)) return {};
    height = std::min(height, 2 * push / (feed_ * up.duration));
    Stages s;
    s.half = push - back(push) / 2;
    s.coarse.add(moved(length_ - 2 * push, driven));
    s.duration = s.coarse.parts.front().profile.duration;
    const double early = up.duration * part, late = up.duration - early, last = s.duration - up.duration;
    s.fine.add(up, part, 0, height * part);
    s.fine.add(up, 1 - part, early, -height * (1 - part));
    s.fine.add(up, 1 - part, last, height * (1 - part));
    s.fine.add(up, part, last + late, -height * part);
    if (back(push) > 0) {
      const Profile returned = moved(back(push), backwards);
      const double begin = 0.5 * (s.duration - returned.duration);
      s.coarse.add(returned, 1, begin);
      s.fine.add(returned, 1, begin, -1);
    }
    return s;
  }

  /// Limits of a profile of the whole length that both stages follow in proportion.
  Limits proportional(double half) const {
    const double fine = 2 * half / length_, coarse = 1 - fine;
    Limits both;
    both.velocity = feed_;
    both.lower_to(coarse_, coarse);
    if (fine > 0) both.lower_to(fine_, fine);
    return both;
  }
  Stages together() const {
    const double most = std::min(most_, 0.5 * length_ * (1 - least_way));
    const auto time = [&](double half) { return moved(length_, proportional(half)).duration; };
    double best = 0, least = time(0);
    for (int i = 0; i < parts; ++i) {  // each part is searched as if it had one minimum
      double low = most * i / parts, high = most * (i + 1) / parts;
      for (int k = 0; k < thirds; ++k) {
        const double a = low + (high - low) / 3, b = high - (high - low) / 3;
        (time(a) > time(b) ? low : high) = time(a) > time(b) ? a : b;
      }
      for (const double half : {most * (i + 1) / parts, 0.5 * (low + high)})
        if (const double t = time(half); t < least) least = t, best = half;
    }
    const Limits limits = proportional(best);
    const auto part = [&](double of) {
      Limits scaled = limits;
      scaled.scale(of);
      return scaled;
    };
    const double fine = 2 * best / length_;
    Stages s;
    s.half = best;
    s.coarse.add(moved(length_ - 2 * best, part(1 - fine)));
    if (best > 0) s.fine.add(moved(2 * best, part(fine)));
    last_alike(s);
    return s;
  }

  double length_, most_;
  Limits coarse_, fine_;
  double feed_;
};

/// Returns the polynomial between two times that has the stage's position at the first one and its velocities at both,
/// with limited jerk its accelerations, too. Adjacent pieces thus fit together even if rounding moves a border of the
/// other stage. At the end of the `last` piece velocity and acceleration are 0.
ProfileState between(const Stage& stage, double begin, double end, bool last, bool jerk) {
  ProfileState x = stage.at(begin);
  ProfileState y = stage.at(end);
  if (last) y.v = y.a = 0;  // the time's last place counts for more than theirs
  if (std::abs(y.v - x.v) <= places * std::abs(x.v)) y.v = x.v;
  const double h = end - begin, mean = (y.v - x.v) / h;
  if (!jerk) return {x.s, x.v, mean, 0, 0};
  const double da = (y.a - x.a) / h, dv = (mean - x.a) / h;  // j + q h/2, j/2 + q h/6
  x.snap = 6 * (da - 2 * dv) / h;
  x.j = da - 0.5 * h * x.snap;
  return x;
}

}  // namespace

std::optional<LoneMove> lone_move(const AxisPath& path, const CoarseFineMachine& machine, double feed) {
  if (path.size() != 1 || !path.linear(0)) return std::nullopt;
  const double length = path.length();
  const AxisJet jet = path.at(0, 0);
  Limits coarse = stage(jet, machine, &CoarseFineAxis::coarse), fine = stage(jet, machine, &CoarseFineAxis::fine);
  if (!(coarse.acceleration < unlimited)) return std::nullopt;
  double half = unlimited;
  for (std::size_t k = 0; k < machine.axes.size(); ++k)
    if (const double rate = std::abs(jet.d1[k]); rate > 0) {
      const double rounded = places * (std::abs(jet.value[k]) + rate * length);
      half = std::min(half, std::max(0.0, share * machine.axes[k].stroke - rounded) / rate);
    }
  const Stages s = Search(length, half, coarse, fine, share * feed).best();
  const bool jerk = coarse.jerk < unlimited;
  const Stage head = s.head();
  LoneMove move;
  const std::vector<double> times = s.borders();
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    const double t = times[i], end = times[i + 1], h = end - t;
    const bool last = i + 2 == times.size();
    // Where the fine axes give back what the coarse ones gain, the head keeps its speed to the last place: its
    // polynomial is that of both together, not the sum of two that are rounded by themselves.
    const ProfileState c = between(s.coarse, t, end, last, jerk), x = between(head, t, end, last, jerk);
    move.head.append({0, h, x.s, last ? length : head.at(end).s, x.v, x.a, x.j, 0, x.snap});
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
