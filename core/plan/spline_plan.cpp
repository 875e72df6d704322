#include "core/plan/spline_plan.hpp"

#include <algorithm>
#include <utility>

#include "core/motion/setpoints/motion_setpoints.hpp"
#include "core/verify/motion/motion_checks.hpp"
#include "core/verify/setpoints/motion_setpoint_checks.hpp"

namespace bahnwerk {
namespace {

constexpr double largest_excess = 1e-4;  // relative excess over a limit that counts as rounding
constexpr double verified = 0.5;         // part of the progress at which verification ends

class SplineProblem final : public MotionProblem {
 public:
  SplineProblem(const SplinePlanning& planning, Progress progress) : planning_(planning), progress_(progress) {}

  void plan() override { motion_ = std::make_shared<const SplineMotion>(planning_.pieces); }
  bool plan_otherwise() override { return false; }
  double duration() const override { return stretch_ * planning_.pieces.back().end; }
  void slow(double factor) override {
    motion_ = std::make_shared<const SplineMotion>(slowed(planning_.pieces, factor_ = factor * stretch_));
  }
  Verification verify() override {
    Verification verdict{true, {}, {}};
    MotionToVerify input{*motion_, planning_.machine.axes, planning_.continuous};
    verdict.add(motion_checks(input, progress_.part(0, verified)));
    return verdict;
  }
  bool correct(const Verification& verdict) override {
    double excess = 1;
    for (const Check& check : verdict.checks) {
      if (check.passed) continue;
      if (!falls_with_speed(check) || !(check.value < check.limit * (1 + largest_excess))) return false;
      excess = std::max(excess, check.value / check.limit);
    }
    stretch_ = factor_ * excess * (1 + 1e-12);
    return excess > 1;
  }
  std::shared_ptr<const Motion> motion() override { return motion_; }
  std::unique_ptr<SetpointSource> setpoints(std::size_t cycles) override {
    return std::make_unique<MotionSetpoints>(motion_, planning_.machine, cycles, planning_.columns);
  }
  Rows row_checks(const SetpointSource& setpoints, const Verification&) override {
    Rows rows{{}, 1};
    rows.checks.push_back(motion_row_check({*motion_, planning_.machine, setpoints}));
    return rows;
  }
  std::vector<Check> more_checks() override {
    return planning_.more_checks ? planning_.more_checks(*motion_) : std::vector<Check>{};
  }
  Bound bound() override { return planning_.bound; }

 private:
  const SplinePlanning& planning_;
  Progress progress_;
  std::shared_ptr<const SplineMotion> motion_;
  double stretch_ = 1, factor_ = 1;  // factors of the duration: of corrections; of those and whole cycles
};

}  // namespace

MotionPlan plan_spline(const SplinePlanning& planning, Progress progress) {
  SplineProblem problem(planning, progress);
  PipelineOptions options{planning.machine.cycle_time, planning.max_setpoints};
  return plan_motion(problem, options, progress.part(verified, 1));
}

}  // namespace bahnwerk
