#include "core/winding/path/needle_path.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "core/base/errors.hpp"
#include "core/geometry/spline/spline_arc.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double shortest = 1e-6;  // mm, of a piece or of a link's chord
// Of J. From the shape of the turn before nothing is gained by more.
constexpr std::size_t evaluations_from_a_neighbour = 250, evaluations_of_a_search = 250, evaluations_of_the_best = 1000;
constexpr double sharpest = 100;    // κ, 1/mm, of a bend that is no cusp
constexpr double far_rougher = 10;  // in J
constexpr double loop = 1.5;        // rad: by what a loop turns more than a bend, at least
constexpr double unusable = 1e12;   // J of a link that stands still somewhere

SplinePoint point(const NeedlePose& pose) { return {pose.tip.x, pose.tip.y, pose.tip.z, pose.phi, pose.psi}; }

bool is_slot(const FixedPiece& piece) { return piece.kind == FixedPiece::Kind::region && piece.region % 2 == 0; }

std::string where(const FixedPiece& piece) {
  const std::string turn = "turn " + std::to_string(piece.turn + 1) + " of coil " + std::to_string(piece.coil + 1);
  return piece.kind == FixedPiece::Kind::coil_change ? "the way to the next coil after " + turn
                                                     : std::string(region_in_words(piece.region)) + " of " + turn;
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
/// [Herrmann 4.3.4]: radially outwards of the slot's, at the height of the other piece. The needle passes it on a
/// radius, without curvature and without turning.
SplineJet extra_pose(const NeedlePose& slot, const NeedlePose& outside, double share, bool inwards) {
  const Space a = slot.tip, b = outside.tip;
  const double azimuth = std::atan2(a.y, a.x), phi = slot.phi + std::remainder(azimuth - slot.phi, 2 * pi);
  const double radius = std::hypot(a.x, a.y) + share * std::hypot(b.x - a.x, b.y - a.y), sense = inwards ? -1 : 1;
  SplineJet jet{};
  jet[0] = {radius * std::cos(azimuth), radius * std::sin(azimuth), b.z, phi, outside.psi};
  jet[1] = {sense * std::cos(azimuth), sense * std::sin(azimuth), 0, 0, 0};
  return jet;
}

/// ∫ κ ds = ∫ |s′ × s″| / |s′|² dv, by the midpoint rule.
double turned_angle(const BezierPiece& piece) {
  double sum = 0;
  constexpr int steps = 128;
  for (int i = 0; i < steps; ++i) {
    const SplineJet jet = piece.at((i + 0.5) / steps);
    const Vec d1 = place(jet[1]), d2 = place(jet[2]);
    sum += norm(cross(d1, d2)) / dot(d1, d1) / steps;
  }
  return sum;
}

/// The largest κ where the parametric speed has a minimum: what is too narrow for a quadrature is a needle that nearly
/// stands still.
double sharpest_bend(const BezierPiece& piece) {
  constexpr int samples = 256;
  const auto speed = [&](double v) { return norm(place(piece.at(v)[1])); };
  double most = 0, before = unusable, here = speed(0);
  for (int i = 0; i < samples; ++i) {
    const double next = speed((i + 1.0) / samples);
    if (here <= before && here <= next) {
      double low = std::max(0.0, (i - 1.0) / samples), high = (i + 1.0) / samples;
      for (int n = 0; n < 60; ++n) {  // ternary search
        const double a = low + (high - low) / 3, b = high - (high - low) / 3;
        (speed(a) < speed(b) ? high : low) = speed(a) < speed(b) ? b : a;
      }
      const SplineJet jet = piece.at((low + high) / 2);
      const Vec d1 = place(jet[1]), d2 = place(jet[2]);
      most = std::max(most, norm(cross(d1, d2)) / std::pow(norm(d1), 3));
    }
    before = here, here = next;
  }
  return most < unusable ? most : unusable;
}

class Maker {
 public:
  Maker(const std::vector<FixedPiece>& fixed, bool stator, const LinkOptions& options)
      : fixed_(fixed),
        stator_(stator),
        options_(options),
        basis_(options.continuity),
        rule_(basis_),
        fine_rule_(basis_, 256) {}

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
    const SplineJet begin = before.at(1), end = after.at(0);
    const bool out = is_slot(from);
    if (!(stator_ && options_.extra_point > 0 && out != is_slot(to))) return join(i, 0, begin, end, 1, progress);
    const SplineJet middle = extra_pose(out ? from.end.pose : to.begin.pose, out ? to.begin.pose : from.end.pose,
                                        options_.extra_point, !out);
    join(i, 0, begin, middle, out ? 1 : 0, progress);
    join(i, 1, middle, end, out ? 0 : 1, progress);
  }
  static double distance(const SplineJet& a, const SplineJet& b) { return norm(place(b[0]) - place(a[0])); }

  void join(std::size_t i, std::size_t part, const SplineJet& begin, const SplineJet& end, double share,
            Progress& progress) {
    const FixedPiece &from = fixed_[i], &to = fixed_[i + 1];
    if (!(distance(begin, end) > shortest))
      throw Infeasible("no room for a link between " + where(from) + " and " + where(to) +
                       (from.kind == to.kind ? "" : ": raise needle.change_radius or needle.change_height"));
    const LinkEnds ends{begin, end, std::nullopt};
    // The link at the same place of the turn before is nearly the same.
    std::optional<Known>& known = known_[{from.kind, from.region, to.kind, part}];
    LinkObjective objective = known ? known->objective : options_.objective;
    BestLink best = again(ends, known, objective, progress);
    // (4.61) takes no notice of how sharp a link bends: where it leads to a cusp, that place has the smoothest link.
    if (objective != LinkObjective::curvature && cusped(ends, best)) {
      objective = LinkObjective::curvature;
      best = search(ends, objective, progress);
    }
    if (cusped(ends, best))
      throw Infeasible("no link without a cusp found between " + where(from) + " and " + where(to));
    known = {best.shape, best.smoothness, objective};
    for (const BezierPiece& piece : link(basis_, ends, best.shape).pieces()) {
      path_.pieces.push_back({piece, i, true, share});
      path_.links.push_back({i, best, turned_angle(piece)});
    }
  }

  struct Known {
    LinkShape shape;
    double smoothness = 0;
    LinkObjective objective = LinkObjective::curvature;
  };
  /// From what is known of the turn before, as long as that leads to about as smooth a link.
  BestLink again(const LinkEnds& ends, const std::optional<Known>& known, LinkObjective objective,
                 Progress& progress) const {
    if (!known) return search(ends, objective, progress);
    const BestLink best = solve(ends, known->shape, objective, evaluations_from_a_neighbour, progress);
    return best.smoothness <= 1.5 * known->smoothness ? best : search(ends, objective, progress);
  }
  bool cusped(const LinkEnds& ends, const BestLink& best) const {
    return sharpest_bend(link(basis_, ends, best.shape).pieces().front()) > sharpest;
  }
  /// J, by a fine rule; and no less than the sharpest bend makes of it, however narrow.
  double judged(const LinkEnds& ends, const BestLink& best) const {
    const double j = smoothness(basis_, fine_rule_, ends, best.shape, options_.weights);
    const double bend = sharpest_bend(link(basis_, ends, best.shape).pieces().front());
    return j < unusable ? std::max(j, options_.weights.rate * bend) : unusable;
  }
  /// A bend so sharp that it falls between the nodes of the quadrature looks smooth: where a finer rule sees more, the
  /// search is made with that.
  BestLink solve(const LinkEnds& ends, const LinkShape& start, LinkObjective objective, std::size_t evaluations,
                 Progress& progress) const {
    const auto by = [&](const SmoothnessRule& rule) {
      BestLink best = best_link(basis_, rule, ends, objective, options_.weights, start, progress, evaluations);
      const double seen = best.smoothness;
      best.smoothness = judged(ends, best);
      return std::pair(best, seen);
    };
    const auto [best, seen] = by(rule_);
    return best.smoothness <= 1.05 * seen ? best : by(fine_rule_).first;
  }
  /// From several starts: links that leave their neighbours' tangents soon or late. (4.60) prefers a wide loop to a
  /// bend, on a way that is far longer: of links that turn by about as little as any, it is the smoothest that is
  /// taken.
  BestLink search(const LinkEnds& ends, LinkObjective objective, Progress& progress) const {
    std::vector<std::pair<double, BestLink>> found;
    double smoothest = unusable;
    const double chord = norm(place(ends.after[0]) - place(ends.before[0]));
    for (const double speed : {1.0, 0.5, 2.0, 4.0}) {
      LinkShape start;
      start.before[0] = norm(place(ends.before[1])) / (speed * chord);
      start.after[0] = norm(place(ends.after[1])) / (speed * chord);
      const BestLink best = solve(ends, start, objective, evaluations_of_a_search, progress);
      found.emplace_back(turned_angle(link(basis_, ends, best.shape).pieces().front()), best);
      smoothest = std::min(smoothest, best.smoothness);
    }
    double least = unusable;  // of those that are no cusps
    const auto usable = [&](const BestLink& each) { return each.smoothness <= far_rougher * smoothest; };
    for (const auto& [angle, each] : found)
      if (usable(each)) least = std::min(least, angle);
    const BestLink* best = nullptr;
    for (const auto& [angle, each] : found)
      if (angle <= least + loop && usable(each) && (best == nullptr || each.smoothness < best->smoothness))
        best = &each;
    return solve(ends, best->shape, objective, evaluations_of_the_best, progress);
  }

  const std::vector<FixedPiece>& fixed_;
  bool stator_;
  const LinkOptions& options_;
  LinkBasis basis_;
  SmoothnessRule rule_, fine_rule_;
  /// Kind and region that a link comes from, kind that it leads to, and which part of it.
  using Place = std::tuple<FixedPiece::Kind, std::size_t, FixedPiece::Kind, std::size_t>;
  std::map<Place, std::optional<Known>> known_;
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
