#pragma once
/// The bounds of the interior-point method for chains (chain_solver.hpp): slack, excess and multipliers of each, and
/// their steps.
#include <algorithm>
#include <cmath>
#include <limits>

namespace bahnwerk {

/// One side of a box: sign·x + slack − excess = limit; `x` of all functions is sign·x. Its multiplier z lies between 0
/// and the penalty. The difference penalty − z is stored separately, because near the penalty a computed difference
/// would have lost its digits.
struct ChainBound {
  static constexpr double hard = std::numeric_limits<double>::infinity();  ///< penalty of a bound without excess

  double limit = 0;  ///< infinite: no bound
  double slack = 1, excess = 1, z = 1, below = 1;
  double d_slack = 0, d_excess = 0, dz = 0;  ///< Newton step
  double aim1 = 0, aim2 = 0;                 ///< required changes of slack·z and excess·below
  double by_z = 0, by_elastic = 0;           ///< 1/z, 1/below; 0: no excess variable
  double inverse = 0;                        ///< weight of the bound in the Newton system

  bool active() const { return std::isfinite(limit); }

  /// Sets slack, excess and multiplier for the first x.
  void start(double x, double penalty) {
    const double room = limit - x, kappa = 0.3;
    const double root = std::sqrt(room * room + 4 * kappa * kappa);
    if (penalty == hard) {
      slack = std::max(room, 0.1);
      excess = 0;
      z = 1;
    } else {
      slack = room > 0 ? 0.5 * (room + root) : 2 * kappa * kappa / (root - room);
      excess = room > 0 ? 2 * kappa * kappa / (root + room) : 0.5 * (root - room);
      z = std::min(penalty * excess / (slack + excess), 0.9999 * penalty);
      below = penalty - z;
    }
  }

  /// Applies the share `taken` of the step.
  void advance(double taken, double penalty) {
    slack += taken * d_slack;
    z += taken * dz;
    if (penalty < hard) excess += taken * d_excess, below -= taken * dz;
  }

  /// Updates the reciprocals and the weight in the Newton system.
  void weigh(double penalty) {
    by_z = 1 / z, by_elastic = penalty < hard ? 1 / below : 0;
    inverse = 1 / (slack * by_z + excess * by_elastic);
  }

  /// Returns the residual of the bound, including its centring terms.
  double shift(double x) const { return x + slack - excess - limit + aim1 * by_z - aim2 * by_elastic; }

  /// Sets the targets of a step towards complementarity itself.
  void aim_at_zero(double penalty) {
    aim1 = -slack * z;
    aim2 = penalty < hard ? -excess * below : 0;
  }
  /// Sets the targets of a step towards slack·z = excess·below = `target`, corrected by the products of the last step.
  void aim_at(double target, double penalty) {
    aim1 = target - slack * z - d_slack * dz;
    if (penalty < hard) aim2 = target - excess * below + d_excess * dz;
  }

  /// Computes the steps for x after the step of the states.
  void direct(double x, double penalty) {
    dz = shift(x) * inverse;
    d_slack = (aim1 - slack * dz) * by_z;
    if (penalty < hard) d_excess = (aim2 + excess * dz) * by_elastic;
  }
};

/// Both sides of a box.
struct ChainBox {
  ChainBound lower, upper;
};

/// Complementarity after a step of length a: now + a (linear + a square).
struct ChainProducts {
  double linear = 0, square = 0;
  void add(const ChainBound& b, double penalty) {
    if (penalty < ChainBound::hard) {
      linear += b.d_excess * b.below - b.excess * b.dz;
      square -= b.d_excess * b.dz;
    }
    linear += b.slack * b.dz + b.d_slack * b.z;
    square += b.d_slack * b.dz;
  }
};

}  // namespace bahnwerk
