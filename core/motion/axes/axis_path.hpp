#pragma once
/// The positions q(s) of N axes over the arc length s of the tool's path, with q′, q″, q‴: what planners, verifier and
/// bound look at. Limits apply to axes, never to "x".
///
/// An axis path has the segments of the tool's path; inside each q is smooth, at the joints between them one-sided
/// derivatives may differ. Segments tell places (arc length s, parameter u, panels of a difficult curve, cusps); what
/// the axes do there is asked of the axis path, by segment and parameter.
#include <cstddef>
#include <memory>
#include <utility>

#include "core/base/borrowed.hpp"
#include "core/base/progress_scope.hpp"
#include "core/geometry/path/path.hpp"
#include "core/machine/axis_jet.hpp"
#include "core/machine/kinematics.hpp"
#include "core/motion/axes/axis_turns.hpp"
#include "core/motion/axes/orientation.hpp"
#include "core/motion/axes/pose_discs.hpp"

namespace bahnwerk {

/// Immutable and thread-safe.
class AxisPath {
 public:
  virtual ~AxisPath() = default;
  AxisPath(const AxisPath&) = delete;
  AxisPath& operator=(const AxisPath&) = delete;

  std::size_t axes() const { return axes_; }  ///< 1 … max_axes
  /// The axes are the coordinates of the tool: |q′| = 1, q″ ⟂ q′.
  bool cartesian() const { return cartesian_; }

  std::size_t size() const { return tool_.size(); }
  const Segment& operator[](std::size_t i) const { return tool_[i]; }
  double length() const { return tool_.length(); }
  const Path& tool() const { return tool_; }

  /// Whether q is linear in s over the whole segment: a single value of q′ describes it.
  virtual bool linear(std::size_t segment) const = 0;
  /// Axes at a parameter of a segment; derivatives by s, one-sided at its ends. Throws UnreachablePose.
  virtual AxisJet at_parameter(std::size_t segment, double u) const = 0;
  /// The same at up to 16 ascending parameters: rows of d1, d2, d3 per axis, and s from the begin of the segment.
  /// `planar` tells that the third row was not written and is 0.
  virtual void at_parameters(std::size_t segment, PathBatch& batch) const = 0;
  /// Of the map from the tool's pose to the axes, for poses within `radius` mm of that at `u` (MapBounds tells how
  /// poses are measured).
  virtual MapBounds map_bounds(std::size_t segment, double u, double radius) const = 0;
  /// Encloses q′, q″, q‴ by s, for all complex parameters within `radius` of u. False: not known; of smaller stretches
  /// it may be, or map_bounds() may tell.
  virtual bool enclose(std::size_t segment, double u, double radius, AxisDiscs& axes) const {
    (void)segment, (void)u, (void)radius, (void)axes;
    return false;
  }
  /// How far the pose can move from that at `u` by the tool's angles alone, mm, for complex parameters within `radius`
  /// of u; infinite where that is not known, 0 where the angles stand still or do not count.
  virtual double pose_turn(std::size_t segment, double u, double radius) const {
    (void)segment, (void)u, (void)radius;
    return 0;
  }
  /// Axes at a place of a segment, s ∈ [s0, s1].
  virtual AxisJet at(std::size_t segment, double s) const { return at_parameter(segment, tool_[segment].parameter(s)); }
  /// The same of every axis alone, without what would stand for axes that the machine has not: setting those takes
  /// longer than a straight line does. Writes q, q′, q″, q‴, axes() numbers of each, one after the other.
  virtual void write_at(std::size_t segment, double s, double* out) const;

 protected:
  /// Shares the tool's path.
  AxisPath(std::shared_ptr<const Path> tool, std::size_t axes, bool cartesian)
      : shared_(std::move(tool)), tool_(*shared_), axes_(axes), cartesian_(cartesian) {}
  const std::shared_ptr<const Path>& shared_tool() const { return shared_; }
  /// Row i of d1, d2, d3 of every axis.
  void write_row(PathBatch& batch, std::size_t i, const AxisJet& q) const;
  /// map_bounds() of axes that do not follow from the pose alone: only tells that every axis can move.
  MapBounds every_axis_moves() const;

