#pragma once
/// The files of schemas/ and examples/, compiled into the binary.
#include <span>
#include <string_view>

namespace bahnwerk::api {

struct EmbeddedFile {
  std::string_view name;  ///< path below its folder, without .json: "contour", "parts/gear.ngc"
  std::string_view text;
};
std::span<const EmbeddedFile> embedded_files();     ///< the schemas
std::span<const EmbeddedFile> embedded_examples();  ///< job documents, machines, part programs and drawings
std::string_view embedded(std::string_view name);   ///< returns a schema's text; empty if there is no such file

}  // namespace bahnwerk::api
