#pragma once
/// Whether contact forces can hold a pile of wires at rest.
#include <cstddef>
#include <span>
#include <vector>

#include "core/geometry/region/point.hpp"

namespace bahnwerk {
class Progress;
}

namespace bahnwerk::winding {

/// Wires with a force on each and contacts that only push. Looks for the contact forces that leave least of the forces
/// unbalanced (a non-negative least-squares problem). Its solution decides either way: nothing is left, or what is
/// left, read as a velocity of every wire, moves along the forces without closing any contact, so the wires do slip.
/// Forces are kept between calls of solve: a pile that grows by a wire starts from those that held it before.
class ForceBalance {
 public:
  /// With friction a contact pushes in any direction within atan(friction) of its normal. Moments are not balanced: a
  /// wire is held against rolling by its own stiffness in torsion, beyond both ends of the slot.
  explicit ForceBalance(double friction) : friction_(friction) {}

  static constexpr std::size_t wall = static_cast<std::size_t>(-1);
  void add_wire(Point force);
  /// `normal`, a unit vector, points from `other` (a wire or `wall`) to `wire`.
  void add_contact(std::size_t wire, std::size_t other, Point normal);

  struct Result {
    bool balanced = false;    ///< no wire is left with more than 1e-6 (in units of the forces)
    double residual = 0;      ///< largest force left on a wire
    double closing = 0;       ///< greatest speed at which contacts close while wires slip, in terms of `residual`
    std::size_t fastest = 0;  ///< the wire with the largest force left
    /// After too many steps neither may hold: not balanced, and no proof of a slip.
    bool proves_slip() const { return !balanced && closing <= 1e-6; }
  };
  /// Conjugate gradients on changing sets of loaded contacts, O(contacts) a step. Reports `fraction` while it works.
  Result solve(Progress& progress, double fraction);

  /// Of each contact, or of the two limits of its friction: how hard it pushes.
  std::span<const double> pushes() const { return amount_; }
  /// What solve left on each wire: the velocities that prove a slip.
  std::span<const Point> left() const { return left_; }

 private:
  struct Push {
    std::size_t wire, other;
    Point direction;
  };
  enum class Step { first, joining, loaded };
  void balance();
  Result measure() const;
  bool choose_step(double fixed, double residual, Step& step);  ///< false: no step lessens what is left
  void conjugate(double curvature);
  void spread(const std::vector<double>& pushes, std::vector<Point>& forces) const;
  void gather(const std::vector<Point>& forces, std::vector<double>& pushes) const;

  double friction_;
  std::vector<Point> forces_, left_, change_;
  std::vector<Push> pushes_;
  std::vector<double> amount_, gradient_, step_, image_;
  std::vector<std::size_t> touching_;  ///< pushes on each wire
};

}  // namespace bahnwerk::winding
