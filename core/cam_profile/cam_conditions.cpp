#include "core/cam_profile/cam_conditions.hpp"

#include <algorithm>
#include <numbers>

#include "core/base/progress.hpp"

namespace bahnwerk::cam {
namespace {

constexpr double accuracy = 1e-10;

CertifiedMaximum largest_excess(CamCondition condition, const CamGeometry& geometry, const FollowerLaw& law,
                                double radius, Progress progress) {
  const PitchSeat<Disc> seat = pitch_seat<Disc>(geometry, Disc(radius));
  return certified_maximum(
      law, [&](const LawSeries<Disc>& y) { return condition_excess(condition, seat, y); }, accuracy, progress);
}

LawSeries<Disc> as_discs(const LawSeries<double>& y) {
  LawSeries<Disc> out;
  for (std::size_t k = 0; k < y.c.size(); ++k) out.c[k] = Disc(y.c[k]);
  return out;
}

/// Returns whether one place of the law breaks a condition for all radii of the interval.
bool excluded(const CamGeometry& geometry, const FollowerLaw& law, const std::vector<CamCondition>& list, double low,
              double high, Progress progress) {
  const double middle = (low + high) / 2;
  if (!follower_reaches(geometry, law, middle)) return false;
  const PitchSeat<Disc> seat = pitch_seat<Disc>(geometry, Disc(middle, (high - low) / 2));
  for (const CamCondition condition : list) {
    const CertifiedMaximum worst = largest_excess(condition, geometry, law, middle, progress);
    if (worst.value <= 0) continue;
    const Disc excess = condition_excess(condition, seat, as_discs(worst.law)).c[0];
    if (excess.known() && excess.low() > 0) return true;
  }
  return false;
}

}  // namespace

std::vector<CamCondition> cam_conditions(const CamGeometry& g) {
  std::vector<CamCondition> list;
  if (!g.has_roller()) return {CamCondition::flat_radius};
  if (g.pressure_angle) list = {CamCondition::pressure_angle, CamCondition::pressure_angle_back};
  if (g.roller_radius + g.profile_radius > 0) {
    list.push_back(CamCondition::curvature);
    if (g.type == CamType::barrel) list.push_back(CamCondition::curvature_back);
  }
  return list;
}

bool follower_reaches(const CamGeometry& g, const FollowerLaw& law, double radius) {
  if (!(radius > 0)) return false;
  if (g.type == CamType::barrel || g.follower == FollowerType::flat) return true;
  if (g.follower == FollowerType::translating) return radius > std::abs(g.offset);
  if (!(radius > std::abs(g.arm - g.distance) && radius < g.arm + g.distance)) return false;
  return pitch_seat<double>(g, radius).start + law.stroke() < std::numbers::pi;
}

bool conditions_hold(const CamGeometry& geometry, const FollowerLaw& law, const std::vector<CamCondition>& list,
                     double radius, Progress progress) {
  if (!follower_reaches(geometry, law, radius)) return false;
  return std::all_of(list.begin(), list.end(), [&](CamCondition condition) {
    return largest_excess(condition, geometry, law, radius, progress).upper <= 0;
  });
}

std::optional<LeastRadius> least_base_radius(const CamGeometry& g, const FollowerLaw& law,
                                             const std::vector<CamCondition>& list, Progress progress) {
  const bool oscillating = g.type == CamType::radial && g.follower == FollowerType::oscillating;
  const double size =
      std::max({oscillating ? g.arm * law.stroke() : law.stroke(), g.profile_radius, std::abs(g.offset)});
  const double added = pitch_radius(g, 0);
  // Where the follower just reaches the circle its pressure angle is 90 deg, and enclosures of it are unbounded.
  constexpr double reached = 1 + 1e-4;
  double low = std::max({added, 1e-6 * size, reached * std::abs(g.offset)});
  if (oscillating) low = std::max(low, reached * std::abs(g.arm - g.distance));
  const double most = oscillating ? g.arm + g.distance : low + 1e5 * size;
  double high = low + size;
  while (!conditions_hold(g, law, list, std::min(high, most), progress)) {
    if (high >= most) return {};
    high = low + 2 * (high - low);
  }
  high = std::min(high, most);

  // Intervals from the smallest radii on; the first one that is neither excluded nor to be halved ends the search.
  std::vector<std::pair<double, double>> open{{low, high}};
  double proven = low;
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    if (excluded(g, law, list, from, to, progress)) {
      if (from <= proven) proven = to;
      continue;
    }
    if (to - from > 1e-6 * to) {
      const double middle = from + (to - from) / 2;
      open.emplace_back(middle, to);
      open.emplace_back(from, middle);
    } else if (conditions_hold(g, law, list, to, progress)) {
      return LeastRadius{to - added, proven - added};
    }
  }
  return LeastRadius{high - added, proven - added};
}

}  // namespace bahnwerk::cam
