#include "core/plan/winding/path_clearance.hpp"

#include <span>
#include <variant>

#include "core/base/progress_part.hpp"
#include "core/winding/needle/part_obstacles.hpp"

namespace bahnwerk {
namespace {

constexpr double tolerance = 0.001;  // mm

winding::PartObstacles obstacles(const winding::StatorPart& part, const WindingRequest& request, winding::Coil coil) {
  return winding::part_obstacles(part, winding::checked_slot(part), request.tool, {coil});
}
winding::PartObstacles obstacles(const winding::RotorPart& part, const WindingRequest&, winding::Coil) {
  return winding::part_obstacles(part, winding::checked_slot(part));
}

}  // namespace

PathClearance path_clearance(const WindingRequest& request, const std::vector<winding::FixedPiece>& support,
                             const winding::NeedlePath& path, Progress& progress) {
  PathClearance nearest;
  nearest.least.minimum = unlimited;
  const std::vector<BezierPiece> curves = path.curves();
  const auto& pieces = path.pieces;
  for (std::size_t begin = 0; begin < pieces.size();) {
    const std::size_t coil = coil_of(pieces[begin], support);
    std::size_t end = begin;
    while (end < pieces.size() && coil_of(pieces[end], support) == coil) ++end;
    const winding::PartObstacles all =
        std::visit([&](const auto& part) { return obstacles(part, request, request.coils[coil]); }, request.part);
    const auto done = [&](std::size_t piece) {
      return static_cast<double>(piece) / static_cast<double>(pieces.size());
    };
    ProgressPart clearing(progress, "clearance", done(begin), done(end));
    winding::Clearance least = winding::clearance(std::span(curves).subspan(begin, end - begin), request.needle,
                                                  all.list(), tolerance, clearing);
    least.move += begin;
    if (least.minimum < nearest.least.minimum)
      nearest.least = least, nearest.nearest = all.list().empty() ? "" : all.name(least.obstacle);
    begin = end;
  }
  return nearest;
}

}  // namespace bahnwerk
