#include "core/verify/geometry/tube.hpp"

#include <algorithm>
#include <cmath>

#include "core/verify/geometry/tube_block.hpp"

namespace bahnwerk {

namespace {

/// Returns the path range of a block; the whole path of a contour without blocks.
verify::PathRange range_of(const Contour& contour, std::size_t block) {
  if (contour.blocks.empty()) return {&contour.path, 0, contour.path.size()};
  return {&contour.path, contour.blocks[block].first, contour.blocks[block].last};
}

/// Blocks of the path that are not the contour's: too few, of another mode, with a length that the given one has not or
/// without one that it has, or not one after the other.
verify::Worst wrong_blocks(const Contour& given, const Contour& path) {
  const std::size_t n = std::min(given.blocks.size(), path.blocks.size());
  verify::Worst wrong;
  double count = static_cast<double>(std::max(given.blocks.size(), path.blocks.size()) - n);
  std::size_t at = 0;
  for (std::size_t b = 0; b < n; ++b) {
    const Block &g = given.blocks[b], &p = path.blocks[b];
    const bool covers = p.first == at && p.last >= p.first && p.last <= path.path.size();
    if (covers && g.mode == p.mode && (g.first == g.last) == (p.first == p.last)) {
      at = p.last;
      continue;
    }
    if (++count == 1 && at < path.path.size()) wrong.at = path.path[at].s0();
    if (!covers) break;
    at = p.last;
  }
  if (n > 0 && count == 0 && at != path.path.size()) ++count;
  wrong.value = count;
  return wrong;
}

}  // namespace

std::vector<Check> tube_checks(const Contour& given, const Contour& path, double tolerance, Progress progress) {
  ProgressScope stage_progress(progress, "verify");
  stage_progress.report();
  std::vector<Check> checks{
      verify::make_check({{"blocks out of order", CheckGroup::geometry}, 0, "1"}, 0, wrong_blocks(given, path))};
  verify::Worst worst{HUGE_VAL, 0};
  if (checks.back().passed && !given.path.empty() && !path.path.empty()) {
    worst = {};
    verify::TubeBlock tube(tolerance, stage_progress);
    for (std::size_t b = 0; b < std::max<std::size_t>(1, given.blocks.size()); ++b) {
      const verify::PathRange piece = range_of(path, b);
      if (piece.first == piece.last) continue;
      stage_progress.done(static_cast<double>(piece.first) / static_cast<double>(path.path.size()));
      const verify::Worst found = tube.measure(range_of(given, b), piece);
      if (std::isnan(found.value) || found.value > worst.value) worst.raise(found.value, found.at);
    }
  }
  checks.push_back(verify::make_check({{"deviation from contour", CheckGroup::geometry}}, tolerance, worst));
  stage_progress.done(1);
  stage_progress.report();
  return checks;
}

}  // namespace bahnwerk
