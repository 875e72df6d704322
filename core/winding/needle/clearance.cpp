#include "core/winding/needle/clearance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/numeric/golden_section.hpp"
#include "core/winding/part/vec3.hpp"

namespace bahnwerk::winding {
namespace {

// The search for the least clearance over a path, the needle and all obstacles, for any description of the path that
// can be halved.
//
// Within an interval of the path the needle is compared with its pose in the interval's middle. Its displacement along
// its own axis is treated as a longer needle, so that a needle that dives into a slot costs no more than one that
// stands; only the displacement of its points perpendicular to that lowers the bound. The longer needle is halved
// until every part of it is decided. Where the perpendicular displacement is too large the interval is halved, for the
// parts of the needle that need it.

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
                  Progress progress, double enough = std::numeric_limits<double>::infinity())
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
  Progress progress_;
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

/// Returns a bound of the change of the needle's direction from that at `psi` where the angles change by this much:
/// |d'|² = φ'² cos² ψ + ψ'². A needle along the part's axis does not change with φ.
double turned_by(double phi, double psi_change, double psi) {
  return std::hypot(phi * std::min(1.0, std::abs(std::cos(psi)) + std::abs(psi_change)), psi_change);
}

/// An interval of a move.
class MoveInterval {
 public:
  explicit MoveInterval(const NeedleMove& move, double u = 0.5, double half = 0.5) : move_(&move), u_(u), half_(half) {}
  double at() const { return u_; }
  NeedlePose middle() const { return move_->at(u_); }
  MoveInterval half(bool second) const { return MoveInterval(*move_, u_ + (second ? half_ : -half_) / 2, half_ / 2); }
  Reach reach(Vec3 d) const {
    const NeedleMove& m = *move_;
    const double turn = turned_by(half_ * (m.to.phi - m.from.phi), half_ * (m.to.psi - m.from.psi), middle().psi);
    if (m.arc) {
      const double along = round() * std::hypot(d.x, d.y);
      return {round(), along, round(), round(), along * std::abs(d.z), turn};
    }
    const Vec3 way = half_ * (m.to.tip - m.from.tip);
    const double along = dot(way, d);
    const Vec3 beside = way - along * d;
    return {norm(way), std::abs(along), norm(beside), std::hypot(beside.x, beside.y), std::abs(beside.z), turn};
  }
  double lowest(Vec3 n) const {
    if (move_->arc) {
      const Vec3 p = move_->at(u_).tip;
      const double angle = half_ * std::abs(move_->sweep);
      return -angle * (std::abs(n.y * p.x - n.x * p.y) + angle / 2 * std::abs(n.x * p.x + n.y * p.y));
    }
    return -half_ * std::abs(dot(n, move_->to.tip - move_->from.tip));
  }

 private:
  double round() const { return half_ * std::abs(move_->sweep) * std::hypot(move_->from.tip.x, move_->from.tip.y); }
  const NeedleMove* move_;
  double u_, half_;
};

/// An interval of a rational piece: its own control points, and those of both halves.
class PieceInterval {
 public:
  explicit PieceInterval(const BezierPiece& piece) : degree_(piece.degree()) {
    std::copy(piece.points().begin(), piece.points().end(), points_.begin());
    divide();
  }
  double at() const { return u_; }
  NeedlePose middle() const { return {{middle_[0], middle_[1], middle_[2]}, middle_[3], middle_[4]}; }
  PieceInterval half(bool second) const {
    PieceInterval h(*this);
    h.points_ = second ? right_ : left_;
    h.half_ = half_ / 2;
    h.u_ = u_ + (second ? h.half_ : -h.half_);
    h.divide();
    return h;
  }
  /// The curve lies in the convex hull of the control points, its halves in those of theirs: no point of it is farther
  /// from the middle than the farthest of them.
  Reach reach(Vec3 d) const {
    Reach r;
    double whole = 0, beside = 0, across = 0, phi_change = 0, psi_change = 0;
    each([&](Vec3 off, double phi, double psi) {
      const double along = dot(off, d);
      const Vec3 rest = off - along * d;
      r.along = std::max(r.along, std::abs(along));
      r.height = std::max(r.height, std::abs(rest.z));
      whole = std::max(whole, dot(off, off));
      across = std::max(across, rest.x * rest.x + rest.y * rest.y);
      beside = std::max(beside, dot(rest, rest));
      phi_change = std::max(phi_change, std::abs(phi));
      psi_change = std::max(psi_change, std::abs(psi));
    });
    r.whole = std::sqrt(whole), r.beside = std::sqrt(beside), r.across = std::sqrt(across);
    r.turn = turned_by(phi_change, psi_change, middle_[4]);
    return r;
  }
  double lowest(Vec3 n) const {
    double least = 0;
    each([&](Vec3 off, double, double) { least = std::min(least, dot(n, off)); });
    return least;
  }

