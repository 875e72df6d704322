#include "core/plan/contour/prepared_contour.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/contour/blend.hpp"
#include "core/plan/contour/rounding_choice.hpp"
#include "core/verify/law/verifier.hpp"

namespace bahnwerk {

PreparedContour prepare_contour(const std::shared_ptr<const Contour>& given, const ToolMachine& machine,
                                const ContourPlanning& planning, Progress& progress, double from, double to) {
  constexpr double rounded = 0.2;  // part of the progress at which rounding ends
  PreparedContour posed{given, std::make_shared<const ContourAxes>(given, machine), {}};
  const ContourAxes& axes = *posed.axes;
  PathPlanning& path = posed.path;
  if (planning.corner_mode == CornerMode::blend) {
    const MethodRow& method = method_row(planning.method);
    const Machine held = held_limits(axes.machine(), method, axes.moved());
    const double between = from + rounded * (to - from);
    std::vector<BlendSection> sections;
    auto blended = std::make_shared<const Contour>(blend(*given, {planning.blend_tolerance, planning.corner_angle},
                                                         axes.tool_limits(held), progress, from, between, &sections));
    RoundingChoice choice =
        choose_rounding(given, std::move(blended), sections, axes, held, method, planning, progress, between, to);
    posed.driven = std::move(choice.driven);
    path.planned = std::make_shared<MethodResult>(std::move(choice.planned));
  }
  const ContourAxes::Paths paths = axes.along(posed.driven);
  path.path = paths.all, path.moving = paths.moving;
  path.machine = axes.machine();
  path.shown = axes.shown();
  path.feeds = posed.driven->feeds();
  path.feeds_to_verify = feeds_to_hold(*posed.driven, *given);
  path.rests = posed.driven->rest_places();
  path.dwells = posed.driven->rests;
  path.method = planning.method;
  path.options = planning;
  path.max_setpoints = planning.max_setpoints;
  return posed;
}

}  // namespace bahnwerk
