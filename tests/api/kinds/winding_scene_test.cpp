#include "api/kinds/winding/winding_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "api/kinds/winding/winding.hpp"
#include "core/plan/winding/path_clearance.hpp"
#include "tests/api/kinds/winding_documents.hpp"

namespace bahnwerk::api::winding_kind {
namespace {

using nlohmann::json;

std::map<std::string, int> names(const Scene& scene) {
  std::map<std::string, int> count;
  for (const SceneBody& body : scene.bodies) ++count[body.name];
  return count;
}

TEST(WindingScene, HasTheObstaclesOfTheClearanceAndTheLaidWires) {
  const json spec = example("minimal");
  const json result = planned(spec).result;
  const Scene scene = winding_scene(request(spec), result);
  const auto count = names(scene);
  EXPECT_EQ(count.at("needle"), 1);
  EXPECT_EQ(count.at("wire"), 1);
  const auto obstacles = coil_obstacles(request(spec), 0);
  std::size_t drawn = 0;
  for (const SceneBody& body : scene.bodies) drawn += body.kind == SceneBody::Kind::extrusion ? 1 : 0;
  EXPECT_EQ(drawn, obstacles.list().size());
  EXPECT_LE(scene.vertices(), max_scene_vertices);
  const auto wire =
      std::find_if(scene.bodies.begin(), scene.bodies.end(), [](const auto& b) { return b.name == "wire"; });
  EXPECT_EQ(wire->points.size(), 8 * result["details"]["turns"].size());
  EXPECT_EQ(wire->times.front(), result["details"]["turns"][0]["begins"].get<double>());
  EXPECT_EQ(names(winding_scene(request(spec), json::object())).count("wire"), 0U);
}

TEST(WindingScene, TheCurveOfTheClearanceHasItsLeastValue) {
  for (const char* name : {"minimal", "rotor"}) {
    const json result = planned(example(name)).result, clearance = result["details"]["clearance"],
               curve = clearance["curve"];
    const std::size_t intervals = curve["values"].size();
    ASSERT_EQ(curve["times"].size(), intervals + 1);
    ASSERT_EQ(curve["lengths"].size(), intervals + 1);
    ASSERT_EQ(curve["nearest"].size(), intervals);
    const auto least = curve["values"].get<std::vector<double>>();
    EXPECT_NEAR(*std::min_element(least.begin(), least.end()), clearance["minimum"].get<double>(),
                curve["tolerance"].get<double>() + 0.001);
    const auto times = curve["times"].get<std::vector<double>>();
    EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
    EXPECT_EQ(times.front(), 0);
    EXPECT_NEAR(times.back(), result["setpoints"]["duration"].get<double>(), 1e-6);
    EXPECT_NEAR(curve["lengths"].back().get<double>(), result["summary"]["path_length"].get<double>(), 1e-6);
    // The interval that holds the nearest place is the one with the least value.
    const auto lengths = curve["lengths"].get<std::vector<double>>();
    const auto at =
        std::upper_bound(lengths.begin(), lengths.end(), clearance["at"].get<double>()) - lengths.begin() - 1;
    const std::size_t interval = std::min(static_cast<std::size_t>(at), intervals - 1);
    EXPECT_NEAR(least[interval], clearance["minimum"].get<double>(), curve["tolerance"].get<double>() + 0.001);
  }
}

}  // namespace
}  // namespace bahnwerk::api::winding_kind
