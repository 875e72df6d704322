#include "core/plan/motion_law/law_plan.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/progress.hpp"
#include "core/cam/classical/classical_sections.hpp"
#include "core/cam/law_table.hpp"
#include "core/plan/motion_law/planned_law.hpp"
#include "core/verify/cam/law_verifier.hpp"

namespace bahnwerk {

LawToVerify published(const LawPlan& plan) {
  LawToVerify out;
  const cam::CamLaw& law = plan.solution.law;
  out.breaks = law.breaks();
  for (std::size_t i = 0; i < law.pieces(); ++i) {
    out.sections.push_back(law.piece(i).section);
    out.bernstein.push_back(law.piece(i).bernstein);
  }
  out.at = plan.solution.at;
  out.cycle_duration = plan.solution.cycle_duration;
  out.objective = plan.solution.value.objective;
  for (const auto& peak : plan.solution.value.peaks) out.peaks.push_back(peak.value);
  out.bound = plan.lower;
  for (int r = 0; r < cam::limited_orders; ++r) out.rms.push_back(law.rms(r));
  return out;
}

namespace {

/// Returns the law that a textbook takes: modified sines between the states of the law at its points, velocities kept.
cam::CamLaw classical_law(const cam::MotionLawProblem& problem, const cam::LawSolution& solution) {
  std::vector<double> breaks;
  std::vector<cam::LawPiece> pieces;
  const auto times = cam::section_times(problem, solution.at);
  const cam::CamLaw& law = solution.law;
  for (std::size_t s = 0; s < problem.sections(); ++s) {
    cam::SectionEnds ends;
    std::size_t piece = 0;
    for (int r = 0; r < 2; ++r) {
      ends.from[r] = law.evaluate(times[s], r, piece);
      const bool last = s + 1 == problem.sections() && !problem.periodic;
      ends.to[r] = last ? law.in_piece(law.pieces() - 1, 1, r) : law.evaluate(times[s + 1], r, piece);
    }
    const auto given = cam::classical_section(cam::ClassicalLaw::modified_sine, {}, times[s], times[s + 1], ends);
    for (std::size_t i = 0; i < given.bernstein.size(); ++i) {
      breaks.push_back(given.breaks[i]);
      pieces.push_back({s, given.bernstein[i]});
    }
  }
  breaks.push_back(times.back());
  return {std::move(breaks), std::move(pieces), problem.periodic, problem.travel};
}

}  // namespace

std::size_t table_steps(const LawSampling& sampling, double cycle_duration) {
  constexpr std::size_t usual = 720;
  if (sampling.samples) return *sampling.samples;
  if (!sampling.cycle_time) return usual;
  const double steps = cycle_duration / *sampling.cycle_time, whole = std::round(steps);
  return whole >= 1 && std::abs(steps - whole) <= 1e-9 * whole ? static_cast<std::size_t>(whole) : 0;
}

LawPlan plan_motion_law(const cam::MotionLawProblem& problem, const LawSampling& sampling, Progress progress) {
  LawPlan plan;
  plan.problem = problem;
  {
    const Progress part = progress.part(0, 0.85).named("law");
    PlannedLaw found = plan_law(problem, part);
    plan.solution = std::move(found.solution);
    plan.lower = found.lower;
    plan.basis = std::move(found.basis);
    plan.source_law = std::move(found.source);
  }
  plan.problem.cycle_duration = plan.solution.cycle_duration;
  plan.classical = classical_law(plan.problem, plan.solution);
  plan.table = std::make_shared<cam::LawTable>(plan.solution.law, plan.problem, plan.solution.cycle_duration,
                                               table_steps(sampling, plan.solution.cycle_duration));
  plan.verification = verify_motion_law(plan.problem, published(plan), *plan.table, progress);
  return plan;
}

}  // namespace bahnwerk
