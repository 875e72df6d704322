#pragma once
/// Files that a kind makes of a stored result, in layouts of its own: the cam tables of motion laws. Queries, pages and
/// the command line find them in the kinds' descriptors (api/kind.hpp).
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace bahnwerk::api {

struct Kind;

struct ResultFile {
  std::string text, content_type;
  std::string extension;  ///< csv, txt, …
  /// Difference of the file from the result, for people: "differs from the law by position 1e-07 mm, …".
  std::string difference;
  /// Name and value of an HTTP header with the same information; the name may be empty.
  std::string header, header_value;
};

/// Returns the kind that has this layout; nullptr if no kind has it.
const Kind* kind_of_layout(std::string_view layout);

/// Returns the names of all layouts of all kinds.
std::vector<std::string> result_layouts();

/// Returns the layouts as the end of an error message: "; of kind motion_law also a, b or c". Empty if there are none.
std::string result_layouts_text();

/// Returns the file of a result document; `name` is the job's, may be empty. Throws Problem (schema-violation, at
/// /query/layout) if the result's kind does not have the layout.
ResultFile result_file(const nlohmann::json& result, std::string_view layout, std::string_view name = {});

}  // namespace bahnwerk::api
