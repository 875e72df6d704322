#include "api/schema/embedded.hpp"

namespace bahnwerk::api {

std::string_view embedded(std::string_view name) {
  for (const auto& file : embedded_files())
    if (file.name == name) return file.text;
  return {};
}

}  // namespace bahnwerk::api
