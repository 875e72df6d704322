#pragma once
/// A study of machines: the duration of a contour with other coarse and fine axes, for buying or tuning a machine.
#include <optional>
#include <string>
#include <vector>

#include "core/base/named.hpp"
#include "core/base/progress.hpp"
#include "core/base/verification.hpp"
#include "core/contour/contour.hpp"
#include "core/plan/coarse_fine/coarse_fine_plan.hpp"

namespace bahnwerk {

enum class StudiedQuantity { stroke, fine_acceleration, fine_velocity, coarse_acceleration, coarse_velocity };
inline constexpr Named<StudiedQuantity> studied_quantities[] = {
    {StudiedQuantity::stroke, "stroke"},
    {StudiedQuantity::fine_acceleration, "fine_acceleration"},
    {StudiedQuantity::fine_velocity, "fine_velocity"},
    {StudiedQuantity::coarse_acceleration, "coarse_acceleration"},
    {StudiedQuantity::coarse_velocity, "coarse_velocity"}};

/// One requested table.
struct StudyRequest {
  StudiedQuantity quantity = StudiedQuantity::stroke;
  /// Values of the first axis, mm, mm/s or mm/s²; other axes are scaled by the same factor, but strokes are equal for
  /// all axes. Empty: strokes from 0.5 to 100 mm, limits from half to twice the present ones.
  std::vector<double> values;
};
/// Returns one request per quantity.
std::vector<StudyRequest> usual_studies();

struct StudiedMachine {
  double value = 0;
  std::optional<double> duration;    ///< s; none if no verified plan exists
  std::string note;                  ///< the reason why there is none, or the machine whose plan it is
  std::optional<Check> failed = {};  ///< the first check that no plan passed, if that is the reason
};
struct Study {
  StudiedQuantity quantity = StudiedQuantity::stroke;
  std::vector<StudiedMachine> machines;  ///< in ascending order of values
};
using MachineStudy = std::vector<Study>;

/// Plans the contour for every machine, all else being equal, for the shortest duration: one plan per machine. A plan
/// for smaller values also is one for larger values; where a machine's own plan takes longer, that one is reported.
/// Throws Stopped.
MachineStudy machine_study(const Contour& contour, const CoarseFineMachine& machine, const ContourPlanning& planning,
                           const RedundancyOptions& options, const std::vector<StudyRequest>& requests,
                           Progress progress);

/// Returns an SVG with the duration over the changed quantity, one curve per quantity; `duration` is that of the given
/// machine, s.
std::string machine_study_drawing(const MachineStudy& study, double duration);

}  // namespace bahnwerk
