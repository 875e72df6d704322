#include "core/probe/bezier.hpp"

namespace bahnwerk::probe {

Bezier bezier(const Vec* coefficients, std::size_t n, double duration) {
  Bezier out;
  out.n = n;
  std::array<Vec, Bezier::max_points> scaled{};
  double factor = 1;  // durationⁱ / C(n − 1, i)
  for (std::size_t i = 0; i < n; ++i) {
    scaled[i] = factor * coefficients[i];
    if (i + 1 < n) factor *= duration * static_cast<double>(i + 1) / static_cast<double>(n - 1 - i);
  }
  for (std::size_t j = 0; j < n; ++j) {
    double choose = 1;
    for (std::size_t i = 0; i <= j; ++i) {
      out.b[j] += choose * scaled[i];
      choose *= static_cast<double>(j - i) / static_cast<double>(i + 1);
    }
  }
  return out;
}

Bezier derivative(const Bezier& piece, double duration) {
  Bezier out;
  out.n = std::max<std::size_t>(piece.n, 2) - 1;
  const double factor = static_cast<double>(piece.n - 1) / duration;
  for (std::size_t i = 0; i + 1 < piece.n; ++i) out.b[i] = factor * (piece.b[i + 1] - piece.b[i]);
  return out;
}

void halve(const Bezier& piece, Bezier& left, Bezier& right) {
  right = piece;
  left.n = piece.n;
  for (std::size_t step = 0; step < piece.n; ++step) {
    left.b[step] = right.b[0];
    for (std::size_t i = 0; i + step + 1 < piece.n; ++i) right.b[i] = 0.5 * (right.b[i] + right.b[i + 1]);
  }
}

std::array<Strain, 3> axis_strains(const ProbeProblem& problem) {
  std::array<Strain, 3> out;
  for (Strain& s : out) s.limit = {unlimited, unlimited, unlimited};
  for (std::size_t k = 0; k < problem.dimension(); ++k) {
    out[0].limit[k] = problem.axis(k).acceleration;
    out[1].limit[k] = problem.axis(k).jerk;
    out[2].limit[k] = problem.axis(k).snap;
  }
  return out;
}

}  // namespace bahnwerk::probe
