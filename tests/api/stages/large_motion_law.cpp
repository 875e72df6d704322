// Large documents of kind motion_law: laws with many points, by both methods.
#include <cmath>

#include "large_documents.hpp"

namespace bahnwerk::api::test {
namespace {

using nlohmann::json;

/// A law through that many points of a wave, a hundred degrees of the master apart; at rest in all of them, or at both
/// ends only.
json wave_law(int points, const std::string& method, bool rests) {
  auto list = json::array();
  for (int i = 0; i < points; ++i) {
    json point{{"at", 100 * i}, {"position", 10 * std::sin(0.7 * i)}};
    if (rests || i == 0 || i + 1 == points) point["velocity"] = point["acceleration"] = 0;
    list.push_back(std::move(point));
  }
  return {{"master", {{"length", 100 * (points - 1)}, {"cycle_duration", 0.2 * points}}},
          {"periodic", false},
          {"points", std::move(list)},
          {"method", method}};
}

std::vector<Large> motion_law_large(double size) {
  const auto n = [size](int full) { return 4 + static_cast<int>(size * full); };
  return {
      {"law of many points, active set", "motion_law", wave_law(n(160), "active_set", true)},
      {"law of many points, optimal", "motion_law", wave_law(n(20), "optimal", false)},
  };
}

const KindDocuments motion_law_documents("motion_law", motion_law_large);

}  // namespace
}  // namespace bahnwerk::api::test
