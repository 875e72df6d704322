#include "core/plan/winding/winding_drawings.hpp"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <utility>
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

void append(std::vector<winding::Polyline3> more, std::vector<winding::Polyline3>& lines) {
  std::move(more.begin(), more.end(), std::back_inserter(lines));
}

/// Returns one line per coil, through the places of its wires.
std::vector<winding::Polyline3> laid_wires(const std::vector<winding::Turn>& turns) {
  std::vector<winding::Polyline3> lines;
  for (const winding::Turn& turn : turns) {
    if (turn.number == 0) lines.emplace_back();
    for (const winding::Passage& passage : turn.at) {
      lines.back().push_back(passage.begin);
      lines.back().push_back(passage.end);
    }
  }
  return lines;
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
  winding::DrawnPath drawn{title, all, {}, last, plan.turns.size()};
  std::visit(
      [&](const auto& part) {
        const winding::Slot slot = winding::checked_slot(part);
        drawn.outline = winding::part_outline(part, slot);
        for (const winding::Coil& coil : request.coils) append(winding::coil_outline(part, slot, coil), drawn.coils);
        drawn.slots = winding::slot_labels(part, request.coils);
      },
      request.part);
  if (const auto* stator = std::get_if<winding::StatorPart>(&request.part))
    for (const winding::Coil& coil : request.coils)
      append(winding::post_outline(*stator, request.tool, coil), drawn.posts);
  drawn.wires = laid_wires(plan.turns);
  drawn.needle_length = request.needle.length, drawn.needle_width = request.needle.width;
  return winding::path_drawing(drawn);
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
