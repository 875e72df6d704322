#pragma once
/// The splines of one section: degree n on equal pieces of u ∈ [0, 1], joined up to order n − 1, as B-splines with
/// clamped knots. With one piece they are the Bernstein polynomials.
#include <cstddef>
#include <span>
#include <vector>

namespace bahnwerk::cam {

class SectionBasis {
 public:
  /// The degree is 1 … 21, the number of pieces at least 1. Cost: O(pieces · degree⁴), nothing with one piece.
  SectionBasis(int degree, int pieces);

  std::size_t degree() const { return degree_; }
  std::size_t pieces() const { return pieces_; }
  std::size_t size() const { return degree_ + pieces_; }  ///< coefficients of a section
  /// Writes the weights with which the coefficients piece … piece + degree enter the derivative d^order/du^order at v ∈
  /// [0, 1] of a piece. They are 0 above the degree.
  void weights(std::size_t piece, double v, std::size_t order, double* out) const;
  /// Writes the degree + 1 Bernstein coefficients of a piece, over its own v ∈ [0, 1].
  void bernstein(std::size_t piece, const double* coefficients, double* out) const;
  /// Writes the values B_j^degree(v), j = 0 … degree, of the Bernstein polynomials of any degree.
  static void bernstein_values(std::size_t degree, double v, double* out);

 private:
  std::size_t degree_, pieces_;
  std::vector<double> to_bernstein_;  // matrix of each piece: row j gives Bernstein coefficient j; none with one piece
};

/// Replaces the n Bernstein coefficients of a polynomial by the n − 1 of its derivative with respect to v.
void differentiate_bernstein(std::vector<double>& coefficients);

}  // namespace bahnwerk::cam
