#pragma once
/// What other axes would bring on a contour: for who buys or tunes the machine.
#include <optional>
#include <string>
#include <vector>

#include "core/base/named.hpp"
#include "core/base/verification.hpp"
#include "core/contour/contour.hpp"
#include "core/plan/coarse_fine/coarse_fine_plan.hpp"

namespace bahnwerk {

class Progress;

enum class StudiedQuantity { stroke, fine_acceleration, fine_velocity, coarse_acceleration, coarse_velocity };
inline constexpr Named<StudiedQuantity> studied_quantities[] = {
    {StudiedQuantity::stroke, "stroke"},
    {StudiedQuantity::fine_acceleration, "fine_acceleration"},
    {StudiedQuantity::fine_velocity, "fine_velocity"},
    {StudiedQuantity::coarse_acceleration, "coarse_acceleration"},
    {StudiedQuantity::coarse_velocity, "coarse_velocity"}};

/// One table that is asked for.
struct StudyRequest {
  StudiedQuantity quantity = StudiedQuantity::stroke;
  /// Values of the first axis, mm, mm/s, mm/s²; other axes scale alike, a stroke is every axis'. None: strokes from
  /// 0.5 to 100 mm, limits from half to twice what they are.
  std::vector<double> values;
};
/// One of each quantity.
std::vector<StudyRequest> usual_studies();

struct StudiedMachine {
  double value = 0;
  std::optional<double> duration;    ///< s; none where nothing verified can be planned
  std::string note;                  ///< why there is none, or which machine's plan it is
  std::optional<Check> failed = {};  ///< the first check that no plan passed, where that is why
};
struct Study {
  StudiedQuantity quantity = StudiedQuantity::stroke;
  std::vector<StudiedMachine> machines;  ///< by ascending value
};
using MachineStudy = std::vector<Study>;

/// Plans the contour again for every machine, all else being equal, with the shortest duration asked for. As many plans
/// as machines. What a machine can do one with more of the same can, too: where its own plan is longer, theirs counts.
/// Throws Stopped.
MachineStudy machine_study(const Contour& contour, const CoarseFineMachine& machine, const ContourPlanning& planning,
                           const RedundancyOptions& options, const std::vector<StudyRequest>& requests,
                           Progress& progress, double from, double to);

/// All as curves over the figure that is changed, in SVG; `duration`: that of the machine as it is.
std::string machine_study_drawing(const MachineStudy& study, double duration);

}  // namespace bahnwerk