 private:
  std::shared_ptr<const Path> shared_;
  const Path& tool_;
  std::size_t axes_;
  bool cartesian_;
};

/// The largest |q′| of each axis at six places of every panel; 0 of an axis that stands still but for rounding: below
/// 1e-12 of what the map lets it move. O(panels); tells `scope`, if any.
AxisArray largest_rates(const AxisPath& path, ProgressScope* scope = nullptr);

/// q = the tool's path itself, of which the first `axes` ≤ 3 coordinates count; the third is `height` above the path's.
/// Costs no more than the path.
class CartesianAxisPath final : public AxisPath {
 public:
  CartesianAxisPath(std::shared_ptr<const Path> tool, std::size_t axes, double height = 0);
  /// `tool` has to outlive it.
  CartesianAxisPath(const Path& tool, std::size_t axes, double height = 0)
      : CartesianAxisPath(borrowed(tool), axes, height) {}
  bool linear(std::size_t segment) const override { return tool()[segment].straight(); }
  AxisJet at_parameter(std::size_t segment, double u) const override {
    return axes_at(tool()[segment].at_parameter(u));
  }
  void at_parameters(std::size_t segment, PathBatch& batch) const override { tool()[segment].at_parameters(batch); }
  AxisJet at(std::size_t segment, double s) const override { return axes_at(tool()[segment].at(s)); }
  void write_at(std::size_t segment, double s, double* out) const override;
  MapBounds map_bounds(std::size_t segment, double u, double radius) const override;

 private:
  AxisJet axes_at(const PathPoint& p) const;

  double height_;
};

/// q = inverse(tool(s)) by the chain rule. Axes that come round (Kinematics::period) are continuous all along the path
/// and, if they can be, in their ranges (AxisTurns).
class KinematicAxisPath final : public AxisPath {
 public:
  /// Without `orientation` the tool's angles are 0. Throws UnreachablePose.
  KinematicAxisPath(std::shared_ptr<const Path> tool, std::shared_ptr<const Kinematics> kinematics,
                    std::shared_ptr<const Orientation> orientation = nullptr);
  /// `tool` and `kinematics` have to outlive it.
  KinematicAxisPath(const Path& tool, const Kinematics& kinematics,
                    std::shared_ptr<const Orientation> orientation = nullptr)
      : KinematicAxisPath(borrowed(tool), borrowed(kinematics), std::move(orientation)) {}
  bool linear(std::size_t) const override { return false; }
  AxisJet at_parameter(std::size_t segment, double u) const override;
  void at_parameters(std::size_t segment, PathBatch& batch) const override;
  MapBounds map_bounds(std::size_t segment, double u, double radius) const override {
    return kinematics_.bounds(pose(segment, u), radius);
  }
  /// The same for complex poses (Kinematics::complex_bounds).
  MapBounds complex_map_bounds(std::size_t segment, double u, double radius) const {
    return kinematics_.complex_bounds(pose(segment, u), radius);
  }
  bool enclose(std::size_t segment, double u, double radius, AxisDiscs& axes) const override;
  double pose_turn(std::size_t segment, double u, double radius) const override;
  ToolPose pose(std::size_t segment, double u) const;
  /// The same with its derivatives by s.
  ToolJet tool_jet(std::size_t segment, double u) const;
  /// at_parameter() without whole turns.
  AxisJet raw_at_parameter(std::size_t segment, double u) const;
  const Kinematics& kinematics() const { return kinematics_; }

 private:
  std::shared_ptr<const Kinematics> shared_kinematics_;
  const Kinematics& kinematics_;
  std::shared_ptr<const Orientation> orientation_;
  PoseDiscs discs_;
  AxisTurns turns_;
};

}  // namespace bahnwerk
