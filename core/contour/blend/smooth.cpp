#include "core/contour/blend/smooth.hpp"

#include <algorithm>
#include <cmath>

#include "core/contour/blend/smooth_band.hpp"
#include "core/contour/blend/smooth_basis.hpp"

namespace bahnwerk::blending {

namespace {

constexpr double first_penalty = 1, last_penalty = 1e9, penalty_factor = 100;
constexpr double start_fill = 0.95;                // of the radius, where the barrier takes over
constexpr double final_mu = 1.5e-4, enough = 0.3;  // and what a step there may still bring, of μ
constexpr int max_newton = 60;
// μ falls to these parts of the mean complementarity, by how far the last step went.
constexpr double far = 0.8, near = 0.3, after_far = 0.1, between = 0.2, after_near = 0.5;
constexpr double to_the_wall = 0.98;  // of the way to where a site or a multiplier lets no step go further

/// A site with its basis values.
struct Row {
  std::size_t first = 0;  // of its six control points
  std::array<double, spline_order> value{};
  double gain = 0;  // g
};

/// Column C of what a site adds to the matrix, and all after it: `share[e]` is the column that a control point of
/// weight 1 gets for coordinate e.
template <std::size_t Dim, std::size_t C = 0>
inline void add_columns(double* column, const std::array<double, spline_order>& weight,
                        const std::array<std::array<double, spline_order * Dim>, Dim>& share) {
  constexpr std::size_t rows = spline_order * Dim;
  if constexpr (C < rows) {
    for (std::size_t r = C; r < rows; ++r) column[r - C] += weight[C / Dim] * share[C % Dim][r];
    add_columns<Dim, C + 1>(column + rows, weight, share);
  }
}

/// In the plane or in space: `Dim` coordinates.
template <std::size_t Dim>
class Solver {
 public:
  Solver(const TubeProblem& problem, ProgressScope& scope)
      : p_(problem),
        scope_(scope),
        points_(problem.breaks.size() + spline_degree - 1),
        knots_(clamped_knots(problem.breaks)),
        energy_(points_),
        energies_(points_ * Dim),
        system_(points_ * Dim),
        c_((points_ + spline_degree) * Dim, 0.0) {
    assemble_energy();
    prepare_sites();
    fix_ends();
  }

  TubeSpline run() {
    TubeSpline out;
    double penalty = first_penalty;
    for (;; penalty *= penalty_factor) {
      step_penalty(penalty);
      ++out.steps;
      if (const auto [fill, site] = fullest(); fill < start_fill) {
        out.inside = true;
        break;
      } else if (penalty >= last_penalty) {
        out.worst = site;
        break;
      }
    }
    if (out.inside) start_multipliers(penalty);
    for (int i = 0; out.inside && i < max_newton; ++i) {
      ++out.steps;
      if (step_barrier()) break;
    }
    out.knots = knots_;
    for (std::size_t i = 0; i < points_; ++i) out.points.push_back(point(i));
    return out;
  }

 private:
  using Coordinates = std::array<double, Dim>;

  Vec point(std::size_t i) const {
    Vec c;
    for (std::size_t d = 0; d < Dim; ++d) c[d] = c_[i * Dim + d];
    return c;
  }
  void place(std::size_t i, const Vec& c) {
    for (std::size_t d = 0; d < Dim; ++d) c_[i * Dim + d] = c[d];
  }

  void assemble_energy() {
    // |f'''|² is a polynomial of degree 4 in an interval: three Gauss points integrate it exactly.
    static const double node[3] = {0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)};
    static const double weight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    double radius = HUGE_VAL;
    for (const TubeSite& s : p_.sites) radius = std::min(radius, s.radius);
    for (std::size_t k = 0; k + 1 < p_.breaks.size(); ++k) {
      scope_.work();
      const double h = p_.breaks[k + 1] - p_.breaks[k];
      const double w = std::pow(p_.scale[k], 5) / (radius * radius);
      for (int g = 0; g < 3; ++g) {
        const BasisRow row = basis_at(knots_, k, p_.breaks[k] + node[g] * h);
        for (std::size_t i = 0; i < spline_order; ++i)
          for (std::size_t j = 0; j <= i; ++j) energy_.at(k + i, k + j) += w * weight[g] * h * row[3][i] * row[3][j];
      }
    }
    for (std::size_t j = 0; j < points_; ++j)
      for (std::size_t i = 0; i < spline_order; ++i)
        for (std::size_t d = 0; d < Dim; ++d) energies_.column(j * Dim + d)[i * Dim] = energy_.column(j)[i];
  }

