#include "core/numeric/interior_point/bordered_band.hpp"

#include <algorithm>
#include <cmath>

#include "core/numeric/linear/vector_loops.hpp"

namespace bahnwerk {
namespace {

// Regularisation of the factors where a solution is not unique or conditions are redundant; refinement removes its
// effect.
constexpr double primal_shift = 1e-11, dual_shift = 1e-13;

}  // namespace

std::size_t BorderedBand::add_border(double cost) {
  border_cost_.push_back(cost);
  prepared_ = false;
  return border_cost_.size() - 1;
}

std::size_t BorderedBand::add_variables(std::size_t count) {
  const std::size_t first = position_.size();
  for (std::size_t i = 0; i < count; ++i) position_.push_back(slots_++);
  prepared_ = false;
  return first;
}

std::size_t BorderedBand::add_equality(std::span<const std::pair<std::size_t, double>> terms, double side,
                                       std::span<const Term> border) {
  equalities_.push_back(
      {equality_terms_.size(), terms.size(), equality_borders_.size(), border.size(), slots_++, false});
  equality_terms_.insert(equality_terms_.end(), terms.begin(), terms.end());
  equality_borders_.insert(equality_borders_.end(), border.begin(), border.end());
  equality_side_.push_back(side);
  prepared_ = false;
  return equalities_.size() - 1;
}

std::size_t BorderedBand::add_far_equality(std::span<const std::pair<std::size_t, double>> terms, double side,
                                           std::span<const Term> border) {
  add_equality(terms, side, border);
  --slots_;
  equalities_.back().slot = far_++;
  equalities_.back().far = true;
  return equalities_.size() - 1;
}

std::size_t BorderedBand::add_row(const BorderedRow& row) {
  Row stored{row.first,   row.weights.size(), row_weights_.size(), row_borders_.size(), row.border.size(),
             row.elastic, BorderedRow::none,  BorderedRow::none,   row.elastic_weight};
  if (row.upper < BorderedRow::unlimited) {
    stored.upper = inequality_side_.size();
    inequality_side_.push_back(row.upper);
  }
  if (row.lower > -BorderedRow::unlimited) {
    stored.lower = inequality_side_.size();
    inequality_side_.push_back(-row.lower);
  }
  row_weights_.insert(row_weights_.end(), row.weights.begin(), row.weights.end());
  row_borders_.insert(row_borders_.end(), row.border.begin(), row.border.end());
  rows_.push_back(stored);
  prepared_ = false;
  return rows_.size() - 1;
}

void BorderedBand::clear_rows() {
  rows_.clear();
  row_weights_.clear();
  row_borders_.clear();
  inequality_side_.clear();
  prepared_ = false;
}

void BorderedBand::add_square(std::size_t first, std::span<const double> weights) {
  squares_.push_back({first, weights.size(), square_weights_.size()});
  square_weights_.insert(square_weights_.end(), weights.begin(), weights.end());
  prepared_ = false;
}

void BorderedBand::add_quadratic(const std::vector<double>& x, std::vector<double>& out) const {
  for (const Square& square : squares_) {
    const double* const a = square_weights_.data() + square.weights;
    add_multiple(out.data() + square.first, dot_product(a, x.data() + square.first, square.count), a, square.count);
  }
}

const std::vector<double>& BorderedBand::cost() const {
  cost_.assign(position_.size() + border_cost_.size(), 0);
  std::copy(border_cost_.begin(), border_cost_.end(), cost_.begin() + static_cast<std::ptrdiff_t>(position_.size()));
  return cost_;
}

void BorderedBand::multiply(const std::vector<double>& x, std::vector<double>& gx, std::vector<double>& ex) const {
  const double* const shared = x.data() + position_.size();
  for (const Row& row : rows_) {
    const double *const a = row_weights_.data() + row.weights, *const at = x.data() + row.first;
    double sum = dot_product(a, at, row.count);
    for (std::size_t k = 0; k < row.border_count; ++k) {
      const Term& term = row_borders_[row.borders + k];
      sum += term.weight * shared[term.border];
    }
    const double give = row.elastic != BorderedRow::none ? row.elastic_weight * shared[row.elastic] : 0;
    if (row.upper != BorderedRow::none) gx[row.upper] = sum - give;
    if (row.lower != BorderedRow::none) gx[row.lower] = -sum - give;
  }
  for (std::size_t i = 0; i < equalities_.size(); ++i) {
    const Equality& equality = equalities_[i];
    double sum = 0;
    for (std::size_t k = 0; k < equality.count; ++k) {
      const auto& [variable, weight] = equality_terms_[equality.terms + k];
      sum += weight * x[variable];
    }
    for (std::size_t k = 0; k < equality.border_count; ++k) {
      const Term& term = equality_borders_[equality.borders + k];
      sum += term.weight * shared[term.border];
    }
    ex[i] = sum;
  }
}

void BorderedBand::add_transposed(const std::vector<double>& z, const std::vector<double>& y,
                                  std::vector<double>& out) const {
  double* const shared = out.data() + position_.size();
  for (const Row& row : rows_) {
    const double upper = row.upper != BorderedRow::none ? z[row.upper] : 0;
    const double lower = row.lower != BorderedRow::none ? z[row.lower] : 0;
    const double factor = upper - lower;
    const double* const a = row_weights_.data() + row.weights;
    double* const at = out.data() + row.first;
    add_multiple(at, factor, a, row.count);
    for (std::size_t k = 0; k < row.border_count; ++k) {
      const Term& term = row_borders_[row.borders + k];
      shared[term.border] += factor * term.weight;
    }
    if (row.elastic != BorderedRow::none) shared[row.elastic] -= row.elastic_weight * (upper + lower);
  }
  for (std::size_t i = 0; i < equalities_.size(); ++i) {
    const Equality& equality = equalities_[i];
    for (std::size_t k = 0; k < equality.count; ++k) {
      const auto& [variable, weight] = equality_terms_[equality.terms + k];
      out[variable] += weight * y[i];
    }
    for (std::size_t k = 0; k < equality.border_count; ++k) {
      const Term& term = equality_borders_[equality.borders + k];
      shared[term.border] += term.weight * y[i];
    }
  }
}

void BorderedBand::prepare() {
  if (prepared_) return;
  half_ = 1;
  for (const Row& row : rows_)
    if (row.count > 1) half_ = std::max(half_, position_[row.first + row.count - 1] - position_[row.first]);
  for (const Square& square : squares_)
    if (square.count > 1) half_ = std::max(half_, position_[square.first + square.count - 1] - position_[square.first]);
  for (const Equality& equality : equalities_) {
    if (equality.far) continue;
    for (std::size_t k = 0; k < equality.count; ++k) {
      const std::size_t at = position_[equality_terms_[equality.terms + k].first];
      half_ = std::max(half_, at > equality.slot ? at - equality.slot : equality.slot - at);
    }
  }
  prepared_ = true;
}

bool BorderedBand::factor(const std::vector<double>& weights) {
  prepare();
  weights_ = weights;
  const std::size_t shared = border_cost_.size(), columns = shared + far_;
  band_.reset(slots_, half_, half_);
  border_.assign(slots_ * columns, 0);
  corner_.assign(columns * columns, 0);
  const auto column = [&](std::size_t k) { return border_.data() + k * slots_; };
  for (const Row& row : rows_) {
    const double upper = row.upper != BorderedRow::none ? weights[row.upper] : 0;
    const double lower = row.lower != BorderedRow::none ? weights[row.lower] : 0;
    const double both = upper + lower;
    const double* const a = row_weights_.data() + row.weights;
    const std::size_t* const at = position_.data() + row.first;
    if (row.count > 0) {
      // The upper triangle; adjoining positions, mostly.
      const bool adjoining = at[row.count - 1] - at[0] == row.count - 1;
      for (std::size_t i = 0; i < row.count; ++i) {
        const double factor = both * a[i];
        if (adjoining) {
          add_multiple(&band_.at(at[i], at[i]), factor, a + i, row.count - i);
        } else {
          for (std::size_t j = i; j < row.count; ++j) band_.at(at[i], at[j]) += factor * a[j];
        }
      }
    }
    const auto add_border_terms = [&](std::size_t border, double factor) {
      double* const out = column(border);
      for (std::size_t i = 0; i < row.count; ++i) out[at[i]] += factor * a[i];
    };
    for (std::size_t k = 0; k < row.border_count; ++k) {
      const Term& term = row_borders_[row.borders + k];
      add_border_terms(term.border, both * term.weight);
      for (std::size_t l = 0; l < row.border_count; ++l) {
        const Term& other = row_borders_[row.borders + l];
        corner_[term.border * columns + other.border] += both * term.weight * other.weight;
      }
    }
    if (row.elastic != BorderedRow::none) {
      const double across = -row.elastic_weight * (upper - lower);
      add_border_terms(row.elastic, across);
      corner_[row.elastic * columns + row.elastic] += row.elastic_weight * row.elastic_weight * both;
      for (std::size_t k = 0; k < row.border_count; ++k) {
        const Term& term = row_borders_[row.borders + k];
        corner_[term.border * columns + row.elastic] += across * term.weight;
        corner_[row.elastic * columns + term.border] += across * term.weight;
      }
    }
  }
  for (const Square& square : squares_) {
    const double* const a = square_weights_.data() + square.weights;
    const std::size_t* const at = position_.data() + square.first;
    for (std::size_t i = 0; i < square.count; ++i)
      for (std::size_t j = i; j < square.count; ++j) band_.at(at[i], at[j]) += a[i] * a[j];
  }
  for (std::size_t i : position_) band_.at(i, i) += primal_shift;
  for (std::size_t k = 0; k < shared; ++k) corner_[k * columns + k] += primal_shift;
  for (const Equality& equality : equalities_) {
    if (equality.far) {
      const std::size_t k = shared + equality.slot;
      for (std::size_t t = 0; t < equality.count; ++t) {
        const auto& [variable, weight] = equality_terms_[equality.terms + t];
        column(k)[position_[variable]] += weight;
      }
      for (std::size_t t = 0; t < equality.border_count; ++t) {
        const Term& term = equality_borders_[equality.borders + t];
        corner_[k * columns + term.border] += term.weight;
        corner_[term.border * columns + k] += term.weight;
      }
      corner_[k * columns + k] -= dual_shift;
      continue;
    }
    for (std::size_t t = 0; t < equality.count; ++t) {
      const auto& [variable, weight] = equality_terms_[equality.terms + t];
      const std::size_t at = position_[variable];
      band_.at(std::min(at, equality.slot), std::max(at, equality.slot)) += weight;
    }
    for (std::size_t t = 0; t < equality.border_count; ++t) {
      const Term& term = equality_borders_[equality.borders + t];
      column(term.border)[equality.slot] += term.weight;
    }
    band_.at(equality.slot, equality.slot) -= dual_shift;
  }
  for (std::size_t i = 0; i < slots_; ++i)
    for (std::size_t j = i + 1; j < std::min(slots_, i + half_ + 1); ++j) band_.at(j, i) = band_.at(i, j);
  // Where nothing but rounding is left of a pivot, refinement takes the effect of its replacement out again.
  if (!band_.factor()) return false;
  solved_.resize(slots_ * columns);
  for (std::size_t i = 0; i < slots_; ++i)
    for (std::size_t k = 0; k < columns; ++k) solved_[i * columns + k] = border_[k * slots_ + i];
  band_.solve(solved_.data(), columns);
  // Schur complement of the border: corner − borderᵀ band⁻¹ border. It is symmetric but for rounding, which is large
  // where the band is nearly singular: with these rows, and not with these columns, the border's equations hold all the
  // same.
  for (std::size_t k = 0; k < slots_; ++k)
    for (std::size_t i = 0; i < columns; ++i)
      if (const double value = border_[i * slots_ + k]; value != 0)
        add_multiple(corner_.data() + i * columns, -value, solved_.data() + k * columns, columns);
  corner_pivots_.resize(columns);
  for (std::size_t k = 0; k < columns; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < columns; ++i)
      if (std::abs(corner_[i * columns + k]) > std::abs(corner_[pivot * columns + k])) pivot = i;
    corner_pivots_[k] = pivot;
    if (!(std::abs(corner_[pivot * columns + k]) > 0)) return false;
    if (pivot != k)
      for (std::size_t j = 0; j < columns; ++j) std::swap(corner_[k * columns + j], corner_[pivot * columns + j]);
    for (std::size_t i = k + 1; i < columns; ++i) {
      const double factor = corner_[i * columns + k] /= corner_[k * columns + k];
      for (std::size_t j = k + 1; j < columns; ++j) corner_[i * columns + j] -= factor * corner_[k * columns + j];
    }
  }
  return true;
}

