// Looser limits of a document: a plan that keeps a tighter limit keeps the looser one.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/api/kinds/winding_documents.hpp"

namespace bahnwerk::api::winding_kind {
namespace {

using nlohmann::json;

bool verified(const json& spec) {
  Progress silent;
  try {
    return find_kind("winding")->plan(spec, silent).verified;
  } catch (const std::exception&) {
    return false;
  }
}

/// Plans with each value of a limit, tight ones first. Once a plan is verified all later ones must be.
void expect_looser_is_never_refused(json spec, const std::string& pointer, const std::vector<json>& values,
                                    std::size_t least_verified = 1) {
  std::size_t count = 0;
  for (const json& value : values) {
    spec[json::json_pointer(pointer)] = value;
    const bool now = verified(spec);
    EXPECT_TRUE(now || count == 0) << pointer << ' ' << value;
    count += now;
  }
  EXPECT_GE(count, least_verified) << pointer;
}

/// A coil of 24 slots whose wires lie at the flanks; the needle has little room between the tooth tips.
json stator(bool drawn) {
  json slot = {{"base_width", 5.3095}, {"opening_width", 2.4833},   {"height", 14.3763},        {"tip_angle", 93.8095},
               {"base_radius", 50},    {"base_corner_radius", 0.3}, {"tip_corner_radius", 0.2}, {"liner", 0.2}};
  if (drawn)
    slot = {{"type", "polygon"},
            {"points",
             {{-1.9, 0},
              {1.9, 0},
              {3, 1.2},
              {2, 12.2},
              {1.4, 12.2},
              {1.4, 13},
              {-1.4, 13},
              {-1.4, 12.2},
              {-2, 12.2},
              {-3, 1.2}}},
            {"opening", {{1.4, 13}, {-1.4, 13}}},
            {"liner", 0.2}};
  json spec = {{"part", {{"type", "stator"}, {"slot", slot}, {"slots", 24}, {"stack", 50}}},
               {"wire", {{"copper", 0.8}, {"outer", 0.88}}},
               {"coil", {{"slots", {0, 4}}, {"turns", 9}}},
               {"machine", machine("robot")},
               {"needle", {{"width", drawn ? 1.6 : 1.3}, {"length", 45}}},
               {"feed", {{"method", "critical_points"}}}};
  if (drawn) spec["part"]["base_radius"] = 48;
  spec["machine"]["cycle_time"] = 0.005;
  return spec;
}

json short_coil() {
  json spec = stator(false);
  spec["coil"]["turns"] = 1;
  return spec;
}

TEST(WindingLimits, ALooserPivotLimitIsNeverRefused) {
  expect_looser_is_never_refused(stator(false), "/needle/pivot_limit", {nullptr, 5, 10, 25}, 3);
}

TEST(WindingLimits, ALooserPivotLimitOfADrawnSlotIsNeverRefused) {
  expect_looser_is_never_refused(stator(true), "/needle/pivot_limit", {0, 5, 10, 60}, 3);
}

/// A coil whose needle leaves less than a tenth of a millimetre beside it in the opening, so that any swivel on the way
/// out of the slot touches a tooth.
json narrow(json sizes, json part, json ends, json needle) {
  sizes.update({{"base_corner_radius", 0.2}, {"liner", 0.2}, {"wedge_thickness", 0}, {"wedge_width", 0}});
  part.update({{"type", "stator"}, {"slot", sizes}, {"stack", 30}});
  const double wire = 0.7 * needle["width"].get<double>();
  json spec = {{"part", part},
               {"wire", {{"copper", wire}, {"outer", 1.1 * wire}}},
               {"coil", {{"slots", ends}, {"turns", 1}}},
               {"machine", machine("robot")},
               {"tool", {{"width", 2.1}, {"thickness", 2}}},
               {"needle", needle},
               {"feed", {{"method", "critical_points"}}}};
  for (auto& axis : spec["machine"]["axes"]) axis["range"] = nullptr;
  spec["machine"].update({{"cycle_time", 0.004}, {"l_tool", needle["length"]}});
  return spec;
}

TEST(WindingLimits, ALooserPivotLimitIsNeverRefusedWhereTheNeedleFillsTheOpening) {
  const std::vector<json> limits{nullptr, 6, 25};
  expect_looser_is_never_refused(
      narrow({{"base_width", 2.6297},
              {"opening_width", 0.6627},
              {"height", 18.2194},
              {"tip_angle", 92.2556},
              {"base_radius", 84.7786},
              {"tip_corner_radius", 0.0326}},
             {{"slots", 72}, {"tool_shift", 0.1628}}, {44, 43}, {{"width", 0.5068}, {"length", 50}}),
      "/needle/pivot_limit", limits, limits.size());
  expect_looser_is_never_refused(
      narrow({{"base_width", 2.2658},
              {"opening_width", 0.6363},
              {"height", 12.7034},
              {"tip_angle", 92.4091},
              {"base_radius", 64.4164},
              {"tip_corner_radius", 0.0629}},
             {{"slots", 60}, {"tool_shift", 0.466}}, {3, 53}, {{"width", 0.4157}, {"length", 50}}),
      "/needle/pivot_limit", limits, limits.size());
  expect_looser_is_never_refused(
      narrow({{"base_width", 3.3695},
              {"opening_width", 0.6896},
              {"height", 16.823},
              {"tip_angle", 93.3958},
              {"base_radius", 38.766},
              {"tip_corner_radius", 0.0275}},
             {{"slots", 24}, {"tool_shift", 0.3702}}, {22, 3}, {{"width", 0.5008}, {"length", 35}}),
      "/needle/pivot_limit", limits, limits.size());
}

TEST(WindingLimits, LessClearanceIsNeverRefused) {
  for (const json& limit : {json(), json(10)}) {
    json spec = short_coil();
    spec["needle"]["pivot_limit"] = limit;
    expect_looser_is_never_refused(spec, "/needle/clearance", {0.38, 0.3, 0.1, 0, -0.2, -1}, 3);
  }
}

TEST(WindingLimits, WiderRangesAreNeverRefused) {
  expect_looser_is_never_refused(short_coil(), "/machine/axes/q3/range", {{10, 40}, {-40, 90}, {-100, 300}, nullptr},
                                 2);
  expect_looser_is_never_refused(short_coil(), "/machine/axes/q1/range", {{-10, 10}, {-140, 0}, {-140, 140}, nullptr},
                                 2);
  expect_looser_is_never_refused(short_coil(), "/machine/axes/q4/range", {{-10, 10}, {-400, 400}, nullptr});
  expect_looser_is_never_refused(short_coil(), "/machine/least_bend", {45, 10, 0.5});
}

TEST(WindingLimits, QuickerAxesAreNeverRefused) {
  for (const char* const order : {"velocity", "acceleration", "jerk"}) {
    const std::string limit = std::string("/machine/axes/q3/") + order;
    const double now = short_coil()[json::json_pointer(limit)];
    expect_looser_is_never_refused(short_coil(), limit, {0.01 * now, now, 100 * now}, 3);
  }
}

TEST(WindingLimits, LooserLimitsAlongThePathAreNeverRefused) {
  expect_looser_is_never_refused(short_coil(), "/feed/velocity", {2, 200, nullptr}, 3);
  expect_looser_is_never_refused(short_coil(), "/feed/acceleration", {20, 2000, nullptr}, 3);
  expect_looser_is_never_refused(short_coil(), "/feed/jerk", {200, 20000, nullptr}, 3);
  expect_looser_is_never_refused(short_coil(), "/feed/chord_tolerance", {1e-4, 1e-2, nullptr}, 3);
  json spec = short_coil();
  spec["feed"]["velocity"] = 400;
  expect_looser_is_never_refused(spec, "/feed/half_speed_curvature", {0.01, 1, nullptr}, 3);
}

TEST(WindingLimits, LooserLimitsOfTheWireAreNeverRefused) {
  json spec = short_coil();
  spec["pull"] = {{"force", 8}, {"effective_mass", 0.02}, {"friction", 0.2}};
  expect_looser_is_never_refused(spec, "/pull/permitted", {8, 20, 80, nullptr});
  expect_looser_is_never_refused(spec, "/pull/brake_range", {8, 20, 80, nullptr});
}

}  // namespace
}  // namespace bahnwerk::api::winding_kind
