/// The exported path of real coils against tests/reference/nurbs_joints.py, which shares no code: joints as smooth as
/// they say, arcs that are circles.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "api/kind.hpp"
#include "api/kinds/winding/winding.hpp"
#include "core/base/progress.hpp"
#include "tests/api/checked.hpp"
#include "tests/api/documents.hpp"

namespace bahnwerk::api::winding_kind {
namespace {

using nlohmann::json;

bool near(const json& a, const json& b) {
  return std::hypot(a[0].get<double>() - b[0].get<double>(), a[1].get<double>() - b[1].get<double>(),
                    a[2].get<double>() - b[2].get<double>()) < 1e-9;
}

/// The ways behind a stator's winding tools: from one support point of a head to the other, about the axis.
json circles(const json& details) {
  const json &path = details["path"], &support = details["support_points"];
  const std::size_t degree = path["degree"], pieces = path["joints"].size() + 1;
  json list = json::array();
  for (std::size_t i = 0; i + 1 < support.size(); i += 2) {
    const std::string region = support[i]["region"];
    if (region != "head_bottom" && region != "head_top") continue;
    const auto at = [&](const json& position) {
      std::size_t n = 0;
      while (n <= pieces && !near(path["points"][n * degree], position)) ++n;
      return n;
    };
    const json& position = support[i]["position"];
    const double x = position[0], y = position[1];
    list.push_back({{"from", at(position)},
                    {"to", at(support[i + 1]["position"])},
                    {"centre", {0, 0, position[2]}},
                    {"radius", std::hypot(x, y)}});
  }
  return list;
}

int judged(const std::string& name, json document) {
  const std::string file = ::testing::TempDir() + name + ".json";
  std::ofstream(file) << document;
  return std::system(("python3 " + test::source("tests/reference/nurbs_joints.py") + " " + file).c_str());
}

TEST(WindingExport, IndependentEvaluationConfirmsJointsAndArcs) {
  for (const std::string name : {"stator_coil", "rotor_coil"}) {
    json spec = test::read_json(test::source("examples/" + name + ".json"))["spec"];
    spec["coil"]["turns"] = 1;
    for (const std::string objective : {"curvature", "minimum_time"}) {
      spec["path"]["objective"] = objective;
      Progress silent;
      const json details = test::checked(find_kind("winding")->plan(spec, silent)).result["details"];
      json document = details["path"];
      if (name == "stator_coil") document["circles"] = circles(details);
      EXPECT_EQ(judged(name + "_" + objective, document), 0) << name << ' ' << objective;
      // A claim that is wrong is seen.
      if (objective == "minimum_time") continue;
      for (auto& joint : document["joints"]) joint["continuity"] = 4;
      EXPECT_NE(judged(name + "_claims", document), 0);
    }
  }
}

}  // namespace
}  // namespace bahnwerk::api::winding_kind
