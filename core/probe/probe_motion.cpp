#include "core/probe/probe_motion.hpp"

#include <algorithm>
#include <utility>

namespace bahnwerk {

ProbeMotion slowed(const ProbeMotion& motion, double factor) {
  return slowed(motion, factor, factor * motion.duration());
}

ProbeMotion slowed(const ProbeMotion& motion, double factor, double duration, ProgressScope* progress) {
  const SplineMotion& spline = *motion.motion;
  std::vector<SplineMotion::Piece> pieces(spline.pieces());
  ProbeMotion out;
  TimeSum time;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const double planned = motion.durations.empty() ? spline.end(i) - spline.begin(i) : motion.durations[i];
    out.durations.push_back(factor * planned);
    time.add(factor * planned);
    pieces[i].end = i + 1 < pieces.size() ? time.value() : duration;
    pieces[i].axes.resize(spline.axes());
    if (progress) progress->work(4);
    for (std::size_t k = 0; k < spline.axes(); ++k) {
      Polynomial& p = pieces[i].axes[k];
      spline.polynomial(i, k, p);
      double power = 1;
      for (double& c : p) c /= power, power *= factor;
    }
  }
  for (const double t : motion.times) out.times.push_back(std::min(duration, factor * t));
  if (!out.times.empty()) out.times.back() = duration;
  for (ProbePhase phase : motion.phases) {
    phase.begin = std::min(duration, factor * phase.begin);
    phase.end = std::min(duration, factor * phase.end);
    out.phases.push_back(phase);
  }
  out.motion = std::make_shared<const SplineMotion>(std::move(pieces));
  return out;
}

}  // namespace bahnwerk
