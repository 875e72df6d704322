// J of a law.
#include <algorithm>
#include <cmath>

#include "core/cam/bernstein.hpp"
#include "core/cam/cam_law.hpp"

namespace bahnwerk::cam {
namespace {

/// Sign changes of s^(order) inside a section: values whose size is below 1e-9 of the peak have no sign.
std::size_t sign_changes(const CamLaw& law, int order, std::size_t section, double peak) {
  constexpr int samples = 64;
  std::size_t changes = 0;
  double last = 0;
  for (std::size_t i = 0; i < law.pieces(); ++i) {
    if (law.piece(i).section != section) continue;
    const std::vector<double> b = law.derivative(i, order);
    for (int k = 0; k <= samples; ++k) {
      const double value = bernstein_value(b, static_cast<double>(k) / samples);
      if (std::abs(value) < 1e-9 * peak) continue;
      if (last != 0 && (value > 0) != (last > 0)) ++changes;
      last = value;
    }
  }
  return changes;
}

}  // namespace

std::array<double, limited_orders> effective_weights(const MotionLawProblem& problem) {
  auto weight = problem.objective.weight;
  weight[0] = 0;
  if (!problem.objective.normalised) return weight;
  double factor = 1 / problem.points_stroke();
  for (std::size_t r = 1; r < weight.size(); ++r) weight[r] *= factor *= *problem.cycle_duration;
  return weight;
}

LawValue evaluate_objective(const MotionLawProblem& problem, const CamLaw& law) {
  LawValue value;
  const auto weight = effective_weights(problem);
  const PeakGroups groups = problem.peak_groups();
  for (int r = 0; r < limited_orders; ++r) {
    const auto i = static_cast<std::size_t>(r);
    value.peaks[i] = law.peak(r);
    if (groups.count() == 1) {
      value.objective += weight[i] * groups.weight[0] * value.peaks[i].value;
      continue;
    }
    std::vector<double> peaks(groups.count());
    for (std::size_t p = 0; r > 0 && p < law.pieces(); ++p) {
      double& peak = peaks[groups.of_section[law.piece(p).section]];
      peak = std::max(peak, law.peak(r, p).value);
    }
    for (std::size_t g = 0; g < peaks.size(); ++g) value.objective += weight[i] * groups.weight[g] * peaks[g];
  }
  if (problem.objective.zero_crossing_penalty > 0) {
    for (std::size_t section = 0; section < problem.sections(); ++section)
      for (const int r : {1, 2})
        value.zero_crossings += sign_changes(law, r, section, value.peaks[static_cast<std::size_t>(r)].value);
    value.objective += problem.objective.zero_crossing_penalty * static_cast<double>(value.zero_crossings);
  }
  return value;
}

}  // namespace bahnwerk::cam
