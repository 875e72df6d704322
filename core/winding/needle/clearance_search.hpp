#pragma once
/// The search for the least clearance over a path, the needle and all obstacles, for any description of the path that
/// can be halved.
///
/// Within an interval of the path the needle is compared with its pose in the interval's middle. Its displacement along
/// its own axis is treated as a longer needle, so that a needle that dives into a slot costs no more than one that
/// stands; only the displacement of its points perpendicular to that lowers the bound. The longer needle is halved
/// until every part of it is decided. Where the perpendicular displacement is too large the interval is halved, for the
/// parts of the needle that need it.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

#include "core/base/progress.hpp"
#include "core/numeric/golden_section.hpp"
#include "core/winding/needle/clearance.hpp"
#include "core/winding/part/vec3.hpp"

namespace bahnwerk::winding {

/// Bounds of the displacement of the needle's tip, anywhere on an interval, from its place in the interval's middle,
/// mm.
struct Reach {
  double whole = 0;   ///< total displacement
  double along = 0;   ///< component along the needle's axis in the middle
  double beside = 0;  ///< the remaining component, normal to the axis
  double across = 0;  ///< part of `beside` in sections normal to the part's axis
  double height = 0;  ///< part of `beside` along the part's axis
  double turn = 0;    ///< change of the needle's direction: length of the difference of unit vectors
};

/// `PathInterval` is an interval of the path: it has middle(), the pose there; at(), its place on the piece;
/// reach(direction in the middle); lowest(n), the least of n · (tip − tip in the middle); half(bool second).
template <class PathInterval>
class ClearanceSearch {
 public:
  /// Clearances above `enough` are not distinguished from it.
  ClearanceSearch(const NeedleShape& needle, const std::vector<const Obstacle*>& obstacles, double tolerance,
                  Progress& progress, double enough = std::numeric_limits<double>::infinity())
      : radius_(needle.width / 2),
        length_(needle.length),
        tolerance_(tolerance),
        obstacles_(obstacles),
        progress_(progress) {
    best_.minimum = enough;
  }

