#pragma once
/// The setpoints of a winding machine: its axes, the needle's pose and speed, brake and tension of the wire.
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/motion/axes/axis_path.hpp"
#include "core/motion/interpolation/interpolation.hpp"
#include "core/motion/law/path_motion.hpp"
#include "core/motion/setpoints/motion_setpoints.hpp"

namespace bahnwerk {

/// The forces of the wire, N.
struct WireForces {
  /// Returns the force to which the brake is set for the needle at parameter u of a segment of its path, at the speed
  /// and acceleration of `law`.
  std::function<double(std::size_t segment, double u, const LawState& law)> brake;
  /// Returns the wire's tension at its place in the middle of a time from … to of the motion.
  std::function<double(double from, double to)> tension;
};

/// The columns are those of MotionSetpoints, then j<axis> of every axis, x, y, z (mm), phi, psi (deg) of the needle in
/// the part's frame, s (mm) and v (mm/s) along its path, brake (N), and vx, vy, vz (mm/s), vphi, vpsi (deg/s), the
/// rates of the pose, and tension (N), which is the wire's in the middle of the cycle that ends with the row. Rotary
/// axes are in deg, deg/s …: shown() has the factor of an axis of unit rad.
///
/// With an interpolation, the rows' places are its own, slightly off those of the law; speed, acceleration and jerk
/// along the path are the law's at the row's time.
class NeedleSetpoints final : public MotionSetpoints {
 public:
  struct Options {
    std::size_t cycles = 0;  ///< number of whole cycles that motion and interpolation last
    /// Null: places are the law's, which are those of the exact interpolator.
    std::shared_ptr<const Interpolation> interpolation = nullptr;
    std::optional<PoseFrame> frame = std::nullopt;
  };
  /// `motion` drives `axes`, of which `machine` has the limits.
  NeedleSetpoints(const std::shared_ptr<const PathMotion>& motion, std::shared_ptr<const KinematicAxisPath> axes,
                  const Machine& machine, WireForces wire, Options options);
  std::optional<PoseFrame> pose_frame() const override { return frame_; }
  /// Returns a factor per axis of the machine: 180/π for one of unit rad, else 1.
  static std::vector<double> shown(const Machine& machine);

 private:
  struct Place {
    std::size_t segment = 0;
    double u = 0;
    LawState law;  ///< state of the law; law.s is the needle's place
  };
  void write(Row& row, double* out) const override;
  Place place(Row& row) const;

  std::shared_ptr<const PathMotion> motion_;
  std::shared_ptr<const KinematicAxisPath> axes_;
  std::shared_ptr<const Interpolation> interpolation_;
  std::vector<double> shown_;
  WireForces wire_;
  std::optional<PoseFrame> frame_;
};

}  // namespace bahnwerk
