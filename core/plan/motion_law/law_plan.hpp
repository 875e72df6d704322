#pragma once
/// A motion law from problem to verified table.
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.hpp"
#include "core/base/setpoint_source.hpp"
#include "core/base/verification.hpp"
#include "core/cam/problem.hpp"
#include "core/cam/solution.hpp"

namespace bahnwerk {

struct LawToVerify;

/// Length of a step of the table.
struct LawSampling {
  std::optional<double> cycle_time;    ///< s; divides the cycle to 1e-9
  std::optional<std::size_t> samples;  ///< steps per cycle
};

struct LawPlan {
  cam::MotionLawProblem problem;  ///< the problem with the cycle's duration
  cam::LawSolution solution;
  double lower = 0;                            ///< lower bound of J: no law has less
  std::string basis;                           ///< method that proves `lower`, for people
  std::optional<cam::LawSolution> source_law;  ///< `optimal`: that of `active_set`, where there is one
  std::optional<cam::CamLaw> classical;        ///< a classical law through the same states at the points
  std::shared_ptr<const SetpointSource> table;
  Verification verification;
};

/// Steps per cycle; 0: the cycle time does not divide the cycle.
std::size_t table_steps(const LawSampling& sampling, double cycle_duration);

/// Returns the law as it is published, for the verifiers.
LawToVerify published(const LawPlan& plan);

/// Throws InvalidInput and Infeasible as the methods do. Deterministic.
LawPlan plan_motion_law(const cam::MotionLawProblem& problem, const LawSampling& sampling, Progress progress);

}  // namespace bahnwerk
