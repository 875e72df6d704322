#include <cctype>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "api/text/base64.hpp"
#include "server/cli/cli.hpp"

namespace bahnwerk::server::cli {

std::string read_input(const std::string& path) {
  if (path == "-") return {std::istreambuf_iterator<char>(std::cin), {}};
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (file.bad()) throw std::runtime_error("cannot read " + path);
  return text;
}

std::string read_job(const std::string& job, const std::string& contour) {
  std::string text = read_input(job);
  if (contour.empty()) return text;
  nlohmann::ordered_json document = nlohmann::ordered_json::parse(text, nullptr, false);
  if (!document.is_object()) throw std::runtime_error(job + " is no job document");
  auto& geometry = document["spec"]["contour"];
  if (!geometry.is_object()) geometry = nlohmann::ordered_json::object();
  for (const char* form : {"start", "blocks", "points", "closed", "gcode", "dxf"}) geometry.erase(form);
  std::string kind = std::filesystem::path(contour).extension().string();
  for (char& c : kind) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  std::string part = read_input(contour);
  if (kind == ".dxf" && part.starts_with("AutoCAD Binary DXF")) part = api::base64(part);  // bytes are no JSON
  geometry[kind == ".dxf" ? "dxf" : "gcode"] = std::move(part);
  return document.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace bahnwerk::server::cli
