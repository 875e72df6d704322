#include "core/plan/contour/what_if.hpp"

#include <optional>
#include <utility>

#include "core/base/progress.hpp"
#include "core/plan/contour/rounding_choice.hpp"
#include "core/plan/trial.hpp"

namespace bahnwerk {
namespace {

constexpr const char* stage = "what if";

struct Change {
  WhatIf::What what;
  double factor;
};

void scale(Limits& limits, const Change& change) {
  if (change.what == WhatIf::What::jerk) limits.jerk *= change.factor;
  if (change.what == WhatIf::What::acceleration) limits.acceleration *= change.factor;
}

std::optional<double> duration(const std::shared_ptr<const Contour>& given, const ToolMachine& machine,
                               const ContourPlanning& planning, Progress progress) {
  constexpr double prepared_at = 0.1, chosen_at = 0.5;
  const auto planned = trial([&] {
    const PreparedContour prepared = prepare_contour(given, machine, planning, progress.part(0, prepared_at));
    DrivenContour driven = choose_rounding(prepared, planning, progress.part(prepared_at, chosen_at));
    PathPlanning path = path_planning(prepared, driven.contour, planning);
    path.only_duration = true;
    return plan_along(path, progress.part(chosen_at, 1), std::move(driven.law));
  });
  if (planned && planned->verification.passed) return planned->duration;
  return {};
}

}  // namespace

std::vector<WhatIf> what_if(const std::shared_ptr<const Contour>& given, const ToolMachine& machine,
                            const ContourPlanning& planning, Progress progress) {
  std::vector<Change> changes;
  if (planning.corner_mode == CornerMode::blend) changes.push_back({WhatIf::What::tolerance, 2});
  if (method_row(planning.method).order == 3)
    changes.insert(changes.end(), {{WhatIf::What::jerk, 0.5}, {WhatIf::What::jerk, 2}});
  changes.push_back({WhatIf::What::acceleration, 0.5});
  std::vector<WhatIf> answers;
  const double share = 1 / static_cast<double>(changes.size());
  for (const Change& change : changes) {
    ToolMachine other = machine;
    for (AxisLimits& axis : other.axes) scale(axis, change);
    ContourPlanning asked = planning;
    scale(asked.along, change);
    if (change.what == WhatIf::What::tolerance) asked.blend_tolerance *= change.factor;
    const double begin = share * static_cast<double>(answers.size());
    const Progress part = progress.part(begin, begin + share).named(stage);
    answers.push_back({change.what, change.factor, duration(given, other, asked, part)});
  }
  return answers;
}

}  // namespace bahnwerk
