// The list of kinds.
#include <array>

#include "api/embedded.hpp"
#include "api/kind.hpp"
#include "api/kinds/contour.hpp"
#include "api/kinds/fill_factor.hpp"
#include "api/kinds/winding/winding.hpp"

namespace bahnwerk::api {

std::span<const Kind> kinds() {
  static const std::array list{
      Kind{"contour", "A tool head along a planar or spatial contour", embedded("contour"), embedded("contour.result"),
           contour::check, contour::plan},
      Kind{"fill_factor", "How many round wires a slot takes, by winding styles", embedded("fill_factor"),
           embedded("fill_factor.result"), fill_factor::check, fill_factor::plan},
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
