#pragma once
/// The files of schemas/, compiled into the binary.
#include <span>
#include <string_view>

namespace bahnwerk::api {

struct EmbeddedFile {
  std::string_view name;  ///< file name without .json
  std::string_view text;
};
std::span<const EmbeddedFile> embedded_files();
std::string_view embedded(std::string_view name);  ///< returns a file's text; empty if there is no such file

}  // namespace bahnwerk::api