  void prepare_sites() {
    const std::size_t m = p_.sites.size();
    rows_.resize(m);
    residual_.resize(m);
    step_.resize(m);
    std::size_t span = 0;
    for (std::size_t i = 0; i < m; ++i) {
      const double t = p_.sites[i].t;
      while (span + 2 < p_.breaks.size() && t >= p_.breaks[span + 1]) ++span;
      rows_[i].first = span;
      rows_[i].value = value_basis_at(knots_, span, t)[0];
      const double before = i > 0 ? p_.sites[i - 1].t : p_.breaks.front();
      const double after = i + 1 < m ? p_.sites[i + 1].t : p_.breaks.back();
      rows_[i].gain = 0.5 * (after - before) / p_.scale[span];
    }
  }

  /// Control points that the ends determine.
  void fix_ends() {
    const std::size_t last = points_ - 1, spans = p_.breaks.size() - 1;
    const auto part = [](const Jet& j, std::size_t k) {
      return k == 0 ? j.value : k == 1 ? j.d1 : k == 2 ? j.d2 : j.d3;
    };
    fixed_begin_ = p_.begin.clamped ? 4 : 1;
    fixed_end_ = p_.end.clamped ? 4 : 1;
    const BasisRow first = basis_at(knots_, 0, p_.breaks.front());
    for (std::size_t k = 0; k < fixed_begin_; ++k) {
      Vec rest = part(p_.begin.jet, k);
      for (std::size_t i = 0; i < k; ++i) rest += -first[k][i] * point(i);
      place(k, rest / first[k][k]);
    }
    const BasisRow final = basis_at(knots_, spans - 1, p_.breaks.back());
    for (std::size_t k = 0; k < fixed_end_; ++k) {
      Vec rest = part(p_.end.jet, k);
      for (std::size_t i = 0; i < k; ++i) rest += -final[k][spline_degree - i] * point(last - i);
      place(last - k, rest / final[k][spline_degree - k]);
    }
  }

  /// Σ of the site's basis values with rows of `x`.
  Coordinates value(const Row& row, const std::vector<double>& x) const {
    Coordinates f{};
    for (std::size_t j = 0; j < spline_order; ++j)
      for (std::size_t d = 0; d < Dim; ++d) f[d] += row.value[j] * x[(row.first + j) * Dim + d];
    return f;
  }
  static double product(const Coordinates& a, const Coordinates& b) {
    double sum = 0;
    for (std::size_t d = 0; d < Dim; ++d) sum += a[d] * b[d];
    return sum;
  }

  void look_at_sites() {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      residual_[i] = value(rows_[i], c_);
      for (std::size_t d = 0; d < Dim; ++d) residual_[i][d] -= p_.sites[i].p[d];
    }
  }

