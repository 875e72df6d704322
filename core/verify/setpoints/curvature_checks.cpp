#include "core/verify/setpoints/curvature_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/progress.hpp"
#include "core/verify/worst.hpp"

namespace bahnwerk {
namespace {

using verify::Worst;

constexpr std::size_t parts = 4, cycles_per_report = 4096;

double distance(Vec p, Vec a, Vec b) {
  const Vec along = b - a, to = p - a;
  const double length = dot(along, along), share = length > 0 ? std::clamp(dot(to, along) / length, 0.0, 1.0) : 0;
  return norm(to - share * along);
}

}  // namespace

std::vector<Check> curvature_checks(const CurvatureInput& in, Progress progress) {
  const bool chord = in.chord_tolerance < unlimited, half = in.half_speed_curvature < unlimited;
  if (!chord && !half) return {};
  Worst error, feed;
  const Path& tool = in.path.tool();
  const auto& pieces = in.law.pieces();
  const double duration = in.law.duration();
  std::size_t piece = 0;
  std::array<Vec, parts + 1> place;
  const auto look = [&](double t) {
    piece = in.law.find(t, piece);
    const LawPiece& law = pieces[piece];
    const LawState x = law.at(std::clamp(t - law.t0, 0.0, law.duration));
    const PathPoint point = tool[law.segment].at(std::clamp(x.s, law.s, law.s_end));
    if (half) feed.raise(x.v * (1 + norm(point.d2) / in.half_speed_curvature), t);
    return point.value;
  };
  if (!pieces.empty()) place[0] = look(0);
  const auto cycles = pieces.empty() ? 0 : static_cast<std::size_t>(std::ceil(duration / in.cycle_time - 1e-6));
  for (std::size_t k = 0; k < cycles; ++k) {
    if (k % cycles_per_report == 0) progress.report("verify curvature", 0);
    for (std::size_t p = 1; p <= parts; ++p) {
      const double share = static_cast<double>(p) / static_cast<double>(parts);
      place[p] = look(std::min(duration, (static_cast<double>(k) + share) * in.cycle_time));
    }
    for (std::size_t p = 1; p < parts; ++p)
      error.raise(distance(place[p], place[0], place[parts]), static_cast<double>(k) * in.cycle_time);
    place[0] = place[parts];
  }
  std::vector<Check> checks;
  if (chord) checks.push_back(verify::make_check({{"chord error"}, 0}, in.chord_tolerance, error));
  if (half) checks.push_back(verify::make_check({{"half-speed feed"}, 1}, in.velocity, feed));
  return checks;
}

}  // namespace bahnwerk
