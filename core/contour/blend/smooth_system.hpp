#pragma once
/// Newton's system for the control points of the smoothest spline through a tube of balls (smooth.hpp).
///
/// The objective is the energy ½∫w|f'''|² dt of the spline f plus one term per ball ("site"). The term of site i
/// depends on the residual r = f(tᵢ) − pᵢ alone, the distance vector from the ball's centre; its gradient by r is force
/// · r, its Hessian pull · I + twist · r rᵀ. A residual depends on six control points, so the matrix of the system is
/// banded. The caller (smooth.cpp) chooses the terms, which make the penalty or the barrier, and the length of each
/// step; this class assembles, solves and moves the spline.
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/contour/blend/smooth.hpp"
#include "core/contour/blend/smooth_basis.hpp"
#include "core/numeric/linear/symmetric_band.hpp"

namespace bahnwerk::blending {

/// A site's row: f(tᵢ) is the sum of six control points with the weights `value`.
struct TubeRow {
  std::size_t first = 0;                     // index of the first of the six control points
  std::array<double, spline_order> value{};  // values of the six B-splines at tᵢ
  double gain = 0;                           // weight gᵢ of the site's barrier term
};

/// Adds column C of a site's matrix to the band matrix, and all columns after it. A site's matrix has spline_order ·
/// Dim rows and columns; `share[e]` is its column of coordinate e for a control point whose B-spline has the value 1.
template <std::size_t Dim, std::size_t C = 0>
[[gnu::always_inline]] inline void add_columns(double* column, const std::array<double, spline_order>& weight,
                                               const std::array<std::array<double, spline_order * Dim>, Dim>& share) {
  constexpr std::size_t rows = spline_order * Dim;
  if constexpr (C < rows) {
    for (std::size_t r = C; r < rows; ++r) column[r - C] += weight[C / Dim] * share[C % Dim][r];
    add_columns<Dim, C + 1>(column + rows, weight, share);
  }
}

/// Derivatives of a site's term: gradient force · r, Hessian pull · I + twist · r rᵀ.
struct SiteTerm {
  double force, pull, twist;
};

/// The system for `Dim` = 2 or 3 coordinates. A step consists of start(), add_sites(), solve() and move(), each
/// O(breaks + sites).
template <std::size_t Dim>
class TubeSystem {
 public:
  using Coordinates = std::array<double, Dim>;
  /// Returns the scalar product.
  static double product(const Coordinates& a, const Coordinates& b) {
    double sum = 0;
    for (std::size_t d = 0; d < Dim; ++d) sum += a[d] * b[d];
    return sum;
  }

  /// Sets the control points that the end conditions determine; all others are 0. `problem` and `progress` have to
  /// outlive the object.
  TubeSystem(const TubeProblem& problem, ProgressScope& progress);

  std::size_t sites() const { return rows_.size(); }
  /// Returns the radius of a site's ball, mm.
  double radius(std::size_t site) const { return p_.sites[site].radius; }
  /// Returns the weight gᵢ of a site's barrier term.
  double gain(std::size_t site) const { return rows_[site].gain; }
  /// Returns f(tᵢ) − pᵢ as of the last call of fullest() or look_at_sites(), mm.
  const Coordinates& residual(std::size_t site) const { return residual_[site]; }
  /// Evaluates the residuals of all sites.
  void look_at_sites();
  /// Evaluates the residuals. Returns the largest |residual|/radius, infinite if one is NaN, and its site.
  std::pair<double, std::size_t> fullest();

  /// Sets gradient and matrix to those of the energy alone.
  void start();
  /// Adds the terms of all sites; terms[i] belongs to site i.
  void add_sites(const std::vector<SiteTerm>& terms);

  /// Solves for the step, with `damping` times the diagonal added to it. Control points that the end conditions
  /// determine stay unchanged.
  void solve(double damping);
  /// Returns the energy before the step, as of start().
  double energy() const { return energy_before_; }
  /// Returns the displacement of the spline at the site in the step.
  Coordinates step_at(std::size_t site) const { return value(rows_[site], right_); }
  /// Adds the derivatives of the energy along the step, at its beginning: the first one to `linear`, the second one to
  /// `quadratic`. To be called once after solve().
  void energy_along(double& quadratic, double& linear);
  /// Moves the control points by `share` times the step.
  void move(double share);

  const std::vector<double>& knots() const { return knots_; }
  /// Returns the control points, mm.
  std::vector<Vec> points() const;

 private:
  /// Adds the term of a site to gradient and matrix.
  [[gnu::always_inline]] void add_site(std::size_t s, const SiteTerm& term) {
    progress_.work();
    const auto& [force, pull, twist] = term;
    const Coordinates& r = residual_[s];
    const TubeRow& row = rows_[s];
    std::array<std::array<double, spline_order * Dim>, Dim> share;
    double* const right = &right_[row.first * Dim];
    for (std::size_t e = 0; e < Dim; ++e) {
      const double along = force * r[e];
      Coordinates hessian;
      for (std::size_t d = 0; d < Dim; ++d) hessian[d] = (d == e ? pull : 0.0) + twist * r[d] * r[e];
      for (std::size_t i = 0; i < spline_order; ++i) {
        right[i * Dim + e] -= along * row.value[i];
        for (std::size_t d = 0; d < Dim; ++d) share[e][i * Dim + d] = row.value[i] * hessian[d];
      }
    }
    add_columns<Dim>(system_.column(row.first * Dim), row.value, share);
  }
  Vec point(std::size_t i) const {
    Vec c;
    for (std::size_t d = 0; d < Dim; ++d) c[d] = c_[i * Dim + d];
    return c;
  }
  void place(std::size_t i, const Vec& c) {
    for (std::size_t d = 0; d < Dim; ++d) c_[i * Dim + d] = c[d];
  }
  /// Returns the sum of the site's B-spline values times its rows of `x`: its point, for control points x.
  Coordinates value(const TubeRow& row, const std::vector<double>& x) const {
    Coordinates f{};
    for (std::size_t j = 0; j < spline_order; ++j)
      for (std::size_t d = 0; d < Dim; ++d) f[d] += row.value[j] * x[(row.first + j) * Dim + d];
    return f;
  }
  void assemble_energy();
  void prepare_sites();
  void fix_ends();
  /// Computes product = energy_ · x. The rows of x behind the last control point are 0.
  void times_energy(const std::vector<double>& x, std::vector<double>& product) const;
  /// Replaces the rows of control points that the end conditions determine by rows of the identity.
  void keep_ends();

  const TubeProblem& p_;
  ProgressScope& progress_;
  std::size_t points_;
  std::vector<double> knots_;
  SymmetricBand<spline_degree> energy_;             // Hessian of the energy for one coordinate
  SymmetricBand<spline_order * Dim - 1> energies_,  // Hessian of the energy for all coordinates
      system_;                                      // Hessian of energy and sites
  std::vector<double> c_;                           // control points, Dim coordinates each, and a few zeros behind them
  std::size_t fixed_begin_ = 0, fixed_end_ = 0;     // number of control points that the end conditions determine
  LargeVector<TubeRow> rows_;
  std::vector<Coordinates> residual_;
  std::vector<double> right_, pull_;  // negative gradient or step; gradient of the energy
  double energy_before_ = 0;
};

extern template class TubeSystem<2>;
extern template class TubeSystem<3>;

}  // namespace bahnwerk::blending
