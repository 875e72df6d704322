#include "api/scene.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <tuple>

#include "api/kind.hpp"
#include "core/base/progress.hpp"
#include "tests/api/documents.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::json;

TEST(Scene, TheBoxHoldsWhatStands) {
  Scene scene;
  scene.bodies.push_back({.name = "line", .points = {{1, 2, 3}, {4, 0, 3}}, .radius = 0.5});
  scene.bodies.push_back({.name = "head", .kind = SceneBody::Kind::points, .moves = "tool", .points = {{100, 0, 0}}});
  SceneBody wall{.name = "wall", .kind = SceneBody::Kind::extrusion};
  wall.outline = {{0, 0}, {2, 0}, {2, 1}, {0, 1}};
  wall.from = -1, wall.to = 1;
  wall.frame = SceneBody::Frame{{10, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
  scene.bodies.push_back(wall);
  const json answer = scene_document("winding", scene);
  EXPECT_EQ(answer["box"], json::parse("[[0.5, -0.5, 0], [11, 2.5, 3.5]]"));
  EXPECT_EQ(answer["vertices"], 7);
  EXPECT_EQ(answer["place"], nullptr);
  EXPECT_FALSE(answer["bodies"][0].contains("outline"));
  EXPECT_EQ(answer["bodies"][2]["outline"].size(), 4U);
  EXPECT_EQ(scene_document("winding", {})["box"], nullptr);
}

TEST(Scene, WhatHasNoRoomIsCounted) {
  Scene scene;
  scene.add({.name = "line", .points = std::vector<Vec>(6)}, 10);
  scene.add({.name = "line", .points = std::vector<Vec>(5)}, 10);
  scene.add({.name = "line", .points = std::vector<Vec>(4)}, 10);
  EXPECT_EQ(scene.bodies.size(), 2U);
  EXPECT_EQ(scene.left_out, 1U);
}

// A scene is made of the document alone; without the result it lacks the laid wires.
TEST(Scene, KindsInSpaceHaveOne) {
  Progress silent;
  for (const auto& [kind, file, bodies] : {std::tuple{"winding", "examples/stator_coil.json", 1 + 1 + 4},
                                           std::tuple{"probe_path", "examples/probe_space.json", 3}}) {
    const json spec = test::read_json(test::source(file))["spec"];
    const auto scene = find_kind(kind)->scene(spec, json::object(), silent);
    ASSERT_TRUE(scene) << file;
    EXPECT_GE(scene->bodies.size(), static_cast<std::size_t>(bodies)) << file;
    EXPECT_LE(scene->vertices(), max_scene_vertices) << file;
    EXPECT_EQ(scene->left_out, 0U) << file;
  }
  const json flat = test::read_json(test::source("examples/line.json"))["spec"];
  EXPECT_FALSE(find_kind("contour")->scene(flat, json::object(), silent));
  for (const char* kind : {"fill_factor", "motion_law"}) EXPECT_EQ(find_kind(kind)->scene, nullptr);
}

}  // namespace
}  // namespace bahnwerk::api
