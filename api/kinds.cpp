// The list of kinds.
#include <array>

#include "api/embedded.hpp"
#include "api/kind.hpp"
#include "api/kinds/contour.hpp"
#include "api/kinds/fill_factor.hpp"
#include "api/kinds/motion_law/motion_law.hpp"
#include "api/kinds/probe_path/probe_path.hpp"
#include "api/kinds/winding/winding.hpp"

namespace bahnwerk::api {

std::span<const Kind> kinds() {
  static const std::array list{
      Kind{"contour", "A tool head along a planar or spatial contour", embedded("contour"), embedded("contour.result"),
           contour::check, contour::plan},
      Kind{"fill_factor", "How many round wires a slot takes, by winding styles", embedded("fill_factor"),
           embedded("fill_factor.result"), fill_factor::check, fill_factor::plan},
      Kind{"motion_law", "A motion law for a cam or servo drive", embedded("motion_law"), embedded("motion_law.result"),
           motion_law::check, motion_law::plan},
      Kind{"probe_path", "A measuring head through given points, inside a tube", embedded("probe_path"),
           embedded("probe_path.result"), probe_path::check, probe_path::plan},
      Kind{"winding", "Coils of a stator or rotor wound by a needle, from slot to machine setpoints",
           embedded("winding"), embedded("winding.result"), winding_kind::check, winding_kind::plan},
  };
  return list;
}

const Kind* find_kind(std::string_view name) {
  for (const auto& kind : kinds())
    if (kind.name == name) return &kind;
  return nullptr;
}

}  // namespace bahnwerk::api
