#include "api/result_files.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "api/kind.hpp"
#include "api/problem.hpp"

namespace bahnwerk::api {
namespace {

bool has_layout(const Kind& kind, std::string_view layout) {
  return std::find(kind.files.layouts.begin(), kind.files.layouts.end(), layout) != kind.files.layouts.end();
}

}  // namespace

const Kind* kind_of_layout(std::string_view layout) {
  for (const Kind& kind : kinds())
    if (has_layout(kind, layout)) return &kind;
  return nullptr;
}

std::vector<std::string> result_layouts() {
  std::vector<std::string> names;
  for (const Kind& kind : kinds()) names.insert(names.end(), kind.files.layouts.begin(), kind.files.layouts.end());
  return names;
}

std::string result_layouts_text() {
  std::string text;
  for (const Kind& kind : kinds()) {
    const auto& layouts = kind.files.layouts;
    for (std::size_t i = 0; i < layouts.size(); ++i) {
      text += i == 0 ? "; of kind " + std::string(kind.name) + " also " : i + 1 < layouts.size() ? ", " : " or ";
      text += layouts[i];
    }
  }
  return text;
}

ResultFile result_file(const nlohmann::json& result, std::string_view layout, std::string_view name) {
  const Kind* const kind = find_kind(result.value("kind", ""));
  if (kind && has_layout(*kind, layout)) return kind->files.make(result, layout, name);
  const Kind* const owner = kind_of_layout(layout);
  const std::string whose = owner ? "exists for jobs of kind " + std::string(owner->name) + " only" : "does not exist";
  throw Problem("schema-violation", "layout " + std::string(layout) + " " + whose, {{"/query/layout", whose}});
}

}  // namespace bahnwerk::api
