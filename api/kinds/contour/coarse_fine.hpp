#pragma once
/// Kind "contour" on machines with coarse and fine axes: reading its part of the spec, and writing its part of the
/// result.
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/base/errors.hpp"
#include "core/contour/contour.hpp"
#include "core/plan/coarse_fine/coarse_fine_plan.hpp"
#include "core/plan/coarse_fine/machine_study.hpp"
#include "core/redundant/coarse_fine.hpp"
#include "core/redundant/redundancy.hpp"

namespace bahnwerk::api {
struct KindReport;  // api/kinds/kind_frame.hpp
}

namespace bahnwerk::api::contour {

/// Approximate limit of the cells of a job's coarse motion.
inline constexpr double max_cells = 2'000'000;

/// Tells whether the machine of a spec has coarse and fine axes.
bool coarse_fine(const nlohmann::json& spec);

/// Reads the machine of a spec that passed its schema. Throws InvalidInput, with places relative to the spec, if coarse
/// and fine axes differ or only some axes have limited jerk.
CoarseFineMachine coarse_fine_machine(const nlohmann::json& spec);
/// Reads the options of the redundancy method.
RedundancyOptions redundancy(const nlohmann::json& spec, const ContourPlanning& planning);

/// Adds faults of the options: methods and options that do not exist, or do not apply to such machines.
void check_redundancy(const nlohmann::json& spec, const CoarseFineMachine& machine, const ContourPlanning& planning,
                      std::vector<InputFault>& faults);
/// Returns the least stroke, mm, with which a motion of at least `shortest` s has no more than max_cells cells.
double least_stroke(const CoarseFineMachine& machine, double shortest);
/// Returns a note for each fine axis that stands still because its stroke is below `least`, in this motion or
/// in any.
std::vector<std::string> unresolved_strokes(const CoarseFineMachine& machine, double least);

/// Returns a sentence for each option of the spec that the method does not use.
std::vector<std::string> unused_options(const nlohmann::json& spec);

/// Adds the figures of the summary and details.redundancy.
void report(const CoarseFinePlan& plan, const CoarseFineMachine& machine, RedundancyMethod method, bool program,
            KindReport& out);

/// Returns the tables that planning.machine_study requests; empty: no study.
std::vector<StudyRequest> study_requests(const nlohmann::json& spec);

/// Adds details.redundancy.prefilter, the filter that removes the overshoot of fine axes of drives with these lags.
void report_prefilter(const RedundancyOptions& options, double cycle_time, KindReport& out);

/// Adds faults of places of the tool that a coarse axis' range and the stroke cannot reach.
void check_range(const CoarseFineMachine& machine, const Contour& contour, std::vector<InputFault>& faults);

/// Adds details.redundancy.machine_study; `duration` is that of the given machine, s.
void report(const MachineStudy& study, double duration, KindReport& out);

}  // namespace bahnwerk::api::contour
