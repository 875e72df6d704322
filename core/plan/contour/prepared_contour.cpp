#include "core/plan/contour/prepared_contour.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/contour/blend.hpp"
#include "core/plan/contour/rounding_choice.hpp"
#include "core/verify/verifier.hpp"

namespace bahnwerk {

PreparedContour prepare_contour(const std::shared_ptr<const Contour>& given, const Machine& machine,
                                const ContourPlanning& planning, Progress& progress, double from, double to) {
  constexpr double rounded = 0.2;  // part of the progress at which rounding ends
  PreparedContour posed{given, {}};
  PathPlanning& path = posed.path;
  const std::size_t moving = std::min(machine.dimension(), given->dimension);
  if (planning.corner_mode == CornerMode::blend) {
    const MethodRow& method = method_row(planning.method);
    const Machine held = held_limits(machine, method, moving);
    const double between = from + rounded * (to - from);
    std::vector<BlendSection> sections;
    auto blended = std::make_shared<const Contour>(
        blend(*given, {planning.blend_tolerance, planning.corner_angle}, held, progress, from, between, &sections));
    RoundingChoice choice =
        choose_rounding(given, std::move(blended), sections, held, method, planning, progress, between, to);
    posed.driven = std::move(choice.driven);
    path.planned = std::make_shared<MethodResult>(std::move(choice.planned));
  }
  path.path = contour_axes(posed.driven, machine.dimension());
  path.moving = contour_axes(posed.driven, moving);
  path.machine = machine;
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
