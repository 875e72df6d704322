#include "core/winding/layout/potential.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/base/progress.hpp"
#include "core/winding/margin.hpp"
#include "core/winding/packing/search.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double slack = verify_margin;
constexpr double unit_work = 5.5e8;  // OverlapEnergy::work spent on one number of wires at effort 1

void demand(double radius, const PotentialOptions& options) {
  if (!(radius > 0) || !(options.overlap >= 0) || !(options.overlap < 2 * radius))
    throw std::invalid_argument("radius and overlap of wires");
}

std::uint64_t work_of(const PotentialOptions& options, double share) {
  return static_cast<std::uint64_t>(std::max(1.0, share * unit_work * options.effort));
}

/// Few wires have few layouts, which more tries would only repeat.
std::size_t tries_of(const PotentialOptions& options, double share, std::size_t count) {
  return static_cast<std::size_t>(share * options.effort * (300 + 60.0 * static_cast<double>(count))) + 8;
}

}  // namespace

bool packed(const Region& usable_area, double radius, double overlap, std::span<const Point> wires) {
  const double least = 2 * radius - overlap - slack;
  for (std::size_t i = 0; i < wires.size(); ++i) {
    if (!(usable_area.distance(wires[i]) >= radius - slack)) return false;
    for (std::size_t k = i + 1; k < wires.size(); ++k)
      if (!(distance(wires[i], wires[k]) >= least)) return false;
  }
  return true;
}

std::optional<std::vector<Point>> pack(const Region& usable_area, double radius, std::size_t count,
                                       std::span<const std::vector<Point>> hints, const PotentialOptions& options,
                                       Progress progress) {
  demand(radius, options);
  const CentreArea centres(usable_area, radius, progress);
  PackingSearch search(centres, 2 * radius - options.overlap, options.seed, progress);
  auto found = search.find(count, hints, work_of(options, 4), tries_of(options, 4, count));
  if (found && !packed(usable_area, radius, options.overlap, *found)) found.reset();
  return found;
}

std::vector<Point> potential(const Region& usable_area, double radius, std::span<const std::vector<Point>> hints,
                             const PotentialOptions& options, Progress progress) {
  demand(radius, options);
  std::vector<Point> best;
  for (const std::vector<Point>& hint : hints)
    if (hint.size() > best.size() && packed(usable_area, radius, options.overlap, hint)) best = hint;
  progress.report("potential", 0);
  const CentreArea centres(usable_area, radius, progress);
  if (centres.empty()) return best;
  const double least = 2 * radius - options.overlap;
  PackingSearch search(centres, least, options.seed, progress);
  const auto take = [&](std::vector<Point> wires) {
    search.fill(wires);
    if (wires.size() > best.size() && packed(usable_area, radius, options.overlap, wires)) best = std::move(wires);
  };
  take(best);
  take(best_rows(centres, search.sides(), least, static_cast<std::size_t>(400 * std::max(1.0, options.effort)),
                 search.random()));
  // The count grows in increasing steps with little work each, then one by one with all of it.
  std::size_t stride = 1 + best.size() / 64;
  while (stride > 0 && best.size() < options.most) {
    const std::size_t count = std::min(best.size() + stride, options.most);
    const bool last = stride == 1;
    const std::vector<std::vector<Point>> likely{best};
    const double share = last ? 1 : 0.1;
    search.set_reach(share);
    auto found = search.find(count, likely, work_of(options, share), tries_of(options, share, count));
    if (found) take(std::move(*found));
    if (best.size() < count) stride /= 2;
  }
  return best;
}

}  // namespace bahnwerk::winding
