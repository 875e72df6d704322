#pragma once
/// A motion law: a polynomial spline over time in Bernstein form, with its true peaks.
///
/// Piece i lasts from breaks()[i] to breaks()[i + 1]; its position is Σ b_k B_{k,n}(x), x ∈ [0, 1] its local parameter,
/// degree n ≤ 21. A section may have several pieces. Errors are those of de Casteljau's algorithm, a few n ε of the
/// largest coefficient of the derivative asked for.
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "core/cam/problem.hpp"
#include "core/motion/axes/motion.hpp"

namespace bahnwerk::cam {

struct LawPiece {
  std::size_t section = 0;
  std::vector<double> bernstein;  ///< degree + 1 coefficients of the position, the slave's unit
  std::size_t degree() const { return bernstein.size() - 1; }
};

/// The largest |s^(r)| and where it is.
struct LawPeak {
  double value = 0;  ///< unit/s^r, ≥ 0
  double at = 0;     ///< s, on the law's time axis
  std::size_t piece = 0;
};

/// Smallest and largest value of a derivative over the law.
struct LawExtremes {
  LawPeak lowest, highest;  ///< signed values
};

/// Immutable and thread-safe.
class CamLaw {
 public:
  CamLaw() = default;
  /// `breaks` are in s, ascending, one more than pieces; the pieces' sections ascend. Throws std::invalid_argument
  /// otherwise. `travel`: what a periodic law's position grows by in each cycle.
  CamLaw(std::vector<double> breaks, std::vector<LawPiece> pieces, bool periodic, double travel = 0);

  std::size_t pieces() const { return pieces_.size(); }
  const LawPiece& piece(std::size_t i) const { return pieces_[i]; }
  const std::vector<double>& breaks() const { return breaks_; }  ///< s
  double begin() const { return breaks_.front(); }               ///< s
  double duration() const { return breaks_.back() - breaks_.front(); }
  double piece_duration(std::size_t i) const { return breaks_[i + 1] - breaks_[i]; }
  bool periodic() const { return periodic_; }
  double travel() const { return travel_; }
  std::size_t max_degree() const;

  /// Returns s^(order) just after t, unit/s^order; a periodic law goes on before and after its breaks, an open one is
  /// evaluated at its nearest end. `piece` is a hint and is updated. O(degree · (order + degree)).
  double evaluate(double t, int order, std::size_t& piece) const;
  double evaluate(double t, int order) const {
    std::size_t piece = 0;
    return evaluate(t, order, piece);
  }
  /// Returns s^(order) inside a piece at its local parameter x ∈ [0, 1], ends included.
  double in_piece(std::size_t piece, double x, int order) const;
  /// Returns the Bernstein coefficients of s^(order) over the piece's local parameter, unit/s^order; {0} above its
  /// degree.
  std::vector<double> derivative(std::size_t piece, int order) const;

  /// Returns the true peak of |s^(order)| inside the pieces, one-sided limits at breaks included: by enclosure
  /// (Bernstein coefficients bound from outside, extrema are isolated by sign changes), to rounding. ≈ 1 µs per piece
  /// and order.
  LawPeak peak(int order) const;
  LawPeak peak(int order, std::size_t piece) const;
  /// Returns the root of the mean square of s^(order) over the law, unit/s^order: exact but for rounding.
  double rms(int order) const;
  /// Returns the root of the mean square over the pieces of one section.
  double section_rms(int order, std::size_t section) const;
  /// Returns the true extremes of s^(order) over all pieces, or those of one section.
  LawExtremes extremes(int order) const;
  LawExtremes section_extremes(int order, std::size_t section) const;

 private:
  std::vector<double> breaks_;
  std::vector<LawPiece> pieces_;
  /// Returns the mean square over pieces first … end − 1.
  double mean_square(int order, std::size_t first, std::size_t end) const;
  bool periodic_ = false;
  double travel_ = 0;
};

/// J of a law and what it is made of: all methods are compared by this.
struct LawValue {
  double objective = 0;
  std::array<LawPeak, limited_orders> peaks{};  ///< peaks by order; [0] is the largest |position|
  std::size_t zero_crossings = 0;               ///< number of sign changes of velocity and acceleration inside sections
};
LawValue evaluate_objective(const MotionLawProblem& problem, const CamLaw& law);
/// Returns the weights of the orders, each with the factor that `normalised` gives it.
std::array<double, limited_orders> effective_weights(const MotionLawProblem& problem);

/// Returns one cycle of the law that begins at time 0, `first` seconds after the law's own zero (an open law: at its
/// begin). A periodic law is cut there; all pieces are of section 0.
CamLaw law_from(const CamLaw& law, double first);
/// Returns one cycle of the law as a motion of one axis that begins at time 0, `first` seconds after the law's own zero
/// (an open law: at its begin). A periodic law is cut there.
std::shared_ptr<const Motion> law_motion(const CamLaw& law, double first);

}  // namespace bahnwerk::cam
