#include "core/winding/path/needle_path.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>

#include "core/base/errors.hpp"
#include "core/geometry/spline/spline_arc.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double shortest = 1e-6;  // mm, of a piece or of a link's chord

SplinePoint point(const NeedlePose& pose) { return {pose.tip.x, pose.tip.y, pose.tip.z, pose.phi, pose.psi}; }

bool is_slot(const FixedPiece& piece) { return piece.kind == FixedPiece::Kind::region && piece.region % 2 == 0; }

std::string where(const FixedPiece& piece) {
  static constexpr const char* names[] = {"the first slot", "the lower winding head", "the second slot",
                                          "the upper winding head"};
  const std::string turn = "turn " + std::to_string(piece.turn + 1) + " of coil " + std::to_string(piece.coil + 1);
  return piece.kind == FixedPiece::Kind::coil_change ? "the way to the next coil after " + turn
                                                     : std::string(names[piece.region]) + " of " + turn;
}

std::vector<BezierPiece> curve(const FixedPiece& piece, std::size_t continuity) {
  const SplinePoint from = point(piece.begin.pose), to = point(piece.end.pose);
  if (piece.shape == FixedPiece::Shape::line) {
    if (!(norm(place(to) - place(from)) > shortest)) throw Infeasible(where(piece) + " has no length");
    return {BezierPiece::line(from, to)};
  }
  if (!(std::hypot(from[0], from[1]) * std::abs(piece.sweep) > shortest))
    throw Infeasible(where(piece) + " has no length");
  return spline_arc(from, {0, 0, from[2]}, {0, 0, 1}, piece.sweep,
                    {0, 0, to[2] - from[2], piece.sweep, to[4] - from[4]}, continuity);
}

/// The pose in which a stator's needle has finished its swivel on its way out of a slot, or begins it on its way in
/// [Herrmann 4.3.4]: radially outwards of the slot's, at the height of the other piece. The tangent has the length of
/// the whole way by that pose, so that the needle passes it at the speed of a link that goes evenly.
LinkVia extra_pose(const NeedlePose& slot, const NeedlePose& outside, double share, double& at) {
  const Space a = slot.tip, b = outside.tip;
  const double azimuth = std::atan2(a.y, a.x), phi = slot.phi + std::remainder(azimuth - slot.phi, 2 * pi);
  const double radius = std::hypot(a.x, a.y) + share * std::hypot(b.x - a.x, b.y - a.y);
  LinkVia via;
  via.point = {radius * std::cos(azimuth), radius * std::sin(azimuth), b.z, phi, outside.psi};
  const double to_slot = norm(place(via.point) - Vec{a.x, a.y, a.z}),
               to_outside = norm(Vec{b.x, b.y, b.z} - place(via.point)), way = to_slot + to_outside;
  via.tangent = {way * std::cos(azimuth), way * std::sin(azimuth), 0, 0, 0};
  at = to_slot / way;
  return via;
}

/// Bases and their quadrature rules, one for each parameter of the extra point: they depend on nothing else.
class Bases {
 public:
  explicit Bases(std::size_t continuity) : continuity_(continuity) {}
  struct Entry {
    LinkBasis basis;
    SmoothnessRule rule;
  };
  const Entry& at(double via) {
    const auto found = entries_.find(via);
    if (found != entries_.end()) return found->second;
    const LinkBasis basis(continuity_, via);
    return entries_.emplace(via, Entry{basis, SmoothnessRule(basis)}).first->second;
  }

 private:
  std::size_t continuity_;
  std::map<double, Entry> entries_;
};

double turned_angle(const std::vector<BezierPiece>& pieces) {
  double sum = 0;  // ∫ κ ds = ∫ |s′ × s″| / |s′|² dv, by the midpoint rule
  constexpr int steps = 128;
  for (const BezierPiece& piece : pieces)
    for (int i = 0; i < steps; ++i) {
      const SplineJet jet = piece.at((i + 0.5) / steps);
      const Vec d1 = place(jet[1]), d2 = place(jet[2]);
      sum += norm(cross(d1, d2)) / dot(d1, d1) / steps;
    }
  return sum;
}

