#include "core/motion/feed/feed_change.hpp"

#include <algorithm>
#include <array>

#include "core/base/errors.hpp"

namespace bahnwerk {
namespace {

constexpr double margin = 1 - 1e-3;  // used part of accelerations and jerks, since limits are evaluated at nodes only
constexpr double aim = 1 - 3e-3;     // margin, so that the next trial is not rejected at the same place
constexpr double least_share = 0.02, when_too_fast = 0.75;
constexpr double time_exact = 1e-9;  // resolution of times, as a part of a piece
constexpr int tries = 24;

/// Derivatives between two nodes of a segment: cubics through values and slopes, of q‴ a line.
class Between {
 public:
  FeedNode at(const FeedNode& a, const FeedNode& b, double s, std::size_t axes) {
    const double h = b.s - a.s, u = h > 0 ? std::clamp((s - a.s) / h, 0.0, 1.0) : 0;
    const double h00 = (1 + 2 * u) * (1 - u) * (1 - u), h10 = u * (1 - u) * (1 - u) * h, h01 = u * u * (3 - 2 * u),
                 h11 = u * u * (u - 1) * h;
    for (std::size_t k = 0; k < axes; ++k) {
      d1_[k] = h00 * a.d1[k] + h10 * a.d2[k] + h01 * b.d1[k] + h11 * b.d2[k];
      d2_[k] = h00 * a.d2[k] + h10 * a.d3[k] + h01 * b.d2[k] + h11 * b.d3[k];
      d3_[k] = (1 - u) * a.d3[k] + u * b.d3[k];
    }
    return {s, d1_.data(), d2_.data(), d3_.data()};
  }

 private:
  AxisArray d1_{}, d2_{}, d3_{};
};

FeedState state(const LawPiece& p, double tau, bool forwards) {
  const LawState x = p.at(tau);
  return {x.v, forwards ? x.a : -x.a, x.j};
}

/// Goes through the grid from a place, forwards or backwards, one node after the other.
class Walk {
 public:
  Walk(const FeedGrid& grid, double s, bool forwards) : grid_(grid), from_(s), forwards_(forwards) {
    std::size_t low = 0, high = grid.size();  // the first node behind s, or the first that is not before it
    while (low < high) {
      const std::size_t middle = low + (high - low) / 2;
      (forwards ? grid.s(middle) <= s : grid.s(middle) < s) ? low = middle + 1 : high = middle;
    }
    next_ = forwards ? low : low - 1;  // low − 1 wraps to none where nothing lies before
    segment_ = grid.segment_of(next_ < grid.size() ? 0.5 * (grid.s(next_) + s) : s, 0);
  }
  bool more() const { return next_ < grid_.size(); }
  double distance() const { return forwards_ ? grid_.s(next_) - from_ : from_ - grid_.s(next_); }
  std::size_t next() const { return next_; }
  std::size_t segment() const { return segment_; }
  /// Moves past the next node; returns whether that crosses a joint, behind which another node lies at the same place.
  bool pass() {
    const bool joint = forwards_ ? next_ + 1 == grid_.last(segment_) : next_ == grid_.first(segment_);
    forwards_ ? ++next_ : --next_;
    if (!joint || !more()) return false;
    forwards_ ? ++segment_ : --segment_;
    return true;
  }
  /// The nodes on both sides of where it is, in order along the path.
  std::pair<std::size_t, std::size_t> around() const {
    std::size_t other = forwards_ ? next_ - 1 : next_ + 1;
    if (!more()) return forwards_ ? std::pair{grid_.size() - 1, grid_.size() - 1} : std::pair{0ul, 0ul};
    other = std::clamp(other, grid_.first(segment_), grid_.last(segment_) - 1);
    return {std::min(other, next_), std::max(other, next_)};
  }

 private:
  const FeedGrid& grid_;
  double from_;
  bool forwards_;
  std::size_t next_, segment_;
};

}  // namespace

double time_at(const LawPiece& piece, double s, double from, double to, double exact) {
  double t = from + (to - from) / 2;
  for (int i = 0; i < 100 && to - from > 0; ++i) {
    const LawState x = piece.at(t);
    (x.s > s ? to : from) = t;
    double next = t - (x.s - s) / x.v;
    if (!(next > from && next < to)) next = from + (to - from) / 2;
    if (std::abs(next - t) <= exact) return next;
    t = next;
  }
  return t;
}

double FeedChanges::share(const FeedChange& change) const {
  const PathTask& task = grid_.task();
  const auto fits = [&](std::size_t segment, double v) {
    return v <= (1 + 1e-12) * std::min(task.feeds[segment], grid_.options().along.velocity);
  };
  Walk walk(grid_, change.s, change.forwards);
  Between between;
  double least = 1, x = 0;  // mm from change.s
  const auto here = [&](double distance) {
    const auto [a, b] = walk.around();
    return between.at(grid_.node(a), grid_.node(b), change.forwards ? change.s + distance : change.s - distance,
                      task.path.axes());
  };
  for (const RisePiece& part : change.rise.pieces()) {
    const LawPiece piece = law_piece(part, change.low);
    const double end = x + piece.at(piece.duration).s;
    least = std::min(least, grid_.share(here(x), state(piece, 0, change.forwards), margin));
    double tau = 0;
    while (walk.more() && walk.distance() <= end) {
      tau = time_at(piece, walk.distance() - x, tau, piece.duration, time_exact * piece.duration);
      const FeedState at = state(piece, tau, change.forwards);
      if (!fits(walk.segment(), at.v)) return 0;
      least = std::min(least, grid_.share(grid_.node(walk.next()), at, margin));
      if (walk.pass() && !grid_.passes_joint(change.forwards ? walk.segment() : walk.segment() + 1, at)) return 0;
      if (!(least > 0)) return 0;
    }
    x = end;
    const FeedState at = state(piece, piece.duration, change.forwards);
    if (!fits(walk.segment(), at.v)) return 0;
    least = std::min(least, grid_.share(here(x), at, margin));
  }
  return least;
}

std::optional<FeedChange> FeedChanges::find(double s, double low, double high, bool forwards, double room) const {
  FeedChange change;
  change.low = low, change.s = s, change.forwards = forwards;
  if (!(high > low)) return change;
  // First the acceleration and jerk that the axes allow at rest where the change begins, then their minimum over its
  // length.
  double a = 0, j = 0;
  for (int pass = 0; pass < 2; ++pass) {
    const double reach = pass == 0 ? 0 : profile_.rise(high - low, a, j).distance(low);
    for (Walk walk(grid_, s, forwards); walk.more(); walk.pass()) {
      a = std::max(a, grid_.acceleration(walk.next())), j = std::max(j, grid_.jerk(walk.next()));
      if (walk.distance() >= reach) break;
    }
    if (!(std::min(a, profile_.order == 3 ? j : unlimited) < unlimited))
      throw InvalidInput(std::vector<InputFault>{{{"feed"}, "acceleration or jerk has to be limited"}});
  }
  double lambda = 1;
  for (int i = 0; i < tries && lambda >= least_share; ++i) {
    change.rise = profile_.rise(high - low, lambda * a, lambda * lambda * j);
    if (!(change.distance() <= room)) return {};
    const double part = share(change);
    if (part >= 1) return change;
    lambda *= part > 0 ? aim * part : when_too_fast;
  }
  return {};
}

}  // namespace bahnwerk
