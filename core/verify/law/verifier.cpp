#include "core/verify/law/verifier.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "core/verify/law/axis_peaks.hpp"
#include "core/verify/law/law_checks.hpp"

namespace bahnwerk {

std::vector<double> feeds_to_hold(const Contour& driven, const Contour& given) {
  std::vector<double> feed(driven.path.size(), 0.0);
  for (std::size_t b = 0; b < std::min(given.blocks.size(), driven.blocks.size()); ++b)
    for (std::size_t i = driven.blocks[b].first; i < std::min(driven.blocks[b].last, feed.size()); ++i)
      feed[i] = given.blocks[b].feed;
  return feed;
}

Verification verify_motion(const ContourVerifierInput& input, Progress progress) {
  const CartesianAxisPath path(input.contour.path, input.machine.axes.size());
  return verify_motion(
      {path, input.machine, input.law,
       feeds_to_hold(input.contour, input.given == nullptr ? input.contour : *input.given), input.contour.rest_places(),
       input.corner_angle, input.order, input.path, input.position_tolerance},
      progress);
}

Verification verify_motion(const VerifierInput& input, Progress progress) {
  if (input.machine.axes.size() != input.path.axes())
    throw std::invalid_argument("the verifier needs limits of as many axes as the path has");
  if (input.feeds.size() != input.path.size() || input.rests.size() != input.path.size() + 1)
    throw std::invalid_argument("the verifier needs a feed per segment and a rest per place between them");
  ProgressScope stage_progress(progress, "verify");
  stage_progress.report();
  verify::AxisPeaks axes = verify::axis_peaks(input, stage_progress);
  Verification result;
  result.checks = std::move(axes.checks);
  result.too_fast = std::move(axes.too_fast);
  for (Check& check : verify::law_checks(input, stage_progress)) result.checks.push_back(std::move(check));
  result.checks.push_back(verify::make_check({{"arc length", CheckGroup::geometry}}, axes.arc_length));
  result.passed = std::all_of(result.checks.begin(), result.checks.end(), [](const Check& c) { return c.passed; });
  stage_progress.done(1);
  stage_progress.report();
  return result;
}

}  // namespace bahnwerk
