#include "core/verify/probe/probe_setpoint_checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/base/read_rows.hpp"
#include "core/verify/rounding.hpp"
#include "core/verify/worst.hpp"

namespace bahnwerk {
namespace {

using verify::rounding;
using verify::Strained;

class ProbeRows final : public RowCheck {
 public:
  ProbeRows(const ProbeToVerify& in, const SetpointSource& setpoints) : in_(in), setpoints_(setpoints) {
    for (const AxisLimits& axis : in.problem.machine.axes)
      for (const char* prefix : {"", "v"}) column_.push_back(find(prefix + axis.name));
    deviation_column_ = find("deviation");
    speed_column_ = find("v");
    for (const Vec& p : in.problem.given) largest_ = std::max({largest_, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (complete_) return;
    for (Strained* each : {&deviation_, &speed_}) each->raise(std::nan(""), 0, 0);
  }

  bool reads() const override { return complete_; }

  void row(std::size_t k, const double* row) override {
    const Motion& motion = in_.motion;
    const double t = std::min(motion.duration(), static_cast<double>(k) * in_.problem.machine.cycle_time);
    const bool last = k + 1 == setpoints_.count();
    while (edge_ + 1 < in_.problem.edges() && (in_.times[edge_ + 1] <= t || last)) ++edge_;
    Vec position, velocity;
    for (std::size_t axis = 0; axis < in_.problem.dimension(); ++axis) {
      position[axis] = row[column_[2 * axis]];
      velocity[axis] = row[column_[2 * axis + 1]];
    }
    const double from = distance_from_edge(position, in_.problem.points[edge_], in_.problem.points[edge_ + 1]);
    deviation_.raise(std::abs(row[deviation_column_] - from), 2 * rounding * largest_, t);
    speed_.raise(std::abs(row[speed_column_] - norm(velocity)), rounding * norm(velocity), t);
  }

  std::vector<Check> checks() override {
    using verify::make_check;
    return {make_check(named(CheckGroup::setpoints, "setpoints deviation", "mm"), deviation_),
            make_check(named(CheckGroup::setpoints, "setpoints speed", "mm/s"), speed_)};
  }

 private:
  std::size_t find(const std::string& name) {
    const std::size_t at = column_index(setpoints_.columns(), name);
    complete_ = complete_ && at < setpoints_.columns().size();
    return at;
  }

  ProbeToVerify in_;
  const SetpointSource& setpoints_;
  std::vector<std::size_t> column_;  // columns of each axis: position, velocity
  std::size_t deviation_column_ = 0, speed_column_ = 0;
  bool complete_ = true;
  double largest_ = 0;
  std::size_t edge_ = 0;
  Strained deviation_, speed_;
};

}  // namespace

std::unique_ptr<RowCheck> probe_row_check(const ProbeToVerify& input, const SetpointSource& setpoints) {
  return std::make_unique<ProbeRows>(input, setpoints);
}

}  // namespace bahnwerk
