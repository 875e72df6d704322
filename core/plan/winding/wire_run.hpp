#pragma once
/// The wire along the needle's motion: how fast it is drawn off, the brake's set-force, and the tension that results.
#include <memory>
#include <vector>

#include "core/base/row_check.hpp"
#include "core/base/setpoint_source.hpp"
#include "core/base/verification.hpp"
#include "core/motion/law/path_motion.hpp"
#include "core/motion/law/time_law.hpp"
#include "core/plan/winding/pose_path.hpp"
#include "core/winding/needle/payout.hpp"
#include "core/winding/needle/wire_tension.hpp"

namespace bahnwerk {

/// What becomes of the wire, at setpoints and between.
struct WireFigures {
  double peak = 0, least = 0;                    ///< tension where the wire comes to lie, N
  double peak_at = 0, least_at = 0;              ///< s
  double constant_peak = 0, constant_least = 0;  ///< the same with the brake at pull.force all the time, N
  double speed = 0, taken_back = 0;              ///< largest speed at which wire is drawn off, and taken back, mm/s
  double acceleration = 0;                       ///< largest one of the wire, mm/s²
};

/// Immutable and thread-safe.
class WireRun {
 public:
  /// `anchors`: one per piece of the path, which source() of `tool`'s segments are; the force is that of `pull`.
  WireRun(std::shared_ptr<const PosePath> tool, std::vector<winding::Anchor> anchors, const winding::Pull& pull,
          const winding::TensionModel& model);

  /// Returns how the wire is drawn while the needle moves by `law` at parameter u of a segment. O(degree), 0.3 µs.
  winding::Drawing drawing(std::size_t segment, double u, const LawState& law) const;
  /// Returns the brake's set-force there, N. Where nothing moves with the wire and nothing rubs it is the force, at no
  /// cost.
  double brake(std::size_t segment, double u, const LawState& law) const {
    const bool ideal = model_.mass == 0 && model_.friction == 0;
    return winding::compensating_brake(model_, ideal ? winding::Drawing{} : drawing(segment, u, law));
  }

 private:
  friend class WireRows;
  winding::FreeWire wire(std::size_t segment, const ToolJet& tool) const;

  std::shared_ptr<const PosePath> tool_;
  std::vector<winding::Anchor> anchors_;
  winding::TensionModel model_;
  double bend_radius_, free_length_;
  std::vector<double> before_;  ///< per segment: what makes the wire's length continuous where segments meet, mm
};

/// Measures the wire in rows as they are served, with columns x, y, z, phi, psi, s, brake. The length that is drawn is
/// measured in every row; its speed and acceleration are differences of three rows, the mean over two cycles. In the
/// middle of every cycle, from the motion that rows are samples of, they are the mean over that cycle, with the mean of
/// the brake's forces at both rows: sampling, no enclosure. Shorter means would grow without bound: where the wire
/// begins to lie on its bend circle, ds of its length has a square root, and its acceleration a pole. Nothing is told
/// about a change of coils, whose wire nobody describes. 2 µs per row.
class WireRows final : public RowCheck {
 public:
  /// What it is given has to live as long as it does. Throws std::invalid_argument for columns that are missing.
  WireRows(const WireRun& wire, const SetpointSource& setpoints, const PathMotion& motion, double permitted);
  ~WireRows() override;
  void row(std::size_t k, const double* row) override;
  std::vector<Check> checks() override;  ///< wire_checks()
  const WireFigures& figures() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
  double permitted_;
};

/// `wire pull`: the peak of the tension against what the wire bears, where that is known; `wire slack`: the least
/// tension, no less than 0.
std::vector<Check> wire_checks(const WireFigures& figures, double permitted);

}  // namespace bahnwerk
