#include "core/redundant/joint/energy.hpp"

#include <array>

namespace bahnwerk {

std::vector<double> acceleration_energy(const Motion& motion) {
  // Gauss–Legendre quadrature on [−1, 1] with five points is exact to degree 9; a² has degree 8 where positions have
  // degree 6.
  constexpr std::array<double, 5> place{-0.906179845938664, -0.538469310105683, 0, 0.538469310105683,
                                        0.906179845938664};
  constexpr std::array<double, 5> weight{0.236926885056189, 0.478628670499366, 0.568888888888889, 0.478628670499366,
                                         0.236926885056189};
  std::vector<double> energy(motion.axes(), 0.0);
  for (std::size_t piece = 0; piece < motion.pieces(); ++piece) {
    const double begin = motion.begin(piece), half = 0.5 * (motion.end(piece) - begin);
    for (std::size_t i = 0; i < place.size(); ++i) {
      const MotionState x = motion.in_piece(piece, begin + half * (1 + place[i]));
      for (std::size_t k = 0; k < energy.size(); ++k) energy[k] += half * weight[i] * x[2][k] * x[2][k];
    }
  }
  return energy;
}

}  // namespace bahnwerk
