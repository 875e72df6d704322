#include "core/plan/contour/prepared_contour.hpp"

#include "core/verify/law/verifier.hpp"

namespace bahnwerk {

PreparedContour prepare_contour(const std::shared_ptr<const Contour>& given, const ToolMachine& machine,
                                const ContourPlanning& planning, Progress progress) {
  const MethodRow method = method_row(planning.method, planning);
  const auto axes = std::make_shared<const ContourAxes>(given, machine);
  PreparedContour prepared{given, nullptr, {}, axes, method, held_limits(axes->machine(), method), {}};
  prepared.moving = prepared.held;
  prepared.moving.axes.resize(axes->moved());
  if (planning.corner_mode == CornerMode::blend)
    prepared.rounded =
        std::make_shared<const Contour>(blend(*given, {planning.blend_tolerance, planning.corner_angle},
                                              axes->tool_limits(prepared.moving), progress, &prepared.sections));
  return prepared;
}

PathPlanning path_planning(const PreparedContour& prepared, const std::shared_ptr<const Contour>& driven,
                           const ContourPlanning& planning) {
  PathPlanning path;
  const ContourAxes::Paths paths = prepared.axes->along(driven);
  path.path = paths.all, path.moving = paths.moving;
  path.machine = prepared.held;
  path.shown = prepared.axes->shown();
  path.feeds = driven->feeds();
  path.feeds_to_verify = feeds_to_hold(*driven, *prepared.given);
  path.rests = driven->rest_places();
  path.dwells = driven->rests;
  path.method = prepared.method;
  path.options = planning;
  path.max_setpoints = planning.max_setpoints;
  return path;
}

}  // namespace bahnwerk
