#pragma once
/// The splines of one section: degree n ≥ 3 on pieces of u ∈ [0, 1], joined up to order n − 1.
///
/// Coefficients are the state at the section's begin, s, ds/du and d²s/du² at u = 0, and the B-spline coefficients of
/// d³s/du³ with clamped knots. A derivative of any order up to 3 is a sum of coefficients without cancellation, however
/// short the section is: B-spline coefficients of the position would lose (n · pieces)³ of their precision in the jerk.
#include <array>
#include <cstddef>
#include <vector>

namespace bahnwerk::cam {

class SectionBasis {
 public:
  static constexpr std::size_t states = 3;  ///< coefficients that are derivatives at the section's begin
  /// The degree is 3 … 21, the number of pieces at least 1. Cost: O(pieces · degree² · size).
  SectionBasis(int degree, int pieces);  ///< pieces of the same length
  /// `breaks` ascend from 0 to 1: the ends of the pieces.
  SectionBasis(int degree, std::vector<double> breaks);

  std::size_t degree() const { return degree_; }
  std::size_t pieces() const { return pieces_; }
  std::size_t size() const { return degree_ + pieces_; }  ///< coefficients of a section
  const std::vector<double>& breaks() const { return breaks_; }
  double begin(std::size_t piece) const { return breaks_[piece]; }  ///< u at which a piece begins
  double length(std::size_t piece) const { return breaks_[piece + 1] - breaks_[piece]; }
  /// Returns the order of the derivative with respect to u that a coefficient stands for.
  static std::size_t order_of(std::size_t coefficient) { return coefficient < states ? coefficient : states; }
  /// Writes size() weights with which the coefficients enter the derivative d^order/du^order at v ∈ [0, 1] of a piece.
  /// They are 0 above the degree.
  void weights(std::size_t piece, double v, std::size_t order, double* out) const;
  /// Writes the degree − order + 1 Bernstein coefficients of d^order/du^order on a piece, over its own v ∈ [0, 1];
  /// order ≤ 3.
  void bernstein(std::size_t piece, const double* coefficients, std::size_t order, double* out) const;
  /// Returns the Greville abscissae, u, of the splines of which d^order/du^order is one: as many as it has B-splines.
  std::vector<double> sites(std::size_t order) const;
  /// Writes the values B_j^degree(v), j = 0 … degree, of the Bernstein polynomials of any degree.
  static void bernstein_values(std::size_t degree, double v, double* out);

 private:
  const double* row(std::size_t piece, std::size_t order, std::size_t j) const {
    return to_bernstein_[order].data() + (piece * (degree_ - order + 1) + j) * size();
  }
  std::size_t degree_, pieces_;
  std::vector<double> breaks_;
  /// By order: row j of a piece gives Bernstein coefficient j of that derivative.
  std::array<std::vector<double>, states + 1> to_bernstein_;
};

/// Returns the ends of pieces of the same length, from 0 to 1.
std::vector<double> equal_breaks(int pieces);

/// Replaces the n Bernstein coefficients of a polynomial by the n − 1 of its derivative with respect to v.
void differentiate_bernstein(std::vector<double>& coefficients);

}  // namespace bahnwerk::cam
