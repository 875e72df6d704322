#pragma once
/// A motion law over the angle of the cam, and the proven largest value of a function of its derivatives.
#include <cstddef>
#include <functional>
#include <vector>

#include "core/base/progress.hpp"
#include "core/cam/cam_law.hpp"
#include "core/numeric/disc.hpp"
#include "core/numeric/taylor.hpp"

namespace bahnwerk::cam {

/// Displacement and its first three derivatives by the cam's angle φ, as coefficients of a series in φ.
template <class S>
using LawSeries = Taylor<3, S>;

/// The displacement y(φ) of a follower above its lowest position: mm, or rad for an oscillating one; φ in rad.
class FollowerLaw {
 public:
  /// One cycle of the law is one turn of the cam; positions are multiplied by `unit`.
  FollowerLaw(const CamLaw& law, double unit);

  std::size_t pieces() const { return pieces_.size(); }
  double begin(std::size_t piece) const { return pieces_[piece].begin; }  ///< rad
  double width(std::size_t piece) const { return pieces_[piece].width; }  ///< rad
  /// Bernstein coefficients of the derivative of that order, 0 … 3, by φ.
  const std::vector<double>& derivative(std::size_t piece, std::size_t order) const {
    return pieces_[piece].derivative[order];
  }
  /// Returns the series at x ∈ [0, 1] of a piece.
  LawSeries<double> at(std::size_t piece, double x) const;
  double stroke() const { return stroke_; }
  double lowest() const { return lowest_; }          ///< the law's lowest position, in its own unit
  double angular_velocity() const { return rate_; }  ///< speed of the cam, rad/s

 private:
  struct Piece {
    double begin, width;
    std::vector<double> derivative[4];
  };
  std::vector<Piece> pieces_;
  double stroke_, lowest_, rate_;
};

/// The largest value of a function and a proven upper bound of it.
struct CertifiedMaximum {
  double value = 0;       ///< attained at `at`
  double upper = 0;       ///< no value is above it
  double at = 0;          ///< rad
  LawSeries<double> law;  ///< the law at `at`
};

/// A function of the law: value and first derivative by φ are used.
using LawFunction = std::function<LawSeries<Disc>(const LawSeries<Disc>&)>;

/// Returns the largest value by best-first bisection; parts are enclosed by discs, by their middle and derivative, and
/// by monotony. Ends where value and bound agree to 1e-7 of the value and `accuracy`, or after 100 000 parts.
CertifiedMaximum certified_maximum(const FollowerLaw& law, const LawFunction& function, double accuracy,
                                   Progress progress);

}  // namespace bahnwerk::cam
