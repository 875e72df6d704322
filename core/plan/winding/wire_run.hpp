#pragma once
/// The wire along the needle's motion: the speed at which it is drawn, the brake's set force, and the resulting
/// tension.
#include <memory>
#include <vector>

#include "core/base/row_check.hpp"
#include "core/base/setpoint_source.hpp"
#include "core/base/verification.hpp"
#include "core/motion/law/path_motion.hpp"
#include "core/motion/law/time_law.hpp"
#include "core/plan/winding/pose_path.hpp"
#include "core/winding/needle/wire_tension.hpp"
#include "core/winding/path/payout.hpp"

namespace bahnwerk {

/// Extreme values of the wire's quantities over the motion.
struct WireFigures {
  double peak = 0, least = 0;                    ///< N, tension at the wire's place
  double peak_at = 0, least_at = 0;              ///< s
  double constant_peak = 0, constant_least = 0;  ///< N, tension with the brake at pull.force all the time
  double speed = 0, taken_back = 0;              ///< mm/s, largest speeds at which wire is drawn and taken back
  double acceleration = 0;                       ///< mm/s², largest acceleration of the wire
};

/// Immutable and thread-safe.
class WireRun {
 public:
  /// `anchors` has one entry per piece of the path; source() of `tool`'s segments are indices of pieces. The force is
  /// that of `pull`.
  WireRun(std::shared_ptr<const PosePath> tool, std::vector<winding::Anchor> anchors, const winding::Pull& pull,
          const winding::TensionModel& model);

  /// Returns speed and acceleration of the wire while the needle moves by `law` at parameter u of a segment. O(degree),
  /// 0.3 µs.
  winding::Drawing drawing(std::size_t segment, double u, const LawState& law) const;
  /// Returns the brake's set force there, N: the force itself, at no cost, if the model has neither mass nor friction.
  double brake(std::size_t segment, double u, const LawState& law) const {
    return winding::compensating_brake(model_, ideal() ? winding::Drawing{} : drawing(segment, u, law));
  }
  /// Returns the wire's tension in the middle of a time of the motion, N, with the mean acceleration over that time and
  /// the mean of the brake's forces at both ends. While the needle goes to another coil, nothing describes the wire's
  /// acceleration, and it counts as 0. 1.5 µs; nothing if the model has neither mass nor friction.
  double tension(const PathMotion& motion, double from, double to) const;

 private:
  friend class WireRows;
  bool ideal() const { return model_.mass == 0 && model_.friction == 0; }
  winding::FreeWire wire(std::size_t segment, const ToolJet& tool) const;

  std::shared_ptr<const PosePath> tool_;
  std::vector<winding::Anchor> anchors_;
  winding::TensionModel model_;
  double bend_radius_, free_length_;
  std::vector<double> before_;  ///< mm, per segment: offset that makes the wire's length continuous at joints
};

/// Measures the wire in rows of setpoints with the columns x, y, z, phi, psi, s, brake. The drawn length is computed in
/// every row; its speed and acceleration are differences of three rows, means over two cycles. In the middle of every
/// cycle they are means over that cycle from the sampled motion, with the mean of the brake's forces of both rows.
/// These are samples, not enclosures. Means over shorter times would be unbounded: where the wire begins to lie on its
/// bend circle, the derivative of its length has a square root, and its acceleration a pole. Changes of coils are left
/// out, because nothing describes their wire. 2 µs per row.
class WireRows final : public RowCheck {
 public:
  /// All arguments must outlive this object. Throws std::invalid_argument if columns are missing.
  WireRows(const WireRun& wire, const SetpointSource& setpoints, const PathMotion& motion, double permitted);
  ~WireRows() override;
  void row(std::size_t k, const double* row) override;
  std::vector<Check> checks() override;  ///< returns wire_checks()
  const WireFigures& figures() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
  double permitted_;
};

/// Returns `wire pull`, the peak of the tension with the breaking force as its limit if that is known, and `wire
/// slack`, the least tension with the limit 0.
std::vector<Check> wire_checks(const WireFigures& figures, double permitted);

}  // namespace bahnwerk
