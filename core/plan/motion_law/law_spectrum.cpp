#include "core/plan/motion_law/law_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/numeric/gauss_legendre.hpp"

namespace bahnwerk {

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
      for (const auto& [place, weight] : gauss_legendre<8>()) {
        const double x = (part + (1 + place) / 2) / parts;
        const double a = law.in_piece(i, x, 2) * weight / 2 * length / parts;
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
