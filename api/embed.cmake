# Writes OUT, a C++ file with the table of FILES that FUNCTION returns. A file's name in it is relative to BASE, without .json. One literal per line keeps every literal short.
set(table "")
foreach(file IN LISTS FILES)
  file(RELATIVE_PATH name ${BASE} ${file})
  string(REGEX REPLACE "\\.json$" "" name ${name})
  file(READ ${file} text)
  string(REPLACE "\n" "\n)~~\"\n    R\"~~(" text "${text}")
  string(APPEND table "    {\"${name}\",\n    R\"~~(${text})~~\"sv},\n")
endforeach()
file(WRITE ${OUT} "// Made from the files below ${BASE}.
#include \"api/schema/embedded.hpp\"

// What C++ compilers have to support is less than a drawing has.
#pragma GCC diagnostic ignored \"-Woverlength-strings\"
namespace bahnwerk::api {
namespace {
using namespace std::string_view_literals;  // whose lengths are known without counting
constexpr EmbeddedFile files[] = {
${table}};
}
std::span<const EmbeddedFile> ${FUNCTION}() { return files; }
}  // namespace bahnwerk::api
")
