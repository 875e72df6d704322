#pragma once
/// Axis path of a machine whose coarse axes stand somewhere for every place of the tool [Bock 3.2]: 2 N axes, which any
/// planner of time laws can drive.
#include <cstddef>
#include <memory>
#include <utility>

#include "core/motion/axes/axis_path.hpp"

namespace bahnwerk {

/// Where the coarse axes stand, given the tool.
class CoarsePath {
 public:
  virtual ~CoarsePath() = default;
  /// Whether that is linear in s over the segment, if the tool's place is.
  virtual bool linear(std::size_t segment) const = 0;
  /// Positions and derivatives by s at path length s of a segment, where the tool's are `tool`. Positions count only if
  /// the tool's are given.
  virtual AxisJet at(std::size_t segment, double s, const AxisJet& tool) const = 0;
};

/// Axes 0 … N−1: coarse; N … 2N−1: fine, what is left to the tool's place.
class SplitPath final : public AxisPath {
 public:
  /// `path` has N ≤ max_axes/2 axes.
  SplitPath(std::shared_ptr<const AxisPath> path, std::shared_ptr<const CoarsePath> coarse)
      : AxisPath({path, &path->tool()}, 2 * path->axes(), false), path_(std::move(path)), coarse_(std::move(coarse)) {}

  bool linear(std::size_t segment) const override { return path_->linear(segment) && coarse_->linear(segment); }
  AxisJet at_parameter(std::size_t segment, double u) const override;
  void at_parameters(std::size_t segment, PathBatch& batch) const override;
  MapBounds map_bounds(std::size_t, double, double) const override { return every_axis_moves(); }

 private:
  AxisJet split(std::size_t segment, double s, const AxisJet& tool) const;

  std::shared_ptr<const AxisPath> path_;
  std::shared_ptr<const CoarsePath> coarse_;
};

}  // namespace bahnwerk
