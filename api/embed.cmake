# Writes OUT, a C++ file with the table embedded_files(), from FILES. One literal per line keeps every literal short.
set(table "")
foreach(file IN LISTS FILES)
  get_filename_component(name ${file} NAME_WLE)
  file(READ ${file} text)
  string(REPLACE "\n" "\n)~~\"\n    R\"~~(" text "${text}")
  string(APPEND table "    {\"${name}\",\n    R\"~~(${text})~~\"},\n")
endforeach()
file(WRITE ${OUT} "// Made from schemas/*.json.
#include \"api/schema/embedded.hpp\"

namespace bahnwerk::api {
namespace {
constexpr EmbeddedFile files[] = {
${table}};
}
std::span<const EmbeddedFile> embedded_files() { return files; }
}  // namespace bahnwerk::api
")