void BorderedBand::solve(std::vector<double>& x, std::vector<double>& y) const {
  const std::size_t shared = border_cost_.size(), columns = shared + far_;
  right_.assign(slots_, 0);
  right_border_.assign(columns, 0);
  for (std::size_t i = 0; i < position_.size(); ++i) right_[position_[i]] = x[i];
  for (std::size_t k = 0; k < shared; ++k) right_border_[k] = x[position_.size() + k];
  for (std::size_t i = 0; i < equalities_.size(); ++i)
    (equalities_[i].far ? right_border_[shared + equalities_[i].slot] : right_[equalities_[i].slot]) = y[i];
  band_.solve(right_.data());
  for (std::size_t k = 0; k < columns; ++k) {
    const double* const b = border_.data() + k * slots_;
    for (std::size_t i = 0; i < slots_; ++i) right_border_[k] -= b[i] * right_[i];
  }
  for (std::size_t k = 0; k < columns; ++k) std::swap(right_border_[k], right_border_[corner_pivots_[k]]);
  for (std::size_t k = 0; k < columns; ++k)
    for (std::size_t i = k + 1; i < columns; ++i) right_border_[i] -= corner_[i * columns + k] * right_border_[k];
  for (std::size_t k = columns; k-- > 0;) {
    for (std::size_t j = k + 1; j < columns; ++j) right_border_[k] -= corner_[k * columns + j] * right_border_[j];
    right_border_[k] /= corner_[k * columns + k];
  }
  for (std::size_t i = 0; i < slots_; ++i)
    right_[i] -= dot_product(solved_.data() + i * columns, right_border_.data(), columns);
  for (std::size_t i = 0; i < position_.size(); ++i) x[i] = right_[position_[i]];
  for (std::size_t k = 0; k < shared; ++k) x[position_.size() + k] = right_border_[k];
  for (std::size_t i = 0; i < equalities_.size(); ++i)
    y[i] = equalities_[i].far ? right_border_[shared + equalities_[i].slot] : right_[equalities_[i].slot];
}

}  // namespace bahnwerk
