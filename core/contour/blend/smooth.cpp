#include "core/contour/blend/smooth.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/contour/blend/smooth_basis.hpp"
#include "core/contour/blend/smooth_system.hpp"
#include "core/numeric/interior_point/driver.hpp"
#include "core/numeric/interior_point/feasible.hpp"

namespace bahnwerk::blending {

namespace {

constexpr double first_penalty = 1, last_penalty = 1e9, penalty_factor = 100;
constexpr double start_fill = 0.95;  // part of the radius at which the barrier replaces the penalty
constexpr double first_fall = 0.1;   // first μ, as a part of the mean complementarity of the penalty's multipliers
constexpr double gap = 1e-4;         // duality gap at the end, relative to the sum of the weights
constexpr int max_newton = 60;

/// The method, in `Dim` coordinates. The slack of a site is s = r² − |residual|², its barrier has the weight of its
/// gain.
template <std::size_t Dim>
class Solver final : FeasibleProblem {
 public:
  Solver(const TubeProblem& problem, ProgressScope& progress)
      : system_(problem, progress), terms_(system_.sites()), step_(system_.sites()) {}

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
    if (out.inside) out.steps += static_cast<std::size_t>(solve_feasible(*this, options_after(penalty)).iterations);
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
    system_.solve(0);
    system_.move(1);
  }

  /// The multipliers begin as those for which the spline of the penalty is stationary: equal pulls.
  FeasibleOptions options_after(double penalty) {
    FeasibleOptions options;
    options.gap = gap;
    options.iterations = max_newton;
    options.centred = 0.3;
    double sum = 0;
    for (std::size_t i = 0; i < system_.sites(); ++i) {
      options.weights.push_back(system_.gain(i));
      options.start_multipliers.push_back(0.5 * penalty * system_.gain(i) / (system_.radius(i) * system_.radius(i)));
      sum += options.start_multipliers[i] * room(i, system_.residual(i));
      total_ += system_.gain(i);
    }
    options.start_mu = first_fall * sum / total_;
    return options;
  }
  double room(std::size_t i, const Coordinates& residual) const {
    return system_.radius(i) * system_.radius(i) - System::product(residual, residual);
  }

  double objective() const override { return system_.energy(); }
  double scale() const override { return total_; }
  bool slacks(std::vector<double>& slack) const override {
    slack.resize(system_.sites());
    for (std::size_t i = 0; i < slack.size(); ++i)
      if (!((slack[i] = room(i, system_.residual(i))) > 0)) return false;
    return true;
  }
  bool step(const BarrierPoint& at) override {
    system_.start();
    for (std::size_t i = 0; i < system_.sites(); ++i)
      terms_[i] = {2 * at.mu * system_.gain(i) / at.slack[i], 2 * at.multiplier[i], 4 * at.multiplier[i] / at.slack[i]};
    system_.add_sites(terms_);
    system_.solve(at.damping);
    // The energy along the step is a parabola.
    quadratic_ = linear_ = 0;
    system_.energy_along(quadratic_, linear_);
    for (std::size_t i = 0; i < system_.sites(); ++i) step_[i] = system_.step_at(i);
    return std::isfinite(quadratic_ + linear_);
  }
  double changes(std::vector<double>& change) const override {
    for (std::size_t i = 0; i < change.size(); ++i) change[i] = -2 * System::product(step_[i], system_.residual(i));
    return linear_;
  }
  /// A site leaves its ball earlier than the first order says.
  double longest() const override {
    double length = 1;
    for (std::size_t i = 0; i < system_.sites(); ++i) {
      const double a = System::product(step_[i], step_[i]), b = System::product(step_[i], system_.residual(i)),
                   c = room(i, system_.residual(i));
      if (a > 0) length = std::min(length, to_boundary * c / (b + std::sqrt(b * b + a * c)));
    }
    return length;
  }
  bool go(double length, std::size_t /*curve*/, std::vector<double>& slack, double& objective) override {
    length_ = length;
    objective = system_.energy() + length * (linear_ + 0.5 * length * quadratic_);
    for (std::size_t i = 0; i < slack.size(); ++i) {
      Coordinates moved = system_.residual(i);
      for (std::size_t d = 0; d < Dim; ++d) moved[d] += length * step_[i][d];
      if (!((slack[i] = room(i, moved)) > 0)) return false;
    }
    return true;
  }
  void accept() override {
    system_.move(length_);
    system_.look_at_sites();
  }

  System system_;
  std::vector<SiteTerm> terms_;        // term of each site
  std::vector<Coordinates> step_;      // displacement of the spline at each site
  double quadratic_ = 0, linear_ = 0;  // second and first derivative of the energy along the step
  double length_ = 0;                  // length of the step that go() tried last
  double total_ = 0;                   // Σ of the gains
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
