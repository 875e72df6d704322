// Large documents of kind fill_factor: slots with many corners, and with many wires.
#include <cmath>
#include <numbers>

#include "large_documents.hpp"
#include "tests/api/documents.hpp"

namespace bahnwerk::api::test {
namespace {

using nlohmann::json;

/// A slot with a wavy outline of that many corners.
json wavy_slot(int corners) {
  auto points = json::array();
  for (int i = 0; i < corners; ++i) {
    const double t = 2 * std::numbers::pi * i / corners;
    points.push_back({(7 + 0.05 * std::sin(40 * t)) * std::cos(t), 15 + (13 + 0.05 * std::sin(40 * t)) * std::sin(t)});
  }
  return {{"type", "polygon"}, {"points", points}, {"liner", 0.2}};
}

/// A round slot of that many corners for a wide wire, which no layout takes many of, and a thin one.
json round_slot_spec(int corners) {
  auto points = json::array();
  for (int k = 0; k < corners; ++k) {
    const double t = 2 * std::numbers::pi * k / corners;
    points.push_back({5 * std::cos(t), 5 * std::sin(t)});
  }
  const std::size_t n = points.size(), k = n / 5;
  const json opening{points[k], points[n / 2 - k]};
  return {{"slot", {{"type", "polygon"}, {"points", points}, {"opening", opening}}},
          {"wires",
           {{{"copper", 0.7}, {"outer", 0.75}, {"tolerance", 0.03}},
            {{"copper", 8.8}, {"outer", 9.2}, {"tolerance", 0.02}}}},
          {"needle_width", 2},
          {"effort", 0.1},
          {"robustness", {{"samples", 1}, {"slot_tolerance", 0.01}}}};
}

std::vector<Large> fill_factor_large(double size) {
  const auto n = [size](int full) { return static_cast<int>(size * full); };
  return {
      {"wavy slot",
       "fill_factor",
       {{"slot", wavy_slot(n(2'000))}, {"wires", {0.9}}, {"algorithms", {"orthocyclic_base", "raabe", "needle"}}}},
      {"wavy slot, potential",
       "fill_factor",
       {{"slot", wavy_slot(n(1'000))}, {"wires", {1.25}}, {"algorithms", {"potential"}}}},
      {"wavy slot, robustness",
       "fill_factor",
       {{"slot", wavy_slot(n(1'000))},
        {"wires", {1.25}},
        {"algorithms", {"needle"}},
        {"robustness", {{"samples", 20}}}}},
      {"round slot", "fill_factor", round_slot_spec(n(2'000))},
      {"many wires",
       "fill_factor",
       {{"slot", wavy_slot(60)},
        {"wires", {size < 1 ? 0.71 : 0.355}},
        {"algorithms", {"orthocyclic_flank", "raabe", "potential", "needle"}}}},
  };
}

/// The smallest example of the schema takes seconds.
std::vector<Large> fill_factor_small() {
  return {{"small slot", "fill_factor", {{"slot", wavy_slot(20)}, {"wires", {3.0}}}}};
}

const KindDocuments fill_factor_documents("fill_factor", fill_factor_large, fill_factor_small);

}  // namespace
}  // namespace bahnwerk::api::test
