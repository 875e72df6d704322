#include "core/plan/winding/winding_drawings.hpp"

#include <cstdio>
#include <variant>
#include <vector>

#include "core/drawing/spline_dxf.hpp"
#include "core/winding/drawing/path_drawing.hpp"

namespace bahnwerk {
namespace {

/// Returns the pieces before `end`.
std::vector<BezierPiece> curves(const WindingPlan& plan, std::size_t end) {
  std::vector<BezierPiece> all;
  for (std::size_t i = 0; i < end; ++i) all.push_back(plan.path.pieces[i].curve);
  return all;
}

}  // namespace

std::string needle_path_drawing(const WindingRequest& request, const WindingPlan& plan) {
  char title[120];
  std::snprintf(title, sizeof title, "needle path of %zu turn%s: %.6g mm, %.6g s", plan.turns.size(),
                plan.turns.size() == 1 ? "" : "s", plan.path_length, plan.motion.duration);
  const std::vector<BezierPiece> all = curves(plan, plan.path.pieces.size());
  const auto& pieces = plan.path.pieces;
  const winding::FixedPiece& end = plan.support[pieces.back().fixed];
  std::size_t last = pieces.size();
  while (last > 0 && plan.support[pieces[last - 1].fixed].turn == end.turn &&
         plan.support[pieces[last - 1].fixed].coil == end.coil)
    --last;
  return winding::path_drawing(
      {title, all,
       std::visit([](const auto& part) { return winding::part_outline(part, winding::checked_slot(part)); },
                  request.part),
       last, plan.turns.size()});
}

std::string turn_curvature_drawing(const WindingPlan& plan) {
  std::size_t end = 0;
  const auto& pieces = plan.path.pieces;
  while (end < pieces.size() && plan.support[pieces[end].fixed].turn == 0 && plan.support[pieces[end].fixed].coil == 0)
    ++end;
  return winding::curvature_chart(curves(plan, end), "curvature of the needle's path, first turn");
}

std::string needle_path_dxf(const WindingPlan& plan) {
  const NurbsPath path = plan.path.united();
  return splines_as_dxf({&path, 1});
}

}  // namespace bahnwerk
