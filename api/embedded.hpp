#pragma once
/// The files of schemas/, compiled in so that the binary stands alone.
#include <span>
#include <string_view>

namespace bahnwerk::api {

struct EmbeddedFile {
  std::string_view name;  ///< without .json
  std::string_view text;
};
std::span<const EmbeddedFile> embedded_files();
std::string_view embedded(std::string_view name);  ///< the text; empty when there is no such file

}  // namespace bahnwerk::api
