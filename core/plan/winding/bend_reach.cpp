#include "core/plan/winding/bend_reach.hpp"

#include <memory>
#include <variant>

#include "core/base/progress.hpp"
#include "core/plan/trial.hpp"
#include "core/plan/winding/needle_support.hpp"
#include "core/winding/path/post_passage.hpp"

namespace bahnwerk {

Expected<winding::NeedlePath, winding::NoPath> linked_path(const WindingRequest& request,
                                                           const std::vector<winding::FixedPiece>& support,
                                                           LinkObjective objective, Progress progress) {
  winding::LinkOptions options = request.links;
  options.objective = objective;
  const auto* stator = std::get_if<winding::StatorPart>(&request.part);
  if (stator == nullptr) return winding::needle_path(support, false, options, progress);
  const winding::PostPassage posts(*stator, request.coils, request.tool, request.needle, request.least_clearance);
  return winding::needle_path(support, true, options, progress, &posts);
}

bool reaches_with_least_bend(const WindingRequest& request, const std::vector<winding::Turn>& turns,
                             const winding::FixedPiece& piece, Progress progress) {
  std::vector<winding::Turn> near;
  for (const winding::Turn& turn : turns)
    if (turn.coil == piece.coil && turn.number + 1 >= piece.turn && turn.number <= piece.turn + 1) near.push_back(turn);
  winding::NeedleModel model = request.model;
  model.pivot_limit = tried_swivels(request).front();
  model.pull.bend_radius = request.wire.outer, model.pull.bending_moment = 0;
  // The stages were reported before.
  const Progress again = progress.part(1, 1).named("machine");
  const auto fixed = needle_support(request, near, model, again);
  if (!fixed) return false;
  const auto path = linked_path(request, *fixed, request.links.objective, again);
  if (!path) return false;
  const auto tool = std::make_shared<const PosePath>(pose_path(path->curves()));
  return bool(trial([&] { return machine_path({tool, &tool->tool}, tool->orientation, request.configurations); }));
}

}  // namespace bahnwerk
