#pragma once
/// The answer to GET …/scene: the bodies among which a motion takes place, for drawings in space. Lengths mm, angles
/// deg.
#include <array>
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/setpoint_source.hpp"
#include "core/geometry/curve/vec.hpp"

namespace bahnwerk::api {

/// Largest number of vertices of a scene.
inline constexpr std::size_t max_scene_vertices = 5000;

/// A body, in coordinates of the scene or, where it moves, of its mover.
struct SceneBody {
  enum class Kind { extrusion, polyline, tube, cylinder, points };
  using Flat = std::array<double, 2>;
  /// Where the plane of an extrusion lies: the point (u, v) at height w is origin + u x + v y + w z.
  struct Frame {
    Vec origin, x, y, z;
  };

  std::string name;
  Kind kind = Kind::polyline;
  std::string moves = "none";                       ///< name of a mover
  std::optional<std::size_t> coil = {}, slot = {};  ///< coils from 1, slots from 0
  std::vector<Vec> points = {};                     ///< vertices of all kinds but an extrusion
  double radius = 0;                                ///< mm; 0: none
  bool round_end = false;                           ///< whether a cylinder ends in a half ball about its last point
  std::vector<double> times = {};                   ///< s, when each point appears; empty: they are always there
  std::vector<Flat> outline = {};                   ///< edge of an extrusion, counterclockwise
  std::vector<std::vector<Flat>> holes = {};
  double from = 0, to = 0;          ///< heights between which an extrusion lies
  std::optional<Frame> frame = {};  ///< nullopt: the axes of the scene
  bool assumed_outline = false;     ///< whether the document says nothing of the outline

  std::size_t vertices() const;
};

/// Columns of the setpoints that place bodies.
struct SceneMover {
  std::string name;
  std::vector<std::string> position;  ///< two or three columns
  bool turns = false;                 ///< whether the columns phi and psi turn the bodies
};

struct Scene {
  std::string frame = "base";           ///< part or base: the frame of all coordinates
  std::optional<PoseFrame> place = {};  ///< place of that frame in the base frame; nullopt: both are one
  double tolerance = 0;                 ///< tolerance of outlines, mm
  std::size_t left_out = 0;             ///< bodies and turns beyond the largest size of a scene
  std::vector<SceneMover> movers = {};
  std::vector<SceneBody> bodies = {};

  std::size_t vertices() const;
  /// Adds a body if that makes at most `most` vertices in all; otherwise it counts as left out.
  void add(SceneBody body, std::size_t most = max_scene_vertices);
};

/// Returns the answer, with the number of vertices and the box of what does not move.
nlohmann::ordered_json scene_document(std::string_view kind, const Scene& scene);

}  // namespace bahnwerk::api
