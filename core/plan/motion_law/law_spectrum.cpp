#include "core/plan/motion_law/law_spectrum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

namespace bahnwerk {
namespace {

/// Gauss–Legendre with 8 points on [0, 1].
constexpr std::array<double, 4> nodes{0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
constexpr std::array<double, 4> weights{0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};

}  // namespace

std::size_t shown_harmonics(const cam::MotionLawProblem& problem) {
  return std::clamp<std::size_t>(4 * problem.sections(), 40, 200);
}

std::vector<double> acceleration_spectrum(const cam::CamLaw& law, std::size_t harmonics) {
  const double turn = 2 * std::numbers::pi / law.duration();
  std::vector<std::complex<double>> sum(harmonics);
  for (std::size_t i = 0; i < law.pieces(); ++i) {
    const double begin = law.breaks()[i], length = law.piece_duration(i);
    const int parts = 1 +
                      static_cast<int>(std::ceil(length * turn * static_cast<double>(harmonics) / std::numbers::pi)) +
                      static_cast<int>(law.piece(i).degree() / 8);
    for (int part = 0; part < parts; ++part)
      for (std::size_t k = 0; k < 2 * nodes.size(); ++k) {
        const double node = (1 + (k % 2 == 0 ? nodes[k / 2] : -nodes[k / 2])) / 2;
        const double x = (part + node) / parts;
        const double a = law.in_piece(i, x, 2) * weights[k / 2] / 2 * length / parts;
        const std::complex<double> step = std::polar(1.0, -turn * (begin + x * length - law.begin()));
        std::complex<double> now = step;
        for (auto& each : sum) each += a * now, now *= step;
      }
  }
  std::vector<double> out;
  for (const auto& each : sum) out.push_back(2 * std::abs(each) / law.duration());
  return out;
}

}  // namespace bahnwerk
