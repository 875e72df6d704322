#include "core/redundant/known/cycle_spline.hpp"

#include <cmath>
#include <stdexcept>

namespace bahnwerk {

SplineMotion cycle_spline(const std::vector<std::vector<double>>& control, double step) {
  if (control.empty() || control.front().size() < 4) throw std::invalid_argument("too few control points");
  const std::size_t cells = control.front().size() - 1;
  std::vector<SplineMotion::Piece> pieces(cells);
  for (std::size_t i = 0; i < cells; ++i) {
    pieces[i].end = step * static_cast<double>(i + 1);
    for (const std::vector<double>& c : control) {
      const double a = c[i == 0 ? 0 : i - 1], b = c[i], d = c[i + 1], e = c[i + 1 == cells ? i + 1 : i + 2];
      pieces[i].axes.push_back({b + ((a - b) + (d - b)) / 6, (d - a) / (2 * step),
                                ((a - b) + (d - b)) / (2 * step * step),
                                ((e - a) + 3 * (b - d)) / (6 * step * step * step)});
    }
  }
  return SplineMotion(std::move(pieces));
}

std::vector<std::vector<double>> sampled(const Motion& motion, std::size_t n) {
  std::vector<std::vector<double>> x(motion.axes(), std::vector<double>(n + 1));
  std::size_t piece = 0;
  for (std::size_t i = 0; i <= n; ++i) {
    const MotionState state =
        i == n ? motion.final_state()
               : motion.evaluate(motion.duration() * static_cast<double>(i) / static_cast<double>(n), piece);
    for (std::size_t k = 0; k < x.size(); ++k) x[k][i] = state[0][k];
  }
  return x;
}

}  // namespace bahnwerk
