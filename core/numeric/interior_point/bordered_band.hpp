#pragma once
/// Linear and convex quadratic programs each of whose rows has a few neighbouring variables, and possibly some of a few
/// variables that all rows share (the border).
///
/// Variables and local equalities are ordered as they are added: the system of a step is a band over them with a border
/// of shared variables and of far-reaching equalities. The band is factored by Gaussian elimination with partial
/// pivoting (linear/band_lu.hpp), the border by its Schur complement. Cost per factorisation: O(size · band · (band +
/// border)), linear in the number of variables.
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/numeric/interior_point/interior_point.hpp"
#include "core/numeric/linear/band_lu.hpp"

namespace bahnwerk {

/// The row lower − f w ≤ aᵀx + bᵀw ≤ upper + f w, with a over neighbouring variables of the band, one-sided or
/// two-sided.
struct BorderedRow {
  static constexpr double unlimited = std::numeric_limits<double>::infinity();
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  struct Term {
    std::size_t border;  ///< number of the shared variable
    double weight;
  };
  std::size_t first = 0;            ///< number of the first variable of a
  std::span<const double> weights;  ///< the coefficients a; add_row copies them
  double lower = -unlimited, upper = unlimited;
  std::size_t elastic = none;  ///< shared variable that widens both sides
  double elastic_weight = 1;   ///< the factor f
  std::span<const Term> border;
};

/// A program whose rows have neighbouring variables, and a few variables that occur in any row.
class BorderedBand final : public InteriorPointSystem {
 public:
  using Term = BorderedRow::Term;

  /// Adds a shared variable with its cost; returns its number.
  std::size_t add_border(double cost);
  void set_border_cost(std::size_t border, double cost) { border_cost_[border] = cost; }
  /// Adds variables of the band without cost, neighbours of the previous ones; returns the first one's number.
  std::size_t add_variables(std::size_t count);
  /// Adds Σ weight · variable + Σ weight · shared variable = side, for variables near the current end of the band.
  /// Returns its number.
  std::size_t add_equality(std::span<const std::pair<std::size_t, double>> terms, double side,
                           std::span<const Term> border = {});
  /// Adds an equality of arbitrary variables; each costs as much as a shared variable.
  std::size_t add_far_equality(std::span<const std::pair<std::size_t, double>> terms, double side,
                               std::span<const Term> border = {});
  /// Adds a row, after all variables. Returns its number.
  std::size_t add_row(const BorderedRow& row);
  void clear_rows();
  /// Adds ½ (aᵀx)² to the objective, a over neighbouring variables of the band from `first` on.
  void add_square(std::size_t first, std::span<const double> weights);

  std::size_t band_variables() const { return position_.size(); }
  std::size_t borders() const { return border_cost_.size(); }
  std::size_t rows() const { return rows_.size(); }
  /// Returns the index of a shared variable in x.
  std::size_t border_index(std::size_t border) const { return position_.size() + border; }
  /// Returns the indices of the sides of a row in s and z; BorderedRow::none for an unlimited side.
  std::size_t upper_side(std::size_t row) const { return rows_[row].upper; }
  std::size_t lower_side(std::size_t row) const { return rows_[row].lower; }

  const std::vector<double>& cost() const override;
  const std::vector<double>& equality_side() const override { return equality_side_; }
  const std::vector<double>& inequality_side() const override { return inequality_side_; }
  void multiply(const std::vector<double>& x, std::vector<double>& gx, std::vector<double>& ex) const override;
  void add_transposed(const std::vector<double>& z, const std::vector<double>& y,
                      std::vector<double>& out) const override;
  void add_quadratic(const std::vector<double>& x, std::vector<double>& out) const override;
  bool factor(const std::vector<double>& weights) override;
  void solve(std::vector<double>& x, std::vector<double>& y) const override;
  /// Returns the weights of the last factor().
  const std::vector<double>& weights() const { return weights_; }

 private:
  struct Row {
    std::size_t first, count, weights, borders, border_count, elastic, upper, lower;
    double elastic_weight;
  };
  struct Square {
    std::size_t first, count, weights;
  };
  struct Equality {
    std::size_t terms, count, borders, border_count, slot;  // slot: in the band, or in the border if `far`
    bool far;
  };
  void prepare();

  std::vector<std::size_t> position_;  // place of each variable in the band
  std::size_t slots_ = 0;              // size of the band: number of variables and local equalities
  std::size_t far_ = 0;
  std::vector<double> border_cost_, equality_side_, inequality_side_;
  mutable std::vector<double> cost_;
  std::vector<Row> rows_;
  std::vector<Equality> equalities_;
  std::vector<Square> squares_;
  std::vector<double> row_weights_, square_weights_;
  std::vector<Term> row_borders_, equality_borders_;
  std::vector<std::pair<std::size_t, double>> equality_terms_;
  std::vector<double> weights_;
  bool prepared_ = false;
  std::size_t half_ = 0;  // width of the band beside the diagonal
  BandLu band_;
  std::vector<double> border_, solved_, corner_;  // border_: one column after the other; solved_: a row per slot
  std::vector<std::size_t> corner_pivots_;
  mutable std::vector<double> right_, right_border_;
};

}  // namespace bahnwerk