class Maker {
 public:
  Maker(const std::vector<FixedPiece>& fixed, bool stator, const LinkOptions& options)
      : fixed_(fixed), stator_(stator), options_(options), bases_(options.continuity) {}

  NeedlePath run(Progress& progress) {
    std::vector<BezierPiece> here = curve(fixed_.front(), options_.continuity);
    for (std::size_t i = 0;; ++i) {
      for (BezierPiece& piece : here) path_.pieces.push_back({piece, i, false, 0});
      if (i + 1 == fixed_.size()) return std::move(path_);
      std::vector<BezierPiece> next = curve(fixed_[i + 1], options_.continuity);
      join(i, here.back(), next.front(), progress);
      here = std::move(next);
    }
  }

 private:
  void join(std::size_t i, const BezierPiece& before, const BezierPiece& after, Progress& progress) {
    const FixedPiece &from = fixed_[i], &to = fixed_[i + 1];
    LinkEnds ends{before.at(1), after.at(0), std::nullopt};
    if (!(norm(place(ends.after[0]) - place(ends.before[0])) > shortest))
      throw Infeasible("no room for a link between " + where(from) + " and " + where(to));
    double via = 0;
    if (stator_ && options_.extra_point > 0 && is_slot(from) != is_slot(to)) {
      if (is_slot(from)) {
        ends.via = extra_pose(from.end.pose, to.begin.pose, options_.extra_point, via);
      } else {
        ends.via = extra_pose(to.begin.pose, from.end.pose, options_.extra_point, via);
        for (double& component : ends.via->tangent) component = -component;
        via = 1 - via;
      }
      via = std::round(std::clamp(via, 0.1, 0.9) * 32) / 32;  // few bases serve all links
    }
    const Bases::Entry& entry = bases_.at(via);
    // The link at the same place of the turn before is nearly the same.
    std::optional<LinkShape>& known = known_[{from.kind, from.region, to.kind, via}];
    const BestLink best =
        best_link(entry.basis, entry.rule, ends, options_.objective, options_.weights, known, progress);
    known = best.shape;
    const std::vector<BezierPiece> pieces = link(entry.basis, ends, best.shape).pieces();
    for (std::size_t k = 0; k < pieces.size(); ++k)
      path_.pieces.push_back({pieces[k], i, true, via > 0 ? (k == 0 ? via : 1 - via) : 1});
    path_.links.push_back({i, best, turned_angle(pieces)});
  }

  const std::vector<FixedPiece>& fixed_;
  bool stator_;
  const LinkOptions& options_;
  Bases bases_;
  struct Place {
    FixedPiece::Kind from_kind;
    std::size_t region;
    FixedPiece::Kind to_kind;
    double via;
    auto operator<=>(const Place&) const = default;
  };
  std::map<Place, std::optional<LinkShape>> known_;
  NeedlePath path_;
};

}  // namespace

NurbsPath NeedlePath::united() const {
  std::vector<BezierPiece> all;
  all.reserve(pieces.size());
  for (const NeedlePiece& piece : pieces) all.push_back(piece.curve);
  return bahnwerk::united(all);
}

NeedlePath needle_path(const std::vector<FixedPiece>& pieces, bool stator, const LinkOptions& options,
                       Progress& progress) {
  std::vector<InputFault> faults;
  if (options.continuity < 1 || options.continuity > 4)
    faults.push_back({{"path", "continuity"}, "is not a whole number from 1 to 4"});
  if (!(options.extra_point >= 0 && options.extra_point <= 1))
    faults.push_back({{"path", "extra_point"}, "is not a number from 0 to 1"});
  if (!faults.empty()) throw InvalidInput(std::move(faults));
  if (pieces.empty()) return {};
  return Maker(pieces, stator, options).run(progress);
}

}  // namespace bahnwerk::winding