 private:
  using Points = std::array<HomogeneousPoint, BezierPiece::max_degree + 1>;
  /// Calls `call` with the distance of each control point of both halves from the middle.
  template <class Each>
  void each(const Each& call) const {
    for (const Points* half : {&left_, &right_})
      for (std::size_t i = 0; i <= degree_; ++i) {
        const HomogeneousPoint& p = (*half)[i];
        const double k = 1 / p[spline_dimension];
        const auto off = [&](std::size_t d) { return k * p[d] - middle_[d]; };
        call(Vec3{off(0), off(1), off(2)}, off(3), off(4));
      }
  }
  /// Divides by de Casteljau's algorithm at the middle.
  void divide() {
    Points b = points_;
    for (std::size_t l = 0; l <= degree_; ++l) {
      left_[l] = b[0];
      right_[degree_ - l] = b[degree_ - l];
      for (std::size_t j = 0; j + l < degree_; ++j)
        for (std::size_t d = 0; d < b[j].size(); ++d) b[j][d] = 0.5 * (b[j][d] + b[j + 1][d]);
    }
    middle_ = projected(right_[0]);
  }

  std::size_t degree_;
  Points points_{}, left_{}, right_{};
  SplinePoint middle_{};
  double u_ = 0.5, half_ = 0.5;
};

void check(const NeedleShape& needle, double tolerance) {
  std::vector<InputFault> faults;
  if (!(needle.width > 0) || !std::isfinite(needle.width))
    faults.push_back({{"needle", "width"}, "is not a number above 0"});
  if (!(needle.length >= needle.width) || !std::isfinite(needle.length))
    faults.push_back({{"needle", "length"}, "is less than the needle's width"});
  if (!faults.empty()) throw InvalidInput(faults);
  if (!(tolerance >= 1e-6)) throw std::invalid_argument("a tolerance of at least 1e-6 mm is needed");
}

}  // namespace

NeedlePose NeedleMove::at(double u) const {
  NeedlePose pose;
  pose.tip = arc ? turned(from.tip, u * sweep) : (1 - u) * from.tip + u * to.tip;
  pose.phi = from.phi + u * (to.phi - from.phi);
  pose.psi = from.psi + u * (to.psi - from.psi);
  return pose;
}

Clearance clearance(const std::vector<NeedleMove>& moves, const NeedleShape& needle,
                    const std::vector<const Obstacle*>& obstacles, double tolerance, Progress progress) {
  check(needle, tolerance);
  return ClearanceSearch<MoveInterval>(needle, obstacles, tolerance, progress).over(moves.size(), [&](std::size_t n) {
    return MoveInterval(moves[n]);
  });
}

Clearance clearance(std::span<const BezierPiece> pieces, const NeedleShape& needle,
                    const std::vector<const Obstacle*>& obstacles, double tolerance, Progress progress) {
  check(needle, tolerance);
  return ClearanceSearch<PieceInterval>(needle, obstacles, tolerance, progress).over(pieces.size(), [&](std::size_t n) {
    return PieceInterval(pieces[n]);
  });
}

std::vector<Clearance> clearance_in_intervals(const BezierPiece& piece, int halvings, const NeedleShape& needle,
                                              const std::vector<const Obstacle*>& obstacles,
                                              const ClearanceResolution& resolution, Progress progress) {
  check(needle, resolution.tolerance);
  std::vector<PieceInterval> intervals{PieceInterval(piece)};
  for (int i = 0; i < halvings; ++i) {
    std::vector<PieceInterval> halves;
    for (const PieceInterval& each : intervals) halves.insert(halves.end(), {each.half(false), each.half(true)});
    intervals = std::move(halves);
  }
  std::vector<Clearance> list;
  for (const PieceInterval& each : intervals) {
    ClearanceSearch<PieceInterval> search(needle, obstacles, resolution.tolerance, progress, resolution.enough);
    list.push_back(search.over(1, [&](std::size_t) { return each; }));
    list.back().move = list.size() - 1;
  }
  return list;
}

double clearance_up_to(std::span<const BezierPiece> pieces, const NeedleShape& needle,
                       const std::vector<const Obstacle*>& obstacles, const ClearanceResolution& resolution,
                       Progress progress) {
  check(needle, resolution.tolerance);
  ClearanceSearch<PieceInterval> search(needle, obstacles, resolution.tolerance, progress, resolution.enough);
  return search.over(pieces.size(), [&](std::size_t n) { return PieceInterval(pieces[n]); }).minimum;
}

}  // namespace bahnwerk::winding
