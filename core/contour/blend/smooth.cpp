#include "core/contour/blend/smooth.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/contour/blend/smooth_basis.hpp"
#include "core/contour/blend/smooth_system.hpp"

namespace bahnwerk::blending {

namespace {

constexpr double first_penalty = 1, last_penalty = 1e9, penalty_factor = 100;
constexpr double start_fill = 0.95;                // part of the radius at which the barrier replaces the penalty
constexpr double final_mu = 1.5e-4, enough = 0.3;  // last μ; part of μ that a step may still gain at the end
constexpr int max_newton = 60;
// μ falls to these parts of the mean complementarity, depending on the length of the last step.
constexpr double far = 0.8, near = 0.3, after_far = 0.1, between = 0.2, after_near = 0.5;
constexpr double to_the_wall = 0.98;  // part of the distance to the boundary of a site or a multiplier

/// The method, in `Dim` coordinates.
template <std::size_t Dim>
class Solver {
 public:
  Solver(const TubeProblem& problem, ProgressScope& progress) : system_(problem, progress), terms_(system_.sites()) {}

  TubeSpline run() {
    TubeSpline out;
    double penalty = first_penalty;
    for (;; penalty *= penalty_factor) {
      step_penalty(penalty);
      ++out.steps;
      if (const auto [fill, site] = system_.fullest(); fill < start_fill) {
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
    out.knots = system_.knots();
    out.points = system_.points();
    return out;
  }

 private:
  using System = TubeSystem<Dim>;
  using Coordinates = typename System::Coordinates;

  void step_penalty(double penalty) {
    system_.look_at_sites();
    system_.start();
    for (std::size_t i = 0; i < system_.sites(); ++i) {
      const double r = system_.radius(i);
      const double pull = penalty * system_.gain(i) / (r * r);
      terms_[i] = {pull, pull, 0};
    }
    system_.add_sites(terms_);
    system_.solve();
    system_.move(1);
  }

  /// Returns r² − |residual|², which stays positive.
  double room(std::size_t i) const {
    return system_.radius(i) * system_.radius(i) - System::product(system_.residual(i), system_.residual(i));
  }

  /// Sets the multipliers for which the spline of that penalty is stationary: equal pulls.
  void start_multipliers(double penalty) {
    multiplier_.resize(system_.sites());
    change_.resize(system_.sites());
    step_.resize(system_.sites());
    for (std::size_t i = 0; i < system_.sites(); ++i) {
      multiplier_[i] = 0.5 * penalty * system_.gain(i) / (system_.radius(i) * system_.radius(i));
      total_ += system_.gain(i);
    }
    settle();
  }
  void settle() {
    system_.look_at_sites();
    double sum = 0;
    for (std::size_t i = 0; i < system_.sites(); ++i) sum += multiplier_[i] * room(i);
    complementarity_ = sum / total_;
  }

  /// Takes one primal-dual step; returns true when it was the last one that matters. With the room s of a site and its
  /// multiplier λ the spline is stationary for Σ 2 λ r, and λ s = μ g is what is aimed at: linearised, Δλ = (μ g + 2 λ
  /// r·Δf)/s − λ. What is left for the control points descends along the logarithmic barrier, with λ in place of μ g/s
  /// in its Hessian: that of the logarithm itself is far too stiff next to the tube's wall, where one site would hold
  /// up all.
  bool step_barrier() {
    const double part = taken_ > far ? after_far : taken_ > near ? between : after_near;
    const double mu = std::max(final_mu, part * complementarity_);
    system_.start();
    for (std::size_t i = 0; i < system_.sites(); ++i) {
      const double s = room(i);
      terms_[i] = {2 * mu * system_.gain(i) / s, 2 * multiplier_[i], 4 * multiplier_[i] / s};
    }
    system_.add_sites(terms_);
    slope_ = system_.right();
    system_.solve();
    double decrement = 0;
    for (std::size_t i = 0; i < slope_.size(); ++i) decrement += slope_[i] * system_.right()[i];
    // These are the largest step lengths before a site leaves its ball, or a multiplier becomes negative.
    double longest = 1, dual = 1;
    for (std::size_t i = 0; i < system_.sites(); ++i) {
      const Coordinates move = step_[i] = system_.step_at(i);
      const double a = System::product(move, move), b = System::product(move, system_.residual(i)), c = room(i);
      if (a > 0) longest = std::min(longest, to_the_wall * c / (b + std::sqrt(b * b + a * c)));
      change_[i] = (mu * system_.gain(i) + 2 * multiplier_[i] * b) / c - multiplier_[i];
      if (change_[i] < 0) dual = std::min(dual, -to_the_wall * multiplier_[i] / change_[i]);
    }
    if (!std::isfinite(decrement) || !(longest > 0)) return true;
    // The energy along the step is a parabola; the logarithms are summed at each trial.
    double quadratic = 0, linear = 0;
    system_.energy_along(quadratic, linear);
    const auto gain = [&](double x) {
      double sum = x * (linear + 0.5 * x * quadratic);
      for (std::size_t i = 0; i < system_.sites(); ++i) {
        const double r2 = system_.radius(i) * system_.radius(i),
                     before = r2 - System::product(system_.residual(i), system_.residual(i));
        Coordinates moved = system_.residual(i);
        for (std::size_t d = 0; d < Dim; ++d) moved[d] += x * step_[i][d];
        sum -= mu * system_.gain(i) * std::log((r2 - System::product(moved, moved)) / before);
      }
      return sum;
    };
    double share = longest, gained = gain(share);
    for (int i = 0; i < 12 && !(gained <= -0.1 * share * decrement); ++i) gained = gain(share *= 0.5);
    if (!(gained <= 0)) return true;
    system_.move(share);
    for (std::size_t i = 0; i < system_.sites(); ++i) multiplier_[i] += dual * change_[i];
    settle();
    taken_ = std::min(share, dual);
    return mu <= final_mu && decrement < enough * mu * total_;
  }

  System system_;
  std::vector<SiteTerm> terms_;              // term of each site
  std::vector<Coordinates> step_;            // displacement of the spline at each site
  std::vector<double> slope_;                // −gradient, by control points
  std::vector<double> multiplier_, change_;  // λ of each site, and its step
  double total_ = 0, complementarity_ = 0;   // Σ g, and Σ λ s / Σ g
  double taken_ = 1;                         // part of the last step
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

TubeSpline smooth_in_tube(const TubeProblem& problem, ProgressScope& progress) {
  if (problem.dimension < 3) return Solver<2>(problem, progress).run();
  const std::size_t axis = constant_axis(problem);
  if (axis == 3) return Solver<3>(problem, progress).run();
  TubeProblem flat = problem;
  flat.dimension = 2;
  for (TubeSite& site : flat.sites) site.p = without(axis, site.p);
  for (TubeEnd* end : {&flat.begin, &flat.end}) end->jet = without(axis, end->jet);
  TubeSpline spline = Solver<2>(flat, progress).run();
  for (Vec& c : spline.points) c = with(axis, problem.begin.jet.value[axis], c);
  return spline;
}

}  // namespace bahnwerk::blending
