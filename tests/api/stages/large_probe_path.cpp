// Large documents of kind probe_path: many points, by every method.
#include <cmath>

#include "large_documents.hpp"

namespace bahnwerk::api::test {
namespace {

using nlohmann::json;

/// Points of a wave, a step apart.
json wave_of_points(int points, const std::string& method) {
  auto list = json::array();
  for (int i = 0; i < points; ++i) list.push_back({4.0 * i, 10 * std::sin(0.9 * i)});
  const json axis{{"acceleration", 2500}, {"jerk", 100000}, {"snap", 10000000}};
  return {{"points", std::move(list)},
          {"tolerance", 0.05},
          {"speed", 60},
          {"limits", {{"x", axis}, {"y", axis}}},
          {"method", method}};
}

std::vector<Large> probe_path_large(double size) {
  const auto n = [size](int full) { return 4 + static_cast<int>(size * full); };
  return {
      {"probe path, arcs", "probe_path", wave_of_points(n(400), "arcs")},
      {"probe path, spline", "probe_path", wave_of_points(n(100), "spline")},
      {"probe path, optimal", "probe_path", wave_of_points(n(24), "optimal")},
  };
}

const KindDocuments probe_path_documents("probe_path", probe_path_large);

}  // namespace
}  // namespace bahnwerk::api::test
