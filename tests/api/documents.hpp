#pragma once
/// The example documents of the source tree, and what a test wants to know of a refusal.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "api/documents/job.hpp"
#include "api/problem.hpp"
#include "tests/source.hpp"

namespace bahnwerk::api::test {

using bahnwerk::test::source;

inline std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline nlohmann::json read_json(const std::string& path) { return nlohmann::json::parse(read_file(path)); }

/// The JSON files of a folder, sorted.
inline std::vector<std::string> json_files(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(source(folder)))
    if (entry.path().extension() == ".json") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

inline std::vector<std::string> pointers(const Problem& problem) {
  std::vector<std::string> list;
  for (const auto& error : problem.errors()) list.push_back(error.pointer);
  return list;
}

/// The refusal of a job document, or nothing if it is accepted.
inline std::optional<Problem> refusal(const std::string& body) {
  try {
    parse_job(body);
  } catch (const Problem& problem) {
    return problem;
  }
  return std::nullopt;
}

inline nlohmann::json job_with_spec(std::string_view kind, const nlohmann::json& spec) {
  return {{"kind", kind}, {"spec", spec}};
}

}  // namespace bahnwerk::api::test
