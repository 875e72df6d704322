#pragma once
/// Decides whether contact forces can hold a pile of wires at rest.
#include <cstddef>
#include <span>
#include <vector>

#include "core/base/progress.hpp"
#include "core/geometry/region/point.hpp"

namespace bahnwerk::winding {

/// Wires with a force on each and contacts that only push. The solution of a non-negative least-squares problem leaves
/// as little of the forces unbalanced as possible and decides between two cases: either nothing is left, or the rest,
/// read as a velocity of every wire, moves along the forces without closing any contact, so the wires slip. Forces are
/// stored between calls of solve(): a pile that grows by a wire starts from the previous ones.
class ForceBalance {
 public:
  /// A contact pushes in any direction within atan(friction) of its normal. Moments are not balanced: a
  /// wire is held against rolling by its torsional stiffness beyond both ends of the slot.
  explicit ForceBalance(double friction) : friction_(friction) {}

  static constexpr std::size_t wall = static_cast<std::size_t>(-1);
  void add_wire(Point force);
  /// `normal`, a unit vector, points from `other` (a wire or `wall`) to `wire`.
  void add_contact(std::size_t wire, std::size_t other, Point normal);

  struct Result {
    bool balanced = false;    ///< whether no wire has an unbalanced force of more than 1e-6 (in units of the forces)
    double residual = 0;      ///< largest unbalanced force on a wire
    double closing = 0;       ///< largest speed at which contacts close while wires slip, relative to `residual`
    std::size_t fastest = 0;  ///< the wire with the largest unbalanced force
    /// Returns whether the wires certainly slip. After too many steps neither is certain: not balanced, and no proof of
    /// a slip.
    bool proves_slip() const { return !balanced && closing <= 1e-6; }
  };
  /// Solves by conjugate gradients on changing sets of loaded contacts, O(contacts) a step.
  Result solve(Progress progress);

  /// Returns the force of each contact, or of the two limits of its friction.
  std::span<const double> pushes() const { return amount_; }
  /// Returns the unbalanced force of each wire: the velocities that prove a slip.
  std::span<const Point> left() const { return left_; }

 private:
  struct Push {
    std::size_t wire, other;
    Point direction;
  };
  enum class Step { first, joining, loaded };
  void pass_on();
  void balance();
  Result measure() const;
  bool choose_step(double fixed, double residual, Step& step);  ///< false: no step reduces the residual
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
