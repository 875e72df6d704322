# Packs the bundled files of pages and writes them into one C++ file: embed.cmake -DOUT= -DFROM= (folder of the bundles) -DTEXTS= (folder of the texts).
file(GLOB files ${FROM}/*.js ${FROM}/*.css ${FROM}/*.svg)
file(GLOB texts RELATIVE ${TEXTS} ${TEXTS}/de/*.json ${TEXTS}/en/*.json)
list(SORT files)
list(SORT texts)
set(arrays "")
set(entries "")
set(digests "")
set(number 0)
foreach(file ${files})
  get_filename_component(name ${file} NAME)
  execute_process(COMMAND gzip -9 -n -c ${file} OUTPUT_FILE ${OUT}.gz RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "${file} could not be packed")
  endif()
  file(READ ${OUT}.gz bytes HEX)
  file(SHA256 ${file} digest)
  string(APPEND digests "${name}${digest}")
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
  string(APPEND arrays "constexpr unsigned char file_${number}[] = {${bytes}};\n")
  string(APPEND entries "      {\"${name}\", file_${number}},\n")
  math(EXPR number "${number} + 1")
endforeach()
file(REMOVE ${OUT}.gz)
string(SHA256 digest "${digests}")
string(SUBSTRING ${digest} 0 16 digest)
set(text_entries "")
foreach(text ${texts})
  file(READ ${TEXTS}/${text} json)
  string(APPEND text_entries "      {\"${text}\", R\"json(${json})json\"},\n")
endforeach()
file(WRITE ${OUT} "// Made from server/web at build time.
#include \"server/pages/assets.hpp\"
#include \"server/pages/texts.hpp\"

namespace bahnwerk::server {
namespace {
${arrays}}  // namespace

std::span<const Asset> assets() {
  static constexpr Asset list[] = {
${entries}  };
  return list;
}

std::string_view assets_version() { return \"${digest}\"; }

std::span<const TextFile> text_files() {
  static constexpr TextFile list[] = {
${text_entries}  };
  return list;
}
}  // namespace bahnwerk::server
")
