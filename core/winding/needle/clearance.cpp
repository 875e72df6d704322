#include "core/winding/needle/clearance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/base/errors.hpp"
#include "core/winding/needle/clearance_search.hpp"

namespace bahnwerk::winding {
namespace {

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

std::vector<NeedleMove> straight_links(const std::vector<FixedPiece>& pieces) {
  std::vector<NeedleMove> moves;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (i > 0) moves.push_back({pieces[i - 1].end.pose, pieces[i].begin.pose});
    moves.push_back(
        {pieces[i].begin.pose, pieces[i].end.pose, pieces[i].shape == FixedPiece::Shape::arc, pieces[i].sweep});
  }
  return moves;
}

Clearance clearance(const std::vector<NeedleMove>& moves, const NeedleShape& needle,
                    const std::vector<const Obstacle*>& obstacles, double tolerance, Progress& progress) {
  check(needle, tolerance);
  return ClearanceSearch<MoveInterval>(needle, obstacles, tolerance, progress).over(moves.size(), [&](std::size_t n) {
    return MoveInterval(moves[n]);
  });
}

Clearance clearance(std::span<const BezierPiece> pieces, const NeedleShape& needle,
                    const std::vector<const Obstacle*>& obstacles, double tolerance, Progress& progress) {
  check(needle, tolerance);
  return ClearanceSearch<PieceInterval>(needle, obstacles, tolerance, progress).over(pieces.size(), [&](std::size_t n) {
    return PieceInterval(pieces[n]);
  });
}

std::vector<Clearance> clearance_in_intervals(const BezierPiece& piece, int halvings, double enough,
                                              const NeedleShape& needle, const std::vector<const Obstacle*>& obstacles,
                                              double tolerance, Progress& progress) {
  check(needle, tolerance);
  std::vector<PieceInterval> intervals{PieceInterval(piece)};
  for (int i = 0; i < halvings; ++i) {
    std::vector<PieceInterval> halves;
    for (const PieceInterval& each : intervals) halves.insert(halves.end(), {each.half(false), each.half(true)});
    intervals = std::move(halves);
  }
  std::vector<Clearance> list;
  for (const PieceInterval& each : intervals) {
    ClearanceSearch<PieceInterval> search(needle, obstacles, tolerance, progress, enough);
    list.push_back(search.over(1, [&](std::size_t) { return each; }));
    list.back().move = list.size() - 1;
  }
  return list;
}

double clearance_up_to(double enough, std::span<const BezierPiece> pieces, const NeedleShape& needle,
                       const std::vector<const Obstacle*>& obstacles, double tolerance, Progress& progress) {
  check(needle, tolerance);
  ClearanceSearch<PieceInterval> search(needle, obstacles, tolerance, progress, enough);
  return search.over(pieces.size(), [&](std::size_t n) { return PieceInterval(pieces[n]); }).minimum;
}

}  // namespace bahnwerk::winding
