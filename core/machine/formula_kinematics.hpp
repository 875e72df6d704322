#pragma once
/// Machines whose axes are closed formulas of a needle's pose. The formula is written once, over numbers of any type;
/// values, derivatives to order 3 and their bounds follow from it.
///
/// A machine derives from FormulaKinematics<itself> and brings
///
///   template <class T> std::array<T, n> solve(const NeedleOf<T>& needle) const;   returns the positions of n axes
///   void check(const ToolPose& pose, const AxisArray& axes) const;   throws UnreachablePose where solve() is not
///                                                                    defined; `axes` is its result, possibly NaN
///   ToolPose forward(const AxisArray& axes) const override;   returns the pose at these positions
///   static constexpr std::size_t swivel;   the index of the axis that equals ψ, if one does
///
/// T is Taylor<3> (core/numeric/taylor.hpp), of numbers or of discs, or Majorant<4> (core/numeric/majorant.hpp). A
/// machine needs nothing else and is one file.
#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"
#include "core/machine/kinematics.hpp"
#include "core/numeric/majorant.hpp"
#include "core/numeric/taylor.hpp"

namespace bahnwerk {

/// Tip and angles of a needle, as numbers of type T.
template <class T>
struct NeedleOf {
  T x, y, z, phi, psi;  ///< mm, rad
};

/// Place of the part in the frame of a machine's formulas: p_machine = R_z(angle) p_part + origin.
struct PartPlace {
  Vec origin;        ///< mm
  double angle = 0;  ///< rad

  /// Maps a pose in the part's frame to the machine's.
  template <class T>
  NeedleOf<T> placed(const NeedleOf<T>& n) const {
    if (angle == 0) return {T(origin.x) + n.x, T(origin.y) + n.y, T(origin.z) + n.z, n.phi, n.psi};
    const double c = std::cos(angle), s = std::sin(angle);
    return {T(origin.x) + c * n.x - s * n.y, T(origin.y) + s * n.x + c * n.y, T(origin.z) + n.z, n.phi + T(angle),
            n.psi};
  }
  /// Maps a pose in the machine's frame to the part's.
  ToolPose taken_back(const ToolPose& machine) const {
    const double c = std::cos(angle), s = std::sin(angle);
    const Vec p = machine.position - origin;
    return {{c * p.x + s * p.y, c * p.y - s * p.x, p.z}, machine.phi - angle, machine.psi};
  }
};

/// Returns the axes q1, q2, … of a machine: mm, or rad where `rotary`. Throws std::invalid_argument for a wrong count.
template <std::size_t n>
std::vector<AxisLimits> numbered_axes(const std::vector<Limits>& limits, const std::array<bool, n>& rotary) {
  if (limits.size() != n) throw std::invalid_argument("a machine of " + std::to_string(n) + " axes");
  std::vector<AxisLimits> axes(n);
  for (std::size_t k = 0; k < n; ++k) {
    static_cast<Limits&>(axes[k]) = limits[k];
    axes[k].name = "q" + std::to_string(k + 1);
    axes[k].unit = rotary[k] ? "rad" : "mm";
  }
  return axes;
}

/// The kinematics that follow from the formula of `Machine`, the derived class. Immutable and thread-safe.
template <class Machine>
class FormulaKinematics : public Kinematics {
 public:
  static constexpr std::size_t swivel = max_axes;  ///< index of the axis that equals ψ; max_axes: no axis does
  const std::vector<AxisLimits>& axes() const override { return axes_; }
  /// Returns the size of typical wound parts, mm, so that no coordinate of a pose outweighs the others.
  double lever() const override { return 100; }
  /// Returns 2π for rotary axes, whose ranges exclude unlimited turns. The swivel has no period: ψ lies between −90°
  /// and 90°, and a range that is whole turns away from that is a mistake.
  double period(std::size_t axis) const override {
    return axis != Machine::swivel && axes_[axis].unit == "rad" ? 2 * std::numbers::pi : 0;
  }

  AxisJet inverse(const ToolJet& tool) const override {
    using T = Taylor<3>;
    const Jet& p = tool.position;
    const auto along = [&](std::size_t i) { return T::from(p.value[i], p.d1[i], p.d2[i], p.d3[i]); };
    const auto angle = [](const AngleJet& a) { return T::from(a.value, a.d1, a.d2, a.d3); };
    const auto q = self().solve(NeedleOf<T>{along(0), along(1), along(2), angle(tool.phi), angle(tool.psi)});
    AxisJet jet;
    for (std::size_t k = 0; k < count(q.size()); ++k) {
      jet.value[k] = q[k].value();
      jet.d1[k] = q[k].derivative(1), jet.d2[k] = q[k].derivative(2), jet.d3[k] = q[k].derivative(3);
    }
    self().check(tool.pose(), jet.value);
    return jet;
  }
  bool enclose(const ToolDiscs& tool, AxisDiscs& axes) const override {
    const auto q = self().solve(NeedleOf<DiscJet>{tool[0], tool[1], tool[2], tool[3], tool[4]});
    bool known = true;
    for (std::size_t k = 0; k < count(q.size()); ++k) {
      axes.d1[k] = q[k].derivative(1), axes.d2[k] = q[k].derivative(2), axes.d3[k] = q[k].derivative(3);
      known = known && axes.d1[k].known() && axes.d2[k].known() && axes.d3[k].known();
    }
    return known;
  }
  /// Returns complex_bounds(): every formula is analytic, so bounds in the complex ball hold in the real one.
  MapBounds bounds(const ToolPose& centre, double radius) const override { return complex_bounds(centre, radius); }
  MapBounds complex_bounds(const ToolPose& centre, double radius) const override {
    using M = Majorant<4>;
    const auto along = [&](double value) { return M::coordinate(value, radius); };
    const auto angle = [&](double value) { return M::coordinate(value, radius, 1 / lever()); };
    const Vec& p = centre.position;
    const auto q = self().solve(NeedleOf<M>{along(p.x), along(p.y), along(p.z), angle(centre.phi), angle(centre.psi)});
    MapBounds bounds;
    for (std::size_t n = 1; n <= 4; ++n)
      for (std::size_t k = 0; k < count(q.size()); ++k) bounds.order[n - 1][k] = q[k].derivative(n);
    return bounds;
  }

 protected:
  explicit FormulaKinematics(std::vector<AxisLimits> axes) : axes_(std::move(axes)) {}

 private:
  /// Returns the number of axes in use: a formula may give one more, the height, than a machine for the plane has.
  std::size_t count(std::size_t formulas) const { return std::min(formulas, axes_.size()); }
  const Machine& self() const { return static_cast<const Machine&>(*this); }

  std::vector<AxisLimits> axes_;
};

}  // namespace bahnwerk
