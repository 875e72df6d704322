#pragma once
/// The positions q(s) of N axes over the arc length s of the tool's path, with q′, q″, q‴. Planners, verifier and bound
/// use axis paths only; limits apply to axes, never to "x".
///
/// An axis path has the segments of the tool's path. Inside each segment q is smooth; at the joints one-sided
/// derivatives may differ. Segments give places (arc length s, parameter u, panels of a difficult curve, cusps); the
/// axis path gives the axes at a segment and parameter.
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
  /// Returns whether the axes are the coordinates of the tool: |q′| = 1, q″ ⟂ q′.
  bool cartesian() const { return cartesian_; }

  std::size_t size() const { return tool_.size(); }
  const Segment& operator[](std::size_t i) const { return tool_[i]; }
  double length() const { return tool_.length(); }
  const Path& tool() const { return tool_; }

  /// Returns whether q is linear in s over the whole segment: a single value of q′ describes it.
  virtual bool linear(std::size_t segment) const = 0;
  /// Returns the axes at a parameter of a segment; derivatives by s, one-sided at its ends. Throws UnreachablePose.
  virtual AxisJet at_parameter(std::size_t segment, double u) const = 0;
  /// Evaluates up to 16 ascending parameters: rows of d1, d2, d3 per axis, and s from the beginning of the segment.
  /// `planar` says that the third row was not written and is 0.
  virtual void at_parameters(std::size_t segment, PathBatch& batch) const = 0;
  /// Returns bounds of the map from the tool's pose to the axes, for poses within `radius` mm of the pose at `u`
  /// (MapBounds defines the norm).
  virtual MapBounds map_bounds(std::size_t segment, double u, double radius) const = 0;
  /// Encloses q′, q″, q‴ by s for all complex parameters within `radius` of u. Returns false if no enclosure is known;
  /// a smaller radius or map_bounds() may give one.
  virtual bool enclose(std::size_t segment, double u, double radius, AxisDiscs& axes) const {
    (void)segment, (void)u, (void)radius, (void)axes;
    return false;
  }
  /// Returns a bound on the distance that the tool's angles alone can move the pose from that at `u`, mm, for complex
  /// parameters within `radius` of u: infinite where unknown, 0 where the angles are constant or do not count.
  virtual double pose_turn(std::size_t segment, double u, double radius) const {
    (void)segment, (void)u, (void)radius;
    return 0;
  }
  /// Returns the axes at a place of a segment, s ∈ [s0, s1].
  virtual AxisJet at(std::size_t segment, double s) const { return at_parameter(segment, tool_[segment].parameter(s)); }
  /// Writes q, q′, q″, q‴, axes() numbers of each, one after the other. It leaves out the unused axes of an AxisJet:
  /// setting those takes longer than evaluating a straight line.
  virtual void write_at(std::size_t segment, double s, double* out) const;

 protected:
  /// Shares the tool's path.
  AxisPath(std::shared_ptr<const Path> tool, std::size_t axes, bool cartesian)
      : shared_(std::move(tool)), tool_(*shared_), axes_(axes), cartesian_(cartesian) {}
  const std::shared_ptr<const Path>& shared_tool() const { return shared_; }
  /// Writes row i of d1, d2, d3 of every axis.
  void write_row(PathBatch& batch, std::size_t i, const AxisJet& q) const;
  /// Returns the map_bounds() of axes that do not follow from the pose alone: every axis can move.
  MapBounds every_axis_moves() const;

 private:
  std::shared_ptr<const Path> shared_;
  const Path& tool_;
  std::size_t axes_;
  bool cartesian_;
};

/// Returns the largest |q′| of each axis at six places of every panel; 0 for an axis that stands still but for
/// rounding, below 1e-12 of what the map lets it move. O(panels); reports to `progress`, if given.
AxisArray largest_rates(const AxisPath& path, ProgressScope* progress = nullptr);

/// The axes are the first `axes` ≤ 3 coordinates of the tool's path; the third is `height` above the path's. It costs
/// no more than the path.
class CartesianAxisPath final : public AxisPath {
 public:
  CartesianAxisPath(std::shared_ptr<const Path> tool, std::size_t axes, double height = 0);
  /// `tool` has to outlive the object.
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

/// q = inverse(tool(s)) by the chain rule. Periodic axes (Kinematics::period) are continuous along the whole path and,
/// if possible, in their ranges (AxisTurns).
class KinematicAxisPath final : public AxisPath {
 public:
  /// The tool's angles are those of `orientation`, or 0 if there is none. Throws UnreachablePose.
  KinematicAxisPath(std::shared_ptr<const Path> tool, std::shared_ptr<const Kinematics> kinematics,
                    std::shared_ptr<const Orientation> orientation = nullptr);
  /// `tool` and `kinematics` have to outlive the object.
  KinematicAxisPath(const Path& tool, const Kinematics& kinematics,
                    std::shared_ptr<const Orientation> orientation = nullptr)
      : KinematicAxisPath(borrowed(tool), borrowed(kinematics), std::move(orientation)) {}
  bool linear(std::size_t segment) const override {
    return kinematics_.linear() != nullptr && tool()[segment].straight();
  }
  AxisJet at_parameter(std::size_t segment, double u) const override;
  void at_parameters(std::size_t segment, PathBatch& batch) const override;
  MapBounds map_bounds(std::size_t segment, double u, double radius) const override {
    return kinematics_.bounds(pose(segment, u), radius);
  }
  /// Returns map_bounds() for complex poses (Kinematics::complex_bounds).
  MapBounds complex_map_bounds(std::size_t segment, double u, double radius) const {
    return kinematics_.complex_bounds(pose(segment, u), radius);
  }
  bool enclose(std::size_t segment, double u, double radius, AxisDiscs& axes) const override;
  double pose_turn(std::size_t segment, double u, double radius) const override;
  ToolPose pose(std::size_t segment, double u) const;
  /// Returns the tool with its derivatives by s.
  ToolJet tool_jet(std::size_t segment, double u) const;
  /// Returns at_parameter() without whole turns.
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
