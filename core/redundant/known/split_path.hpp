#pragma once
/// Axis path of a machine whose coarse positions are a function of the tool's place on the path [Bock 3.2]: 2 N axes
/// that any planner of time laws can plan.
#include <cstddef>
#include <memory>
#include <utility>

#include "core/motion/axes/axis_path.hpp"

namespace bahnwerk {

/// Positions of the coarse axes as a function of the tool's path length.
class CoarsePath {
 public:
  virtual ~CoarsePath() = default;
  /// Tells whether the coarse positions are linear in s on a segment on which the tool's are.
  virtual bool linear(std::size_t segment) const = 0;
  /// Returns positions and derivatives by s at path length s of a segment; `tool` holds the tool's. Positions are valid
  /// only if those of `tool` are.
  virtual AxisJet at(std::size_t segment, double s, const AxisJet& tool) const = 0;
};

/// Axes 0 … N−1 are the coarse axes; axes N … 2N−1 are the fine ones, x_f = x − x_c.
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
