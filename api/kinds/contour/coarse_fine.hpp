#pragma once
/// Contours on machines with coarse and fine axes: what the spec of kind "contour" says of them, and what its result
/// does.
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
struct KindReport;  // api/kind_frame.hpp
}

namespace bahnwerk::api::contour {

/// Cells of the coarse motion's grid that a job may have, about.
inline constexpr double max_cells = 2'000'000;

/// Whether the machine of a spec has coarse and fine axes.
bool coarse_fine(const nlohmann::json& spec);

/// The readers take a spec that passed its schema. Throws InvalidInput, with places relative to the spec, where coarse
/// and fine axes are not the same, and where jerk is limited of some of them only.
CoarseFineMachine coarse_fine_machine(const nlohmann::json& spec);
RedundancyOptions redundancy(const nlohmann::json& spec, const ContourPlanning& planning);

/// Faults of what the spec asks for: a method that is not built, what it does not know, what such machines do not have.
void check_redundancy(const nlohmann::json& spec, const CoarseFineMachine& machine, const ContourPlanning& planning,
                      std::vector<InputFault>& faults);
/// Returns the least stroke, mm, that a motion of at least `shortest` s is planned with: with less its grid would have
/// more than max_cells.
double least_stroke(const CoarseFineMachine& machine, double shortest);
/// Returns a note for each fine axis whose stroke is less than that, but not as little as never counts.
std::vector<std::string> unresolved_strokes(const CoarseFineMachine& machine, double least);

/// What of the spec the method does not look at, as sentences.
std::vector<std::string> unused_options(const nlohmann::json& spec);

/// Adds what the result tells of coarse and fine axes: figures of the summary, details.redundancy.
void report(const CoarseFinePlan& plan, const CoarseFineMachine& machine, RedundancyMethod method, bool program,
            KindReport& out);

/// The tables that planning.machine_study asks for; none: no study.
std::vector<StudyRequest> study_requests(const nlohmann::json& spec);

/// Adds details.redundancy.prefilter: what makes the fine axes of drives with these lags free of overshoot.
void report_prefilter(const RedundancyOptions& options, double cycle_time, KindReport& out);

/// Faults of where the tool goes: beyond what a coarse axis' range and the stroke reach.
void check_range(const CoarseFineMachine& machine, const Contour& contour, std::vector<InputFault>& faults);

/// Adds details.redundancy.machine_study; `duration`: that of the machine as it is.
void report(const MachineStudy& study, double duration, KindReport& out);

}  // namespace bahnwerk::api::contour