  std::pair<double, std::size_t> fullest() {
    look_at_sites();
    double worst = 0;
    std::size_t at = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const double fill = std::sqrt(product(residual_[i], residual_[i])) / p_.sites[i].radius;
      if (!(fill <= worst)) worst = std::isnan(fill) ? HUGE_VAL : fill, at = i;
    }
    return {worst, at};
  }

  /// energy_ times x, whose rows behind the last point are 0.
  void times_energy(const std::vector<double>& x, std::vector<double>& product) const {
    product.assign((points_ + spline_degree) * Dim, 0.0);
    for (std::size_t j = 0; j < points_; ++j) {
      const double* const e = energy_.column(j);
      const double* const from = &x[j * Dim];
      double* const to = &product[j * Dim];
      Coordinates sum{};
      for (std::size_t i = 0; i < spline_order; ++i)
        for (std::size_t d = 0; d < Dim; ++d) sum[d] += e[i] * from[i * Dim + d];
      for (std::size_t i = 1; i < spline_order; ++i)
        for (std::size_t d = 0; d < Dim; ++d) to[i * Dim + d] += e[i] * from[d];
      for (std::size_t d = 0; d < Dim; ++d) to[d] += sum[d];
    }
  }

  /// Gradient and matrix of the energy.
  void start_system() {
    system_ = energies_;
    times_energy(c_, pull_);
    right_.resize(points_ * Dim);
    for (std::size_t i = 0; i < right_.size(); ++i) right_[i] = -pull_[i];
  }

  /// Adds the site's term with gradient `force`·r and Hessian `pull` I + `twist` r rᵀ.
  void add_site(std::size_t s, double force, double pull, double twist) {
    scope_.work();
    const Coordinates& r = residual_[s];
    const Row& row = rows_[s];
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

  /// Identity for what the ends determine.
  void keep_ends() {
    constexpr std::size_t width = spline_order * Dim - 1;
    const std::size_t n = points_ * Dim, first = fixed_begin_ * Dim, last = n - fixed_end_ * Dim;
    const auto keep = [&](std::size_t j) {
      std::fill_n(system_.column(j), width + 1, 0.0);
      *system_.column(j) = 1;
      right_[j] = 0;
    };
    for (std::size_t j = 0; j < first; ++j) keep(j);
    for (std::size_t j = last > width ? last - width : 0; j < last; ++j)
      std::fill(system_.column(j) + (last - j), system_.column(j) + width + 1, 0.0);
    for (std::size_t j = last; j < n; ++j) keep(j);
  }

  void solve_system() {
    scope_.report();  // windows are too short for the steps that others count
    keep_ends();
    system_.factor(scope_);
    system_.solve(right_);
  }

  void move(double share) {
    for (std::size_t i = 0; i < right_.size(); ++i) c_[i] += share * right_[i];
  }

  void step_penalty(double penalty) {
    look_at_sites();
    start_system();
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const double r = p_.sites[i].radius;
      const double pull = penalty * rows_[i].gain / (r * r);
      add_site(i, pull, pull, 0);
    }
    solve_system();
    move(1);
  }

  /// r² − |residual|², which stays positive.
  double room(std::size_t i) const {
    return p_.sites[i].radius * p_.sites[i].radius - product(residual_[i], residual_[i]);
  }

  /// Those with which the spline of that penalty is stationary: pull by pull the same.
  void start_multipliers(double penalty) {
    multiplier_.resize(rows_.size());
    change_.resize(rows_.size());
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      multiplier_[i] = 0.5 * penalty * rows_[i].gain / (p_.sites[i].radius * p_.sites[i].radius);
      total_ += rows_[i].gain;
    }
    settle();
  }
  void settle() {
    look_at_sites();
    double sum = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) sum += multiplier_[i] * room(i);
    complementarity_ = sum / total_;
  }

  /// One primal-dual step; true when it was the last one that matters. With the room s of a site and its multiplier λ
  /// the spline is stationary for Σ 2 λ r, and λ s = μ g is what is aimed at: linearised, Δλ = (μ g + 2 λ r·Δf)/s − λ.
  /// What is left for the control points descends along the logarithmic barrier, with λ in place of μ g/s in its
  /// Hessian: that of the logarithm itself is far too stiff next to the tube's wall, where one site would hold up all.
  bool step_barrier() {
    const double part = taken_ > far ? after_far : taken_ > near ? between : after_near;
    const double mu = std::max(final_mu, part * complementarity_);
    start_system();
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const double s = room(i);
      add_site(i, 2 * mu * rows_[i].gain / s, 2 * multiplier_[i], 4 * multiplier_[i] / s);
    }
    slope_ = right_;
    solve_system();
    double decrement = 0;
    for (std::size_t i = 0; i < slope_.size(); ++i) decrement += slope_[i] * right_[i];
    // How far the step may go before a site leaves its ball, or a multiplier becomes negative.
    double longest = 1, dual = 1;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const Coordinates move = step_[i] = value(rows_[i], right_);
      const double a = product(move, move), b = product(move, residual_[i]), c = room(i);
      if (a > 0) longest = std::min(longest, to_the_wall * c / (b + std::sqrt(b * b + a * c)));
      change_[i] = (mu * rows_[i].gain + 2 * multiplier_[i] * b) / c - multiplier_[i];
      if (change_[i] < 0) dual = std::min(dual, -to_the_wall * multiplier_[i] / change_[i]);
    }
    if (!std::isfinite(decrement) || !(longest > 0)) return true;
    // The energy along the step is a parabola; the logarithms are summed anew.
    double quadratic = 0, linear = 0;
    energy_along(quadratic, linear);
    const auto gain = [&](double x) {
      double sum = x * (linear + 0.5 * x * quadratic);
      for (std::size_t i = 0; i < rows_.size(); ++i) {
        const double r2 = p_.sites[i].radius * p_.sites[i].radius, before = r2 - product(residual_[i], residual_[i]);
        Coordinates moved = residual_[i];
        for (std::size_t d = 0; d < Dim; ++d) moved[d] += x * step_[i][d];
        sum -= mu * rows_[i].gain * std::log((r2 - product(moved, moved)) / before);
      }
      return sum;
    };
    double share = longest, gained = gain(share);
    for (int i = 0; i < 12 && !(gained <= -0.1 * share * decrement); ++i) gained = gain(share *= 0.5);
    if (!(gained <= 0)) return true;
    move(share);
    for (std::size_t i = 0; i < rows_.size(); ++i) multiplier_[i] += dual * change_[i];
    settle();
    taken_ = std::min(share, dual);
    return mu <= final_mu && decrement < enough * mu * total_;
  }

  /// ½∫w|f'''|² along c + x·right_: its first and second derivative at 0.
  void energy_along(double& quadratic, double& linear) {
    for (std::size_t i = 0; i < right_.size(); ++i) linear += right_[i] * pull_[i];
    right_.resize((points_ + spline_degree) * Dim, 0.0);
    times_energy(right_, pull_);
    right_.resize(points_ * Dim);
    for (std::size_t i = 0; i < right_.size(); ++i) quadratic += right_[i] * pull_[i];
  }

  const TubeProblem& p_;
  ProgressScope& scope_;
  std::size_t points_;
  std::vector<double> knots_;
  BandMatrix<spline_degree> energy_;
  BandMatrix<spline_order * Dim - 1> energies_, system_;  // the energy of all coordinates; and the sites'
  std::vector<double> c_;                                 // Dim coordinates per point, and a few zeros
  std::size_t fixed_begin_ = 0, fixed_end_ = 0;
  std::vector<Row> rows_;
  std::vector<Coordinates> residual_, step_;
  std::vector<double> right_, slope_, pull_;  // pull_: the energy's gradient
  std::vector<double> multiplier_, change_;   // per site: λ and its step
  double total_ = 0, complementarity_ = 0;    // Σ g, and Σ λ s / Σ g
  double taken_ = 1;                          // part of the last step
};

}  // namespace

