#pragma once
/// Machines whose axes are linear in the tool's position: belts, racks, portals with a skew, axes at an angle.
///
///   q = M p,   p = (MᵀM)⁻¹Mᵀ q
///
/// with one row of M per axis. There may be more axes than coordinates, such as two motors that move one portal. A
/// CoreXY machine is one of them: both of its motors stand still on the frame, and the belts move the tool by
///
///   A = x + y,   B = x − y.
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/machine/kinematics.hpp"

namespace bahnwerk {

class LinearMachine final : public Kinematics {
 public:
  /// Row k of the matrix belongs to axis k; its first `coordinates` (2 or 3) components count. Throws
  /// std::invalid_argument for other counts, and if the axes do not determine the tool's position: the matrix has a
  /// smaller rank, to 1e-6 of its rows.
  LinearMachine(std::vector<AxisLimits> axes, const std::vector<Vec>& rows, std::size_t coordinates)
      : axes_(std::move(axes)), coordinates_(coordinates) {
    if (rows.size() != axes_.size() || rows.size() > max_axes || coordinates < 2 || coordinates > 3)
      throw std::invalid_argument("a linear machine has a row per axis");
    for (std::size_t k = 0; k < rows.size(); ++k) {
      map_.rows[k] = rows[k];
      if (coordinates < 3) map_.rows[k].z = 0;
    }
    invert();
  }

  const std::vector<AxisLimits>& axes() const override { return axes_; }
  const LinearMap* linear() const override { return &map_; }
  AxisJet inverse(const ToolJet& tool) const override {
    const Jet& p = tool.position;
    AxisJet q;
    for (std::size_t k = 0; k < axes_.size(); ++k) {
      const Vec& row = map_.rows[k];
      q.value[k] = dot(row, p.value), q.d1[k] = dot(row, p.d1);
      q.d2[k] = dot(row, p.d2), q.d3[k] = dot(row, p.d3);
    }
    return q;
  }
  bool enclose(const ToolDiscs& tool, AxisDiscs& axes) const override {
    for (std::size_t k = 0; k < axes_.size(); ++k) {
      const Vec& row = map_.rows[k];
      const DiscJet q = row.x * tool[0] + row.y * tool[1] + row.z * tool[2];
      axes.d1[k] = q.derivative(1), axes.d2[k] = q.derivative(2), axes.d3[k] = q.derivative(3);
    }
    return true;
  }
  ToolPose forward(const AxisArray& q) const override {
    Vec p;
    for (std::size_t k = 0; k < axes_.size(); ++k) p += q[k] * back_[k];
    return {p};
  }
  MapBounds bounds(const ToolPose&, double) const override {
    MapBounds b;
    for (std::size_t k = 0; k < axes_.size(); ++k) b.order[0][k] = norm(map_.rows[k]);
    return b;
  }
  MapBounds complex_bounds(const ToolPose& centre, double radius) const override { return bounds(centre, radius); }

 private:
  /// Computes the columns of the pseudo-inverse by Cramer's rule for the normal equations.
  void invert() {
    Vec n[3];  // MᵀM, and the unit for a coordinate that the machine does not move
    for (std::size_t k = 0; k < axes_.size(); ++k)
      for (std::size_t i = 0; i < 3; ++i) n[i] += map_.rows[k][i] * map_.rows[k];
    if (coordinates_ < 3) n[2] = {0, 0, 1};
    const double volume = dot(n[0], cross(n[1], n[2]));
    if (!(volume > 1e-12 * norm(n[0]) * norm(n[1]) * norm(n[2])))
      throw std::invalid_argument("the axes do not determine the tool's position");
    for (std::size_t k = 0; k < axes_.size(); ++k) {
      const Vec& row = map_.rows[k];
      back_[k] = (row.x * cross(n[1], n[2]) + row.y * cross(n[2], n[0]) + row.z * cross(n[0], n[1])) / volume;
    }
  }

  std::vector<AxisLimits> axes_;
  std::size_t coordinates_;
  LinearMap map_;
  std::array<Vec, max_axes> back_{};
};

}  // namespace bahnwerk
