// The list of kinds: one line each, in the order in which they are shown. Each is described in
// api/kinds/<name>/<name>.cpp (api/kinds/kind_frame.hpp).
#define BAHNWERK_KINDS(KIND) \
  KIND(contour)              \
  KIND(fill_factor)          \
  KIND(motion_law)           \
  KIND(probe_path)           \
  KIND(winding)

#include <array>

#include "api/kind.hpp"

namespace bahnwerk::api {

#define DECLARE(name) Kind describe_##name();
BAHNWERK_KINDS(DECLARE)
#undef DECLARE

std::span<const Kind> kinds() {
#define DESCRIBE(name) describe_##name(),
  static const std::array list{BAHNWERK_KINDS(DESCRIBE)};
#undef DESCRIBE
  return list;
}

const Kind* find_kind(std::string_view name) {
  for (const auto& kind : kinds())
    if (kind.name == name) return &kind;
  return nullptr;
}

}  // namespace bahnwerk::api
