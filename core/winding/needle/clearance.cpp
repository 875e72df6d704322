#include "core/winding/needle/clearance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/base/errors.hpp"

namespace bahnwerk::winding {
namespace {

/// A piece of a move times a piece of the needle.
struct Cell {
  double u, half_u, s, half_s;
};

/// How fast things change at most, by u.
struct Speeds {
  double tip;     ///< mm
  double across;  ///< of the tip, in sections normal to the part's axis, mm
  double turn;    ///< of the needle, rad: |d'| ≤ |φ'| + |ψ'|
  explicit Speeds(const NeedleMove& m) : turn(std::abs(m.to.phi - m.from.phi) + std::abs(m.to.psi - m.from.psi)) {
    const Space way = m.to.tip - m.from.tip;
    tip = m.arc ? std::abs(m.sweep) * std::hypot(m.from.tip.x, m.from.tip.y) : norm(way);
    across = m.arc ? tip : std::hypot(way.x, way.y);
  }
};

/// Where on the needle, from `first` to `last` behind the tip, a convex obstacle is nearest, to 1e-7 mm: a golden
/// section search, which stands on a needle that lies flat against a face as well.
double nearest_along(const Obstacle& obstacle, const NeedlePose& pose, double first, double last) {
  const Space d = pose.direction();
  const auto value = [&](double s) { return obstacle.distance(pose.tip - s * d); };
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double a = last - golden * (last - first), b = first + golden * (last - first), at_a = value(a), at_b = value(b);
  while (last - first > 1e-7) {
    if (at_a <= at_b) {
      last = b, b = a, at_b = at_a;
      at_a = value(a = last - golden * (last - first));
    } else {
      first = a, a = b, at_a = at_b;
      at_b = value(b = first + golden * (last - first));
    }
  }
  return (first + last) / 2;
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
  std::vector<InputFault> faults;
  if (!(needle.width > 0) || !std::isfinite(needle.width))
    faults.push_back({{"needle", "width"}, "is not a number above 0"});
  if (!(needle.length >= needle.width) || !std::isfinite(needle.length))
    faults.push_back({{"needle", "length"}, "is less than the needle's width"});
  if (!faults.empty()) throw InvalidInput(faults);
  if (!(tolerance >= 1e-6)) throw std::invalid_argument("a tolerance of at least 1e-6 mm is needed");
  const double radius = needle.width / 2;
  Clearance best;
  best.minimum = std::numeric_limits<double>::infinity();
  // A coarse look at everything first: what is farther away than the nearest of that needs few halvings.
  for (std::size_t n = 0; n < moves.size(); ++n)
    for (int i = 0; i <= 4; ++i) {
      const double u = i / 4.0;
      const NeedlePose pose = moves[n].at(u);
      const Space d = pose.direction();
      for (int j = 0; j <= 16; ++j) {
        const double s = radius + j / 16.0 * (needle.length - radius);
        for (std::size_t k = 0; k < obstacles.size(); ++k) {
          const double found = obstacles[k]->distance(pose.tip - s * d) - radius;
          if (found < best.minimum) best = {found, n, u, s, k};
        }
      }
    }
  std::vector<Cell> open;
  std::size_t count = 0;
  for (std::size_t n = 0; n < moves.size(); ++n) {
    const Speeds speeds(moves[n]);
    for (std::size_t k = 0; k < obstacles.size(); ++k) {
      const Obstacle& obstacle = *obstacles[k];
      // The axis of the bar, from the middle of its round end.
      open.push_back({0.5, 0.5, (radius + needle.length) / 2, (needle.length - radius) / 2});
      while (!open.empty()) {
        if (count++ % 1024 == 0)
          progress.report("clearance", static_cast<double>(n) / static_cast<double>(moves.size()));
        const Cell c = open.back();
        open.pop_back();
        const NeedlePose pose = moves[n].at(c.u);
        if (obstacle.convex()) {
          const double s = nearest_along(obstacle, pose, radius, needle.length),
                       found = obstacle.distance(pose.tip - s * pose.direction()) - radius;
          if (found < best.minimum) best = {found, n, c.u, s, k};
          if (found - c.half_u * (speeds.tip + needle.length * speeds.turn) - 1e-7 >= best.minimum - tolerance)
            continue;
          const double h = c.half_u / 2;
          open.push_back({c.u - h, h, 0, 0});
          open.push_back({c.u + h, h, 0, 0});
          continue;
        }
        const Space p = pose.tip - c.s * pose.direction();
        const double found = obstacle.distance(p) - radius;
        if (found < best.minimum) best = {found, n, c.u, c.s, k};
        const double enough = best.minimum - tolerance, far = c.s + c.half_s, turn = far * speeds.turn,
                     moved = c.half_u * (speeds.tip + turn), across = c.half_u * (speeds.across + turn);
        if (found - moved - c.half_s >= enough) continue;
        const double section = obstacle.section_distance(p) - radius;
        if (section - across - c.half_s >= enough) continue;
        // Where the section's distance will decide, only what moves across counts.
        if ((section >= enough + tolerance / 2 ? across : moved) > c.half_s) {
          const double h = c.half_u / 2;
          open.push_back({c.u - h, h, c.s, c.half_s});
          open.push_back({c.u + h, h, c.s, c.half_s});
        } else {
          const double h = c.half_s / 2;
          open.push_back({c.u, c.half_u, c.s + h, h});
          open.push_back({c.u, c.half_u, c.s - h, h});
        }
      }
    }
  }
  return best;
}

}  // namespace bahnwerk::winding
