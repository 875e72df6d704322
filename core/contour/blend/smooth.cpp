#include "core/contour/blend/smooth.hpp"

#include <algorithm>
#include <cmath>

#include "core/contour/blend/smooth_band.hpp"
#include "core/contour/blend/smooth_basis.hpp"

namespace bahnwerk::blending {

namespace {

constexpr double first_penalty = 1, last_penalty = 1e9, penalty_factor = 10;
constexpr double start_fill = 0.95;  // of the radius, where the logarithm takes over
constexpr double first_mu = 0.3, last_mu = 1e-4, mu_factor = 0.15;
constexpr int max_newton = 12;  // steps per μ

/// A site with its basis values.
struct Row {
  std::size_t first = 0;  // of its six control points
  std::array<double, spline_order> value{};
  double gain = 0;  // g
};

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
        system_(points_ * Dim),
        c_(points_) {
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
    for (double mu = first_mu; out.inside && mu >= last_mu; mu *= mu_factor)
      for (int i = 0; i < max_newton; ++i) {
        ++out.steps;
        if (step_barrier(mu)) break;
      }
    out.knots = knots_;
    out.points = c_;
    return out;
  }

 private:
  bool free(std::size_t i) const { return i >= fixed_begin_ && i + fixed_end_ < points_; }

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
      rows_[i].value = basis_at(knots_, span, t)[0];
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
      for (std::size_t i = 0; i < k; ++i) rest += -first[k][i] * c_[i];
      c_[k] = rest / first[k][k];
    }
    const BasisRow final = basis_at(knots_, spans - 1, p_.breaks.back());
    for (std::size_t k = 0; k < fixed_end_; ++k) {
      Vec rest = part(p_.end.jet, k);
      for (std::size_t i = 0; i < k; ++i) rest += -final[k][spline_degree - i] * c_[last - i];
      c_[last - k] = rest / final[k][spline_degree - k];
    }
  }

  Vec value(std::size_t i) const {
    Vec f;
    for (std::size_t j = 0; j < spline_order; ++j) f += rows_[i].value[j] * c_[rows_[i].first + j];
    return f;
  }

  std::pair<double, std::size_t> fullest() {
    double worst = 0;
    std::size_t at = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      residual_[i] = value(i) - p_.sites[i].p;
      const double fill = norm(residual_[i]) / p_.sites[i].radius;
      if (!(fill <= worst)) worst = std::isnan(fill) ? HUGE_VAL : fill, at = i;
    }
    return {worst, at};
  }

  /// Gradient and matrix of the energy over the free coordinates; identity for the fixed ones.
  void start_system() {
    system_.clear();
    right_.assign(points_ * Dim, 0.0);
    for (std::size_t i = 0; i < points_; ++i) {
      for (std::size_t d = 0; d < Dim && !free(i); ++d) system_.at(i * Dim + d, i * Dim + d) = 1;
      for (std::size_t j = i > spline_degree ? i - spline_degree : 0; j <= i; ++j) {
        const double e = energy_.at(i, j);
        for (std::size_t d = 0; d < Dim; ++d) {
          if (free(i) && free(j)) system_.at(i * Dim + d, j * Dim + d) += e;
          if (free(i)) right_[i * Dim + d] -= e * c_[j][d];
          if (free(j) && j < i) right_[j * Dim + d] -= e * c_[i][d];
        }
      }
    }
  }

  /// Adds the site's term with gradient `pull`·r and Hessian `pull` I + `twist` r rᵀ.
  void add_site(std::size_t s, double pull, double twist) {
    scope_.work();
    const Vec r = residual_[s];
    const Row& row = rows_[s];
    double hessian[Dim][Dim];
    for (std::size_t d = 0; d < Dim; ++d)
      for (std::size_t e = 0; e < Dim; ++e) hessian[d][e] = (d == e ? pull : 0.0) + twist * r[d] * r[e];
    for (std::size_t j = 0; j < spline_order; ++j) {
      const std::size_t b = row.first + j;
      if (!free(b)) continue;
      for (std::size_t e = 0; e < Dim; ++e) {
        const double value = row.value[j];
        right_[b * Dim + e] -= pull * value * r[e];
        for (std::size_t d = e; d < Dim; ++d) system_.at(b * Dim + d, b * Dim + e) += value * value * hessian[d][e];
        for (std::size_t i = j + 1; i < spline_order; ++i) {
          const std::size_t a = row.first + i;
          if (!free(a)) break;
          for (std::size_t d = 0; d < Dim; ++d)
            system_.at(a * Dim + d, b * Dim + e) += value * row.value[i] * hessian[d][e];
        }
      }
    }
  }

  void solve_system() {
    scope_.report();  // windows are too short for the steps that others count
    system_.factor(scope_);
    system_.solve(right_);
  }

  void move(double share) {
    for (std::size_t i = 0; i < points_; ++i)
      for (std::size_t d = 0; d < Dim && free(i); ++d) c_[i][d] += share * right_[i * Dim + d];
  }

  void step_penalty(double penalty) {
    fullest();
    start_system();
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const double r = p_.sites[i].radius;
      add_site(i, penalty * rows_[i].gain / (r * r), 0);
    }
    solve_system();
    move(1);
  }

  /// One Newton step; true when it brought no more than matters at this μ.
  bool step_barrier(double mu) {
    fullest();
    start_system();
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const double r = p_.sites[i].radius, room = r * r - dot(residual_[i], residual_[i]);
      const double g = 2 * mu * rows_[i].gain / room;
      add_site(i, g, 2 * g / room);
    }
    const std::vector<double> slope = right_;
    solve_system();
    double decrement = 0, total = 0;
    for (std::size_t i = 0; i < slope.size(); ++i) decrement += slope[i] * right_[i];
    // How far the step may go before a site leaves its ball.
    double longest = 1;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      Vec move;
      for (std::size_t j = 0; j < spline_order; ++j)
        for (std::size_t d = 0; d < Dim; ++d) {
          const std::size_t at = rows_[i].first + j;
          if (free(at)) move[d] += rows_[i].value[j] * right_[at * Dim + d];
        }
      step_[i] = move;
      total += rows_[i].gain;
      const double a = dot(move, move), b = dot(move, residual_[i]);
      const double c = p_.sites[i].radius * p_.sites[i].radius - dot(residual_[i], residual_[i]);
      if (a > 0) longest = std::min(longest, 0.95 * c / (b + std::sqrt(b * b + a * c)));
    }
    if (!std::isfinite(decrement) || !(longest > 0)) return true;
    // The energy along the step is a parabola; the logarithms are summed anew.
    double quadratic = 0, linear = 0;
    energy_along(quadratic, linear);
    const auto gain = [&](double x) {
      double sum = x * (linear + 0.5 * x * quadratic);
      for (std::size_t i = 0; i < rows_.size(); ++i) {
        const double r2 = p_.sites[i].radius * p_.sites[i].radius, before = r2 - dot(residual_[i], residual_[i]);
        const Vec moved = residual_[i] + x * step_[i];
        sum -= mu * rows_[i].gain * std::log((r2 - dot(moved, moved)) / before);
      }
      return sum;
    };
    double share = longest, gained = gain(share);
    for (int i = 0; i < 12 && !(gained <= -0.1 * share * decrement); ++i) gained = gain(share *= 0.5);
    if (!(gained <= 0)) return true;
    move(share);
    return decrement < 0.3 * mu * total;
  }

  /// ½∫w|f'''|² along c + x·right_: its first and second derivative at 0.
  void energy_along(double& quadratic, double& linear) const {
    for (std::size_t i = 0; i < points_; ++i)
      for (std::size_t j = i > spline_degree ? i - spline_degree : 0; j <= i; ++j) {
        const double e = energy_.at(i, j);
        for (std::size_t d = 0; d < Dim; ++d) {
          const double si = free(i) ? right_[i * Dim + d] : 0, sj = free(j) ? right_[j * Dim + d] : 0;
          if (i == j) {
            quadratic += e * si * si;
            linear += e * si * c_[i][d];
          } else {
            quadratic += 2 * e * si * sj;
            linear += e * (si * c_[j][d] + sj * c_[i][d]);
          }
        }
      }
  }

  const TubeProblem& p_;
  ProgressScope& scope_;
  std::size_t points_;
  std::vector<double> knots_;
  BandMatrix<spline_degree> energy_;
  BandMatrix<spline_order * Dim - 1> system_;
  std::vector<Vec> c_;
  std::size_t fixed_begin_ = 0, fixed_end_ = 0;
  std::vector<Row> rows_;
  std::vector<Vec> residual_, step_;
  std::vector<double> right_;
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