  /// `whole(n)` returns piece n as an interval.
  template <class Whole>
  Clearance over(std::size_t count, const Whole& whole) {
    // A coarse evaluation of everything comes first: parts that are farther away than its nearest need few halvings.
    // The nearest pieces are searched first.
    std::vector<double> nearest(count);
    for (piece_ = 0; piece_ < count; ++piece_) nearest[piece_] = coarse(whole(piece_));
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return nearest[a] < nearest[b]; });
    for (std::size_t n = 0; n < count; ++n) {
      done_ = static_cast<double>(n) / static_cast<double>(count);
      piece_ = order[n];
      // The bar's axis begins in the middle of its round end.
      open_.clear();
      for (std::size_t k = 0; k < obstacles_.size(); ++k) open_.push_back({k, radius_, length_});
      descend(whole(piece_), 0, open_.size());
    }
    return best_;
  }

 private:
  static constexpr double round_off = 1e-9;    // mm
  static constexpr double along_exact = 1e-7;  // mm
  /// A part of the needle's axis, with one obstacle.
  struct Part {
    std::size_t obstacle;
    double first, last;
  };

  void ask() {
    if (count_++ % 1024 == 0) progress_.report("clearance", done_);
  }
  void seen(std::size_t k, double found, double u, double s) {
    if (found < best_.minimum) best_ = {found, piece_, u, s, k};
  }
  double look(std::size_t k, Vec3 at, double u, double s) {
    const double found = obstacles_[k]->distance(at) - radius_;
    seen(k, found, u, s);
    return found;
  }
  double coarse(const PathInterval& whole) {
    double least = std::numeric_limits<double>::infinity();
    const PathInterval halves[] = {whole.half(false), whole.half(true)};
    for (const PathInterval* interval : {&halves[0], &whole, &halves[1]}) {
      ask();
      const NeedlePose pose = interval->middle();
      const Vec3 d = pose.direction();
      for (int j = 0; j <= 8; ++j) {
        const double s = radius_ + j / 8.0 * (length_ - radius_);
        for (std::size_t k = 0; k < obstacles_.size(); ++k)
          least = std::min(least, look(k, pose.tip - s * d, interval->at(), s));
      }
    }
    return least;
  }

  /// Decides the parts open_[begin] to open_[end] of the needle over an interval.
  void descend(const PathInterval& interval, std::size_t begin, std::size_t end) {
    pose_ = interval.middle(), direction_ = pose_.direction(), at_ = interval.at(), reach_ = interval.reach(direction_);
    for (std::size_t i = begin; i < end; ++i) {
      const Part part = open_[i];
      if (obstacles_[part.obstacle]->convex()) {
        if (!decided(interval, part.obstacle)) open_.push_back(part);
        continue;
      }
      low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
      halved(part.obstacle, (part.first + part.last) / 2, (part.last - part.first) / 2 + reach_.along);
      if (low_ > high_) continue;
      const Part rest{part.obstacle, std::max(part.first, low_ - reach_.along),
                      std::min(part.last, high_ + reach_.along)};
      if (rest.first <= rest.last) open_.push_back(rest);
    }
    const std::size_t left = open_.size();
    if (left == end) return;
    descend(interval.half(false), end, left);
    descend(interval.half(true), end, left);
    open_.resize(end);
  }

  /// For a convex obstacle the nearest point of the needle is found exactly, and the obstacle lies behind the plane
  /// there.
  bool decided(const PathInterval& interval, std::size_t k) {
    ask();
    const Obstacle& obstacle = *obstacles_[k];
    const double enough = best_.minimum - tolerance_ + round_off + along_exact, turned = length_ * reach_.turn;
    const double middle = (radius_ + length_) / 2, half = (length_ - radius_) / 2;
    if (look(k, pose_.tip - middle * direction_, at_, middle) - half - reach_.whole - turned >= enough) return true;
    const double s = nearest_along(obstacle);
    const Vec3 at = pose_.tip - s * direction_;
    const double found = look(k, at, at_, s);
    if (found - reach_.whole - turned >= enough) return true;
    const Vec3 n = obstacle.away(at);
    const double slope = -dot(n, direction_), ahead = std::min(slope * (radius_ - s), slope * (length_ - s));
    return found + ahead + interval.lowest(n) - turned >= enough;
  }
  /// Returns the place on the needle that is nearest to the obstacle, by a golden section search, which also works for
  /// a needle that lies flat against a face.
  double nearest_along(const Obstacle& obstacle) const {
    const auto near = [&](double s) { return -obstacle.distance(pose_.tip - s * direction_); };
    return golden_section(near, radius_, length_, along_exact).at;
  }

  /// Halves the part from s − half to s + half of the longer needle; undecided parts widen low_ to high_.
  void halved(std::size_t k, double s, double half) {
    ask();
    const Obstacle& obstacle = *obstacles_[k];
    const Vec3 p = pose_.tip - s * direction_;
    const Distances at = obstacle.distances(p);
    const double found = at.whole - radius_;
    if (s >= radius_ && s <= length_) seen(k, found, at_, s);
    // Points of the needle that come here are up to reach_.along farther from the tip, and rotate about it.
    const double enough = best_.minimum - tolerance_ + round_off,
                 turn = std::clamp(s + half + reach_.along, 0.0, length_) * reach_.turn;
    double moved = reach_.beside + turn, most = found - moved;
    if (most - half >= enough) return;
    // For a decision in a section, or by the height alone, only displacement in that direction counts. If it would
    // decide for a shorter interval, the needed length is computed.
    const auto decides = [&](double distance, double by, double share) {
      const double least = distance - by - turn;
      if (least - share * half >= enough) return true;
      most = std::max(most, least);
      if (distance >= enough + tolerance_ / 2) moved = std::min(moved, by + turn);
      return false;
    };
    if (decides(at.height - radius_, reach_.height, std::abs(direction_.z))) return;
    if (reach_.across < reach_.beside || direction_.z != 0)
      if (decides(at.section - radius_, reach_.across, std::hypot(direction_.x, direction_.y))) return;
    if (moved >= half || most < enough || half <= tolerance_ / 8) {
      low_ = std::min(low_, s - half), high_ = std::max(high_, s + half);
      return;
    }
    halved(k, s + half / 2, half / 2);
    halved(k, s - half / 2, half / 2);
  }

  double radius_, length_, tolerance_;
  const std::vector<const Obstacle*>& obstacles_;
  Progress& progress_;
  Clearance best_;
  std::vector<Part> open_;
  std::size_t piece_ = 0, count_ = 0;
  double done_ = 0;
  // Pose of the current interval.
  NeedlePose pose_;
  Vec3 direction_;
  double at_ = 0, low_ = 0, high_ = 0;
  Reach reach_;
};

}  // namespace bahnwerk::winding
