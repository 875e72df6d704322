#include "core/verify/verifier.hpp"

#include <algorithm>
#include <utility>

#include "core/verify/law/axis_peaks.hpp"
#include "core/verify/law/law_checks.hpp"

namespace bahnwerk {

Verification verify_motion(const VerifierInput& input, Progress& progress) {
  ProgressScope pulse(progress, "verify", input.progress_from, input.progress_to);
  pulse.report();
  verify::AxisPeaks axes = verify::axis_peaks(input, pulse);
  Verification result;
  result.checks = std::move(axes.checks);
  for (Check& check : verify::law_checks(input, pulse)) result.checks.push_back(std::move(check));
  result.checks.push_back(verify::make_check("arc length", "mm", axes.arc_length));
  result.passed = std::all_of(result.checks.begin(), result.checks.end(), [](const Check& c) { return c.passed; });
  pulse.done(1);
  pulse.report();
  return result;
}

}  // namespace bahnwerk