Jet TubeSpline::at(std::size_t span, double t) const {
  const BasisRow row = basis_at(knots, span, t);
  Jet f;
  for (std::size_t i = 0; i < spline_order; ++i) {
    const Vec& c = points[span + i];
    f.value += row[0][i] * c;
    f.d1 += row[1][i] * c;
    f.d2 += row[2][i] * c;
    f.d3 += row[3][i] * c;
  }
  return f;
}

Jet TubeSpline::slope_at(std::size_t span, double t) const {
  const BasisRow row = slope_basis_at(knots, span, t);
  Jet f;
  for (std::size_t i = 0; i < spline_order; ++i) {
    const Vec& c = points[span + i];
    f.value += row[0][i] * c;
    f.d1 += row[1][i] * c;
  }
  return f;
}

namespace {

/// The coordinates that change; `along` = 3: all of them. In a plane across an axis the one along it is left out.
std::size_t constant_axis(const TubeProblem& p) {
  if (p.dimension < 3) return 3;
  const auto still = [](const TubeEnd& end, std::size_t axis, double value) {
    const Jet& j = end.jet;
    return j.value[axis] == value && (!end.clamped || (j.d1[axis] == 0 && j.d2[axis] == 0 && j.d3[axis] == 0));
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double value = p.begin.jet.value[axis];
    if (still(p.begin, axis, value) && still(p.end, axis, value) &&
        std::all_of(p.sites.begin(), p.sites.end(), [&](const TubeSite& s) { return s.p[axis] == value; }))
      return axis;
  }
  return 3;
}

/// A vector without one of its coordinates, and back again.
Vec without(std::size_t axis, const Vec& v) { return {v[axis == 0 ? 1 : 0], v[axis == 2 ? 1 : 2], 0}; }
Jet without(std::size_t axis, const Jet& j) {
  return {without(axis, j.value), without(axis, j.d1), without(axis, j.d2), without(axis, j.d3)};
}
Vec with(std::size_t axis, double value, const Vec& v) {
  Vec all;
  all[axis] = value;
  all[axis == 0 ? 1 : 0] = v.x;
  all[axis == 2 ? 1 : 2] = v.y;
  return all;
}

}  // namespace

TubeSpline smooth_in_tube(const TubeProblem& problem, ProgressScope& scope) {
  if (problem.dimension < 3) return Solver<2>(problem, scope).run();
  const std::size_t axis = constant_axis(problem);
  if (axis == 3) return Solver<3>(problem, scope).run();
  TubeProblem flat = problem;
  flat.dimension = 2;
  for (TubeSite& site : flat.sites) site.p = without(axis, site.p);
  for (TubeEnd* end : {&flat.begin, &flat.end}) end->jet = without(axis, end->jet);
  TubeSpline spline = Solver<2>(flat, scope).run();
  for (Vec& c : spline.points) c = with(axis, problem.begin.jet.value[axis], c);
  return spline;
}

}  // namespace bahnwerk::blending
