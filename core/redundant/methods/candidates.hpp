#pragma once
/// The candidates for the plan of a contour on coarse and fine axes: one list of what is planned, in which order, and
/// when that is worth it.
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.hpp"
#include "core/base/verification.hpp"
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

/// Whose plan a candidate is: the method's that was asked for, after reparametrisation and before; the joint planner's
/// where another method was asked for; that of the coarse axes alone.
enum class CandidatePlanner { asked_timed_again, asked, joint, coarse_axes };

/// Works through the list in candidates.cpp. Candidates of one step compete: the quickest plan counts. A step is
/// entered if no plan of the step before holds all limits. So the method that was asked for gives way only if it finds
/// no motion, if its plan fails verification, or if it does not fit the machine; `joint`, the quickest method, has the
/// coarse axes alone among its own candidates.
class PlanChoice {
 public:
  /// The first plan takes `progress`; those after it stay at its end.
  PlanChoice(RedundancyTask task, const RedundancyOptions& options, Progress progress);

  /// Plans the candidates of the next step that were not rejected, until there is a plan; returns false if there is
  /// none. Throws what the planners throw: InvalidInput, Stopped.
  bool next();
  /// Returns the plan that next() found; it may be moved from.
  RedundancyResult& plan() { return chosen_->result; }
  /// Excludes the plan at hand, which lasts `duration` s, because it failed verification.
  void reject(double duration, const Verification& verdict);
  /// Returns the record of the list: the plans that gave way, in turn. The plan at hand lasts `duration` s.
  std::vector<GaveWay> gave_way(double duration) const;
  /// Returns a sentence with both durations if the coarse axes alone are quicker than the plan at hand, which lasts
  /// `duration` s, of a method other than joint. Plans without limited jerk only.
  std::optional<std::string> quicker_coarse_axes(double duration);
  /// Throws InfeasibleAt if the path leaves the range of a coarse axis, otherwise Infeasible, as no candidate has a
  /// plan.
  [[noreturn]] void refuse() const;
  /// Throws InfeasibleAt if the path leaves the range of a coarse axis.
  void refuse_beyond_range() const;

 private:
  struct Chosen {
    std::size_t candidate;
    RedundancyResult result;
  };

  bool plan_step(int step);
  Expected<RedundancyResult, NoPlan> planned(CandidatePlanner planner, const RedundancyTask& task);
  const char* name(CandidatePlanner planner) const;
  void explain();

  RedundancyTask task_;
  RedundancyOptions options_;  // with the method that fits the machine
  Progress progress_;
  int step_ = 0;
  std::vector<bool> rejected_;
  std::optional<Chosen> chosen_;
  std::optional<NoPlan> why_not_;  // of the first candidate without a plan
  std::optional<double> split_;    // s, quickest plan of the step in which fine axes take part
  std::vector<GaveWay> gave_way_;  // `used` of a row is the planner of the next one, or of the plan at hand
  std::vector<std::string> notes_;
};

/// Returns the failed check whose value is the largest multiple of its limit; none if all passed. A value that is not a
/// number, or whose limit is 0, counts as more than any other.
std::optional<Check> failed_by_most(const Verification& verification);

}  // namespace bahnwerk
