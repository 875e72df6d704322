#pragma once
/// What other fine axes would bring on a contour: for who buys or tunes the machine.
#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.hpp"
#include "core/contour/contour.hpp"
#include "core/plan/coarse_fine/coarse_fine_plan.hpp"

namespace bahnwerk {

struct StudiedMachine {
  double value = 0;                ///< of every fine axis: stroke, mm, or acceleration, mm/s²
  std::optional<double> duration;  ///< s; none where nothing verified can be planned
};

struct MachineStudy {
  std::vector<StudiedMachine> stroke;             ///< 5 to 100 mm, the same of all axes
  std::vector<StudiedMachine> fine_acceleration;  ///< a quarter to twice that of the first axis, all scaled alike
};

/// Plans the contour again for every machine, all else being equal, with the shortest duration asked for. As many plans
/// as machines. Throws Stopped.
MachineStudy machine_study(const Contour& contour, const CoarseFineMachine& machine, const ContourPlanning& planning,
                           const RedundancyOptions& options, Progress& progress, double from, double to);

/// Both as curves over the figure that is changed, in SVG; `duration`: that of the machine as it is.
std::string machine_study_drawing(const MachineStudy& study, double duration);

}  // namespace bahnwerk
