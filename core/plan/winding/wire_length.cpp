#include "core/plan/winding/wire_length.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/winding/part/vec3.hpp"

namespace bahnwerk::winding {
namespace {

/// Returns the length of an arc about the axis from one place to the other, counterclockwise for sense > 0, with evenly
/// increasing height.
double arc(Vec3 from, Vec3 to, double sense) {
  const double between = sense * (azimuth(to) - azimuth(from)),
               sweep = between - 2 * std::numbers::pi * std::floor(between / (2 * std::numbers::pi)),
               r0 = std::hypot(from.x, from.y), r1 = std::hypot(to.x, to.y);
  return std::hypot(sweep * (r0 + r1) / 2, std::hypot(r1 - r0, to.z - from.z));
}

}  // namespace

double wire_length(const std::variant<StatorPart, RotorPart>& part, const std::vector<Coil>& coils,
                   const std::vector<Turn>& turns) {
  const bool stator = std::holds_alternative<StatorPart>(part);
  double sum = 0;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const Turn& turn = turns[i];
    for (std::size_t j = 0; j < 4; ++j) {
      const Passage& p = turn.at[j];
      const double sense = (coils.at(turn.coil).span > 0) == (j == 1) ? 1 : -1;
      sum += stator && j % 2 == 1 ? arc(p.begin, p.end, sense) : norm(p.end - p.begin);
      if (j < 3) sum += norm(turn.at[j + 1].begin - p.end);
    }
    if (i + 1 < turns.size() && turns[i + 1].coil == turn.coil) sum += norm(turns[i + 1].at[0].begin - turn.at[3].end);
  }
  return sum;
}

}  // namespace bahnwerk::winding
