#pragma once
/// One turn about a stator's tooth on a winding machine, with the verdicts on its setpoints.
#include <memory>
#include <string>
#include <vector>

#include "core/base/progress.hpp"
#include "core/motion/axes/machine_path.hpp"
#include "core/motion/natural/natural_law.hpp"
#include "core/motion/setpoints/cycles.hpp"
#include "core/motion/setpoints/needle_setpoints.hpp"
#include "core/verify/setpoints/needle_checks.hpp"
#include "core/verify/setpoints/setpoint_checks.hpp"
#include "tests/core/check_names.hpp"
#include "tests/core/machine/winders.hpp"
#include "tests/core/motion/axes/needle_loop.hpp"

namespace bahnwerk::test {

struct Wound {
  NeedlePath needle = stator_turn();
  MachinePath machine = machine_path(needle.tool, needle.orientation, winders()[1].configurations);
  Machine limits{machine.kinematics->axes(), 0.002};
  std::shared_ptr<const PathMotion> motion;
  std::unique_ptr<NeedleSetpoints> rows;

  Wound() {
    std::vector<bool> rests(needle.tool.size() + 1, false);
    rests.front() = rests.back() = true;
    const PathTask task{*machine.axes, limits, std::vector<double>(needle.tool.size(), unlimited), rests};
    NaturalOptions options;
    for (std::size_t i = 0; i < needle.tool.size(); ++i) options.shares.push_back(i % 2 == 1 ? 1 : 0);
    Progress progress;
    TimeLaw law = plan_natural(task, options, progress);
    const Cycles cycles = whole_cycles(law.duration(), limits.cycle_time);
    law.slow(cycles.factor);
    motion = std::make_shared<const PathMotion>(machine.axes, std::move(law));
    rows = std::make_unique<NeedleSetpoints>(
        motion, machine.axes, limits,
        WireForces{[](std::size_t, double, const LawState&) { return 25.0; }, [](double, double) { return 26.0; }},
        NeedleSetpoints::Options{cycles.count});
  }
  std::vector<Check> needle_checks_of(const SetpointSource& source) const {
    Progress progress;
    return needle_checks({*machine.axes, *machine.kinematics, source, NeedleSetpoints::shown(limits)}, progress);
  }
  std::vector<Check> setpoint_checks_of(const SetpointSource& source, double lag = 0) const {
    Progress progress;
    SetpointInput input{*machine.axes, limits, motion->law(), source};
    input.shown = NeedleSetpoints::shown(limits);
    input.lag = lag;
    return setpoint_checks(input, progress);
  }
};

/// Names of the failed checks.
inline std::string failed(const std::vector<Check>& checks) {
  std::string names;
  for (const Check& check : checks)
    if (!check.passed) names += (names.empty() ? "" : ", ") + check_name(check);
  return names;
}

}  // namespace bahnwerk::test
