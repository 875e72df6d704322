#include "core/plan/winding/link_timer.hpp"

#include <vector>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/motion/jerk/jerk_limited.hpp"
#include "core/plan/winding/pose_path.hpp"

namespace bahnwerk {
namespace {

/// Reports progress at a constant fraction and stops a plan after a number of reports, not of seconds, so that equal
/// pieces always stop equally.
class Effort final : public ProgressSink {
 public:
  struct Spent {};
  Effort(Progress whole, std::size_t most) : whole_(whole), most_(most) {}
  void report(std::string_view, double, std::string_view) override {
    whole_.report("link", share);
    if (++reports_ > most_) throw Spent{};
  }

 private:
  static constexpr double share = 0.05;
  Progress whole_;
  std::size_t most_, reports_ = 0;
};

}  // namespace

double LinkTimer::operator()(std::span<const BezierPiece> pieces) const { return timed(pieces, true); }
double LinkTimer::exact(std::span<const BezierPiece> pieces) const { return timed(pieces, false); }

double LinkTimer::timed(std::span<const BezierPiece> pieces, bool coarse) const {
  try {
    const PosePath tool = pose_path({pieces.begin(), pieces.end()});
    const KinematicAxisPath axes(tool.tool, machine_, tool.orientation);
    const std::size_t n = tool.tool.size();
    std::vector<bool> rests(n + 1, false);
    rests.front() = rests.back() = true;
    const Machine machine{machine_.axes(), cycle_time_};
    const PathTask task{axes, machine, std::vector<double>(n, unlimited), rests};
    JerkLimitedOptions options;
    options.path = along_;
    if (coarse) options.angle = 0.1, options.gap = 1e-3, options.max_divisions = 0, options.max_rounds = 8;
    Effort effort(progress_, coarse ? 1500 : static_cast<std::size_t>(-1));
    return plan_jerk_limited(task, options, effort).law.duration();
  } catch (const UnreachablePose&) {
    return unlimited;
  } catch (const InvalidInput&) {  // a tangent that vanishes at a joint
    return unlimited;
  } catch (const Effort::Spent&) {
    return unlimited;
  }
}

}  // namespace bahnwerk
