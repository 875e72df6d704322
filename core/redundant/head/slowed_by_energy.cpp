#include "core/redundant/head/slowed_by_energy.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk {

namespace {

constexpr double most = 16;  // largest factor of a part's duration
constexpr int halvings = 50;

}  // namespace

SlowedByEnergy slowed_by_energy(const TimeLaw& law, const std::vector<double>& times,
                                const std::vector<double>& energies, double duration) {
  std::vector<double> ends;  // s, ends of the parts between rests
  double begin = 0;
  for (const LawPiece& piece : law.pieces())
    if (!(piece.v > 0) && piece.t0 > begin) ends.push_back(begin = piece.t0);
  ends.push_back(law.duration());
  std::vector<double> sums(ends.size());
  for (std::size_t c = 0, i = 0; c < energies.size(); ++c) {
    while (i + 1 < ends.size() && times[c] >= ends[i]) ++i;
    sums[i] += energies[c];
  }
  const auto length = [&](std::size_t i) { return ends[i] - (i > 0 ? ends[i - 1] : 0); };
  SlowedByEnergy found;
  std::vector<TimeLaw::Slowing>& slowings = found.slowings;
  double hardest = 0, all = 0, left = 0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    slowings.push_back({ends[i] - length(i) / 2, std::sqrt(std::sqrt(sums[i] / length(i)))});
    hardest = std::max(hardest, slowings.back().factor);
    all += sums[i];
  }
  if (!(hardest > 0)) return {};
  const auto lasts = [&](double scale) {
    double sum = 0;
    for (std::size_t i = 0; i < ends.size(); ++i) sum += length(i) * std::max(1.0, scale * slowings[i].factor);
    return sum;
  };
  double low = 0, high = most / hardest;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (low + high) / 2;
    (lasts(middle) < duration ? low : high) = middle;
  }
  for (std::size_t i = 0; i < ends.size(); ++i) {
    double& factor = slowings[i].factor;
    factor = std::max(1.0, low * factor);
    left += sums[i] / (factor * factor * factor);
  }
  const double evenly = law.duration() / duration;
  found.energy = left / (all * evenly * evenly * evenly);
  return found;
}

}  // namespace bahnwerk
