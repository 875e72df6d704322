#pragma once
/// The quadratic model of a tube's spline (smooth.hpp): its energy and the terms of the sites, as one banded system for
/// the control points. smooth.cpp decides which terms the sites add and how long a step is.
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/contour/blend/smooth.hpp"
#include "core/contour/blend/smooth_band.hpp"
#include "core/contour/blend/smooth_basis.hpp"

namespace bahnwerk::blending {

/// A site with its basis values.
struct TubeRow {
  std::size_t first = 0;  // of its six control points
  std::array<double, spline_order> value{};
  double gain = 0;  // g
};

/// Adds column C of a site's matrix, and all columns after it: `share[e]` is the column of a control point of weight 1
/// for coordinate e.
template <std::size_t Dim, std::size_t C = 0>
[[gnu::always_inline]] inline void add_columns(double* column, const std::array<double, spline_order>& weight,
                                               const std::array<std::array<double, spline_order * Dim>, Dim>& share) {
  constexpr std::size_t rows = spline_order * Dim;
  if constexpr (C < rows) {
    for (std::size_t r = C; r < rows; ++r) column[r - C] += weight[C / Dim] * share[C % Dim][r];
    add_columns<Dim, C + 1>(column + rows, weight, share);
  }
}

/// Terms of a site: gradient `force`·r, Hessian `pull` I + `twist` r rᵀ.
struct SiteTerm {
  double force, pull, twist;
};

/// The system in the plane or in space, `Dim` coordinates. A step consists of start(), add_sites(), solve() and move(),
/// each O(breaks + sites).
template <std::size_t Dim>
class TubeSystem {
 public:
  using Coordinates = std::array<double, Dim>;
  static double product(const Coordinates& a, const Coordinates& b) {
    double sum = 0;
    for (std::size_t d = 0; d < Dim; ++d) sum += a[d] * b[d];
    return sum;
  }

  /// Both have to outlive the object. Control points that the ends determine are set, all others are 0.
  TubeSystem(const TubeProblem& problem, ProgressScope& progress);

  std::size_t sites() const { return rows_.size(); }
  double radius(std::size_t site) const { return p_.sites[site].radius; }
  double gain(std::size_t site) const { return rows_[site].gain; }
  /// Returns f(tᵢ) − pᵢ of the last call of fullest().
  const Coordinates& residual(std::size_t site) const { return residual_[site]; }
  void look_at_sites();
  /// Evaluates the sites. Returns the largest |residual|/radius, infinite if one is NaN, and its site.
  std::pair<double, std::size_t> fullest();

  /// Sets gradient and matrix to those of the energy.
  void start();
  /// Adds the terms of all sites.
  void add_sites(const std::vector<SiteTerm>& terms);

  /// Returns −gradient until solve(), then the step.
  const std::vector<double>& right() const { return right_; }
  /// Solves for the step; the ends stay unchanged.
  void solve();
  /// Returns the displacement of the spline at the site in the step.
  Coordinates step_at(std::size_t site) const { return value(rows_[site], right_); }
  /// Adds the first and second derivative of ½∫w|f'''|² along the step at its beginning. To be called once after
  /// solve().
  void energy_along(double& quadratic, double& linear);
  /// Moves by that part of the step.
  void move(double share);

  const std::vector<double>& knots() const { return knots_; }
  std::vector<Vec> points() const;

 private:
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
  /// Returns Σ of the site's basis values times rows of `x`.
  Coordinates value(const TubeRow& row, const std::vector<double>& x) const {
    Coordinates f{};
    for (std::size_t j = 0; j < spline_order; ++j)
      for (std::size_t d = 0; d < Dim; ++d) f[d] += row.value[j] * x[(row.first + j) * Dim + d];
    return f;
  }
  void assemble_energy();
  void prepare_sites();
  void fix_ends();
  /// Computes energy_ times x, whose rows behind the last point are 0.
  void times_energy(const std::vector<double>& x, std::vector<double>& product) const;
  /// Replaces the rows of the control points that the ends determine by those of the identity.
  void keep_ends();

  const TubeProblem& p_;
  ProgressScope& progress_;
  std::size_t points_;
  std::vector<double> knots_;
  BandMatrix<spline_degree> energy_;
  BandMatrix<spline_order * Dim - 1> energies_, system_;  // the energy's matrix of all coordinates; with the sites'
  std::vector<double> c_;                                 // Dim coordinates per point, and a few zeros
  std::size_t fixed_begin_ = 0, fixed_end_ = 0;
  LargeVector<TubeRow> rows_;
  std::vector<Coordinates> residual_;
  std::vector<double> right_, pull_;  // pull_: the energy's gradient
};

extern template class TubeSystem<2>;
extern template class TubeSystem<3>;

}  // namespace bahnwerk::blending
