// Large documents of kind winding: coils of several turns.

#include "large_documents.hpp"
#include "tests/api/documents.hpp"

namespace bahnwerk::api::test {
namespace {

using nlohmann::json;

/// A stator coil, links by time.
json winding_spec(int turns) {
  json spec = read_json(source("schemas/examples/winding/complete.json"));
  spec["coil"] = {{"slots", spec["coil"]["slots"]}, {"turns", turns}};
  spec["path"]["objective"] = "minimum_time";
  return spec;
}

std::vector<Large> winding_large(double size) {
  return {
      {"winding, links by time", "winding", winding_spec(size < 1 ? 1 : 4)},
  };
}

const KindDocuments winding_documents("winding", winding_large);

}  // namespace
}  // namespace bahnwerk::api::test
