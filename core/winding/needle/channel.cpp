#include "core/winding/needle/channel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/numeric/golden_section.hpp"
#include "core/winding/part/vec3.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double most_lean = 1.5, lean_step = 0.05, lean_exact = 1e-6;
constexpr double look_step = 0.5, look_exact = 1e-3;  // mm
constexpr int looks = 24;                             // steps along a line
constexpr double most_beyond = 0.5;                   // of a line's length: as far as it is continued beyond its ends

/// Returns the distance of one obstacle, whose distances change by at most 1 mm per mm; or `least` if that is less.
template <class Distance>
double nearest(const NeedlePose& pose, const NeedleShape& needle, const Distance& distance, double least) {
  const double radius = needle.width / 2;
  const Vec3 d = pose.direction();
  const auto at = [&](double s) { return distance(pose.tip - s * d) - radius; };
  double here = std::numeric_limits<double>::infinity(), where = radius;
  for (double s = radius; s <= needle.length;) {
    const double found = at(s);
    if (found < here) here = found, where = s;
    s += std::max(look_step, found - std::min(here, least));
  }
  const double first = std::max(radius, where - look_step), last = std::min(needle.length, where + look_step);
  return std::min({least, here, at(golden_section([&](double s) { return -at(s); }, first, last, look_exact).at)});
}

/// The needle turns by the shorter angle: its direction may be given by angles that differ by a whole turn.
NeedlePose mixed(const NeedlePose& a, const NeedlePose& b, double u) {
  const double phi = a.phi + std::remainder(b.phi - a.phi, 2 * std::numbers::pi);
  return {(1 - u) * a.tip + u * b.tip, (1 - u) * a.phi + u * phi, (1 - u) * a.psi + u * b.psi};
}

}  // namespace

double room(const NeedlePose& pose, const NeedleShape& needle, const std::vector<const Obstacle*>& obstacles) {
  double least = std::numeric_limits<double>::infinity();
  for (const Obstacle* obstacle : obstacles)
    least = nearest(
        pose, needle, [&](Vec3 p) { return obstacle->distance(p); }, least);
  return least;
}

double room(const NeedlePose& from, const NeedlePose& to, const NeedleShape& needle,
            const std::vector<const Obstacle*>& obstacles) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= looks; ++i)
    least = std::min(least, room(mixed(from, to, static_cast<double>(i) / looks), needle, obstacles));
  return least;
}

double slot_room(const NeedlePose& from, const NeedlePose& to, double low, double high, const NeedleShape& needle,
                 const Obstacle& iron) {
  const double way = to.tip.z - from.tip.z;
  const auto share = [&](double z) {
    return way != 0 ? std::clamp((z - from.tip.z) / way, -most_beyond, 1 + most_beyond) : 0.0;
  };
  const double first = share(low), last = share(high);
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= looks; ++i) {
    const NeedlePose pose = mixed(from, to, first + (last - first) * i / looks);
    least = nearest(
        pose, needle, [&](Vec3 p) { return iron.section_distance(p); }, least);
    if (first == last) break;
  }
  return least;
}

Expected<SupportPoint, NoSupport> kept_clear(Vec3 along, Vec3 across,
                                             const std::function<Expected<SupportPoint, NoSupport>(Vec3)>& support,
                                             const std::function<double(const NeedlePose&)>& left, double enough) {
  const Expected<SupportPoint, NoSupport> straight = support(along);
  if (!straight) return straight;
  double most = left(straight->pose), best = 0;
  if (most >= enough) return straight;
  const auto leaning = [&](double k) {
    const Vec3 way = along + k * across;
    return support((1 / norm(way)) * way);
  };
  /// Returns the distance for this lean; less than any other if it is impossible.
  const auto leaves = [&](double k) {
    const Expected<SupportPoint, NoSupport> point = leaning(k);
    return point ? left(point->pose) : -std::numeric_limits<double>::infinity();
  };
  const auto steps = static_cast<int>(std::lround(most_lean / lean_step));
  for (int i = 1; i <= steps && most < enough; ++i)
    for (const double k : {i * lean_step, -i * lean_step}) {
      const double found = leaves(k);
      if (found > most) most = found, best = k;
    }
  if (most < enough) {
    const double k = golden_section(leaves, best - lean_step, best + lean_step, lean_exact).at, found = leaves(k);
    if (found > most) most = found, best = k;
  }
  if (best == 0) return straight;
  if (most < enough) return leaning(best);
  // The lean that is one step smaller leaves too little distance.
  double less = best - std::copysign(std::min(lean_step, std::abs(best)), best);
  while (std::abs(best - less) > lean_exact) {
    const double middle = (less + best) / 2;
    (leaves(middle) >= enough ? best : less) = middle;
  }
  return leaning(best);
}

}  // namespace bahnwerk::winding
