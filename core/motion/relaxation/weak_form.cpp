#include "core/motion/relaxation/weak_form.hpp"

namespace bahnwerk {

template <int N>
void WeakForm<N>::take(const RelaxationProblem<N>& problem) {
  using Row = std::array<double, N>;
  const auto& given = problem.cells;
  const std::size_t n = given.size();
  cells.assign(n + 4, {}), allowed.assign(n + 2, {}), mass.assign(n + 1, 0);
  Row inverse_jerk, inverse_acceleration;
  for (std::size_t k = 0; k < N; ++k)
    inverse_jerk[k] = 1 / problem.jerk[k], inverse_acceleration[k] = 1 / problem.acceleration[k];
  // A free end has no conditions: the splines and the hat that are not 0 there are left out.
  const auto spline_counts = [&](std::size_t i, std::size_t r) {
    return (problem.rest_first || i + r >= 2) && (problem.rest_last || i + r < n);
  };
  const auto hat_counts = [&](std::size_t node) {
    return (problem.rest_first || node > 0) && (problem.rest_last || node < n);
  };
  for (std::size_t i = 0; i < n; ++i) {
    const RelaxationCell<N>& cell = given[i];
    const double h = cell.length;
    const auto parts = splines_on(given, i);
    WeakCell<N>& c = cells[i + 2];
    for (std::size_t r = 0; r < 3; ++r) {
      const SplinePart& p = parts[r];
      c.time[r] = p.integral(h);
      if (!spline_counts(i, r)) continue;
      for (std::size_t k = 0; k < N; ++k)
        c.jerk[r][k] =
            (p.second * cell.displacement[k] - 0.5 * (p.slope_end * cell.end[k] - p.slope_begin * cell.begin[k])) *
            inverse_jerk[k];
    }
    mass[i] += h / 2, mass[i + 1] += h / 2;
    for (std::size_t k = 0; k < N; ++k) {
      const double slope = cell.displacement[k] / h;
      if (hat_counts(i)) c.acceleration[0][k] = (slope - 0.5 * cell.begin[k]) * inverse_acceleration[k];
      if (hat_counts(i + 1)) c.acceleration[1][k] = (0.5 * cell.end[k] - slope) * inverse_acceleration[k];
    }
  }
  // Integrating by parts, a jump of q′ leaves −½ Δq′ b for a weight of 1, and ½ B′ Δq′ b for jerk. The step Δq″ b of
  // the acceleration takes no jerk.
  for (const RelaxationStep<N>& step : problem.steps) {
    const auto parts = splines_on(given, step.cell);
    const double part = step.at / given[step.cell].length;
    WeakCell<N>& c = cells[step.cell + 2];
    for (std::size_t k = 0; k < N; ++k) {
      for (std::size_t r = 0; r < 3; ++r) {
        allowed[step.cell + r][k] += parts[r].at(step.at) * step.time[k];
        if (spline_counts(step.cell, r))
          c.jerk[r][k] += (0.5 * parts[r].slope(step.at) * step.tangent_jump[k] -
                           parts[r].at(step.at) * step.acceleration_step[k]) *
                          inverse_jerk[k];
      }
      if (hat_counts(step.cell))
        c.acceleration[0][k] -= 0.5 * (1 - part) * step.tangent_jump[k] * inverse_acceleration[k];
      if (hat_counts(step.cell + 1))
        c.acceleration[1][k] -= 0.5 * part * step.tangent_jump[k] * inverse_acceleration[k];
    }
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < N; ++k) {
      cells[i + 2].acceleration[0][k] /= mass[i];
      cells[i + 2].acceleration[1][k] /= mass[i + 1];
    }
}

template struct WeakForm<2>;
template struct WeakForm<3>;
template struct WeakForm<5>;
template struct WeakForm<8>;

}  // namespace bahnwerk
